import type { JournalEntry, PlotStart } from "../../../host/plotter/plotter-port.js";

/** Starts an interrupted plot where its journal ends, as a program does; without an entry, at the beginning. */
export function startAfter(entry: JournalEntry | undefined): PlotStart {
  if (!entry) return {};
  const { place, received, aheadS, run, xMm, yMm, board } = entry;
  return { from: place, received, aheadS, run, xMm, yMm, board };
}
