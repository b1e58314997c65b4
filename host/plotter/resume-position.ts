/** Where an interrupted plot stopped: the journal's place, or what the board still knows about the time after it. */
import { z } from "zod";
import type { StrokePosition, StrokeSet } from "../../src/index.js";
import {
  isBetween,
  lowerAheadMm,
  maxOffDrawingMm,
  maxOffLineMm,
  machineOf,
  pointAt,
  reportedPosition,
  timedPen,
  type Machine,
} from "../../src/internal.js";
import { boardIdSchema, type PlotSettings } from "../../src/schema/index.js";
import type { StoppedAt } from "./plotter-port.js";

/** Max time between two journal entries, in real seconds. */
export const JOURNAL_S = 0.25;
/** Time between two progress reports, in real seconds. */
export const PROGRESS_S = 0.06;
/**
 * Max time from the place that the board had received at the last journal entry to the end of what was sent, beside the
 * motion that is always sent ahead. In real seconds, also for a host that is busy for a while.
 */
export const SENT_SINCE_S = 1.5;

const placeSchema = z.object({ stroke: z.int().min(0), alongMm: z.number().min(0) });

/** What is stored of a journal entry. It may have been written by another version of this program. */
export const journalSchema = z.object({
  place: placeSchema,
  received: placeSchema.optional(),
  aheadS: z.number().optional(),
  run: z.int().optional(),
  xMm: z.number().optional(),
  yMm: z.number().optional(),
  board: boardIdSchema.optional(),
});

/** How far the plot had come, which is stored with it. */
export const journalProgressSchema = z.object({
  progress: z.number().min(0).max(1),
  elapsedS: z.number().min(0),
  remainingS: z.number().min(0).nullable(),
});

const HOME = { x: 0, y: 0 };

/** `penStops`: the strokes before which the plot goes home and waits. */
export function resumePosition(
  machine: Pick<Machine, "foundMidPlot" | "speed" | "positionMm">,
  strokes: StrokeSet,
  settings: PlotSettings,
  penStops: readonly number[],
  { from, received, aheadS, run, xMm, yMm }: { readonly from: StrokePosition } & StoppedAt,
): StrokePosition {
  const profile = machineOf(settings);
  const { foundMidPlot, speed } = machine;
  const at = machine.positionMm(profile);
  if (!foundMidPlot || !at) return from;
  // Another plot has moved the carriage since.
  if (!foundMidPlot.isOfRun(run)) return from;
  const { motion, pen, sendAheadMs } = settings;
  const { draw, travel } = motion;
  const nearMm = maxOffDrawingMm(motion, profile);
  const loweringMm = lowerAheadMm(timedPen(pen, profile), travel.accelMmPerS2);
  if (!received) {
    const start = pointAt(strokes, from);
    if (foundMidPlot.penUp) {
      // It was at rest, or on its way to `from`, perhaps by way of home. Elsewhere it has lifted the pen after `from`.
      if (xMm === undefined || yMm === undefined) return from;
      const entryAt = { x: xMm, y: yMm };
      const ways = [
        [entryAt, start],
        [entryAt, HOME],
        [HOME, start],
      ] as const;
      if (ways.some(([a, b]) => isBetween(a, b, at, nearMm))) return from;
    } else {
      // A resumed plot came from anywhere. Just before `from`, its pen comes down.
      const isResumed = from.stroke > 0 || from.alongMm > 0;
      if (isResumed && Math.hypot(at.x - start.x, at.y - start.y) <= loweringMm + nearMm) return from;
    }
  }
  const since = {
    aheadMm:
      (aheadS ?? (SENT_SINCE_S + sendAheadMs / 1_000) * speed) *
      Math.max(draw.speedMmPerS, travel.speedMmPerS),
    nearMm,
    offLineMm: maxOffLineMm(motion, profile),
    stops: penStops,
    lowerAheadMm: loweringMm,
  };
  const drawnTo = foundMidPlot.isCutShort === true ? from : (received ?? from);
  return reportedPosition(strokes, drawnTo, { ...at, up: foundMidPlot.penUp }, since) ?? from;
}
