/** Where an interrupted plot stopped: the journal's place, or what the board still knows about the time after it. */
import type { Place, StrokeSet } from "../../src/index.js";
import {
  landingMm,
  leavesLineMm,
  machineOf,
  placeBehindSent,
  stoppedPlace,
  type Machine,
} from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { JournalEntry } from "./types.js";

/** Max time between two journal entries, in real seconds. */
export const JOURNAL_S = 0.25;
/** Time between two progress reports, in real seconds. */
export const PROGRESS_S = 0.06;
/** Max time between the last journal entry and the end of what was sent to the board, in real seconds. */
const LEFT_S = 1.5;
/** Max time between two journal entries, plus the motion sent ahead in that time. */
const UNTIL_NEXT_ENTRY_S = JOURNAL_S + 2 * PROGRESS_S;

export const isSamePlace = (a: Place | null | undefined, b: Place | null | undefined): boolean =>
  a?.stroke === b?.stroke && a?.alongMm === b?.alongMm;

/** `penStops`: the strokes before which the plot goes home and waits. */
export function placeLeft(
  machine: Machine,
  strokes: StrokeSet,
  settings: PlotSettings,
  penStops: readonly number[],
  { from, sent }: { readonly from: Place } & Pick<JournalEntry, "sent">,
): Place {
  // The plot was at rest. Wherever the carriage is now, it has drawn nothing since.
  if (isSamePlace(from, sent)) return from;
  const { left, speed } = machine;
  const at = machine.place(machineOf(settings));
  if (!left || !at) return from;
  const { motion } = settings;
  const { draw, travel } = motion;
  const drawMmPerS = speed * draw.speedMmPerS;
  const maxMmPerS = Math.max(drawMmPerS, speed * travel.speedMmPerS);
  const pen = { ...at, up: left.penUp };
  const since = {
    aheadMm: LEFT_S * maxMmPerS,
    stops: penStops,
    leavesMm: leavesLineMm(motion, machineOf(settings).springs ?? null),
    landingMm: landingMm(settings.pen, travel.accelMmPerS2),
  };
  const sentSince = { ...since, aheadMm: UNTIL_NEXT_ENTRY_S * drawMmPerS, stops: [] };
  return (sent && placeBehindSent(strokes, sent, pen, sentSince)) ?? stoppedPlace(strokes, from, pen, since);
}
