/** Where an interrupted plot stopped: the journal's place, or what the board still knows about the time after it. */
import { z } from "zod";
import type { StrokePosition, StrokeSet } from "../../src/index.js";
import {
  lowerAheadMm as maxLowerAheadMm,
  maxOffDrawingMm,
  maxOffLineMm,
  machineOf,
  pointAt,
  reportedPosition,
  timedPen,
  type Machine,
} from "../../src/internal.js";
import { boardIdSchema, type PlotSettings } from "../../src/schema/index.js";
import type { JournalEntry } from "./plotter-port.js";

/** Max time between two journal entries, in real seconds. */
export const JOURNAL_S = 0.25;
/** Time between two progress reports, in real seconds. */
export const PROGRESS_S = 0.06;
/**
 * Max time from the place that the board had received at the last journal entry to the end of what was sent, beside the
 * motion that is always sent ahead. In real seconds, also for a host that is busy for a while.
 */
const SENT_SINCE_S = 1.5;

const placeSchema = z.object({ stroke: z.int().min(0), alongMm: z.number().min(0) });

/** What is stored of a journal entry. It may have been written by another version of this program. */
export const journalSchema = z.object({
  place: placeSchema,
  received: placeSchema.optional(),
  run: z.int().optional(),
  board: boardIdSchema.optional(),
});

/** How far the plot had come, which is stored with it. */
export const journalProgressSchema = z.object({
  progress: z.number().min(0).max(1),
  elapsedS: z.number().min(0),
  remainingS: z.number().min(0).nullable(),
});

/** `penStops`: the strokes before which the plot goes home and waits. */
export function resumePosition(
  machine: Pick<Machine, "foundMidPlot" | "speed" | "positionMm">,
  strokes: StrokeSet,
  settings: PlotSettings,
  penStops: readonly number[],
  { from, received, run }: { readonly from: StrokePosition } & Pick<JournalEntry, "received" | "run">,
): StrokePosition {
  const profile = machineOf(settings);
  const { foundMidPlot, speed } = machine;
  const at = machine.positionMm(profile);
  if (!foundMidPlot || !at) return from;
  // Another plot has moved the carriage since.
  if (foundMidPlot.run !== undefined && foundMidPlot.run !== run) return from;
  // The plot was on its way to `from`. A pen on the paper shows that the board has received more since, and draws there.
  if (!received && foundMidPlot.penUp) return from;
  const { motion, pen, sendAheadMs } = settings;
  const { draw, travel } = motion;
  const aheadS = (SENT_SINCE_S + sendAheadMs / 1_000) * speed;
  const nearMm = maxOffDrawingMm(motion, profile);
  const lowerAheadMm = maxLowerAheadMm(timedPen(pen, profile), travel.accelMmPerS2);
  // A resumed plot came from anywhere. Just before `from`, its pen comes down.
  const start = pointAt(strokes, from);
  const isResumed = from.stroke > 0 || from.alongMm > 0;
  if (!received && isResumed && Math.hypot(at.x - start.x, at.y - start.y) <= lowerAheadMm + nearMm)
    return from;
  const since = {
    aheadMm: aheadS * Math.max(draw.speedMmPerS, travel.speedMmPerS),
    nearMm,
    offLineMm: maxOffLineMm(motion, profile),
    stops: penStops,
    lowerAheadMm,
  };
  return reportedPosition(strokes, received ?? from, { ...at, up: foundMidPlot.penUp }, since) ?? from;
}
