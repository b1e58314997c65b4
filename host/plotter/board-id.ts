/** Tells boards apart: a plot that is resumed on another board must not believe that board's position. */
import type { BoardId } from "../../src/schema/index.js";
import type { JournalEntry, PlotStart } from "./plotter-port.js";

/** In words for the user, before what to do. */
export const OTHER_BOARD =
  "This is not the board that began the plot (its name, serial number or firmware differs), so its position says nothing about this drawing";

/** False if nothing distinguishes them. */
export function isOtherBoard(one: BoardId, other: BoardId): boolean {
  const serials = [one.boardSerialNumber, other.boardSerialNumber];
  const hasOtherSerial = !serials.includes(null) && serials[0] !== serials[1];
  return hasOtherSerial || one.boardName !== other.boardName || one.firmware !== other.firmware;
}

/** The same start; the journal also stores the board. */
export function startOn({ boardName, boardSerialNumber, firmware }: BoardId, start: PlotStart): PlotStart {
  const { journal } = start;
  const board = { boardName, boardSerialNumber, firmware };
  return {
    ...start,
    journal: journal && { record: (entry: JournalEntry) => journal.record({ ...entry, board }) },
  };
}
