/**
 * Where a virtual board was stopped, from its own count of the ticks that its motors ran: the reference for
 * the place that a host computes from the board's replies.
 */
import { streamOf } from "../../../src/drivers/ebb/compile/command-stream.js";
import type { MachineCommands } from "../../../src/drivers/machine-job.js";
import { strokeLengthMm } from "../../../src/position/on-drawing.js";
import type { PlannedPlot, PlanRequest } from "../../../host/planning/planning.js";
import {
  commandLine,
  stateAt,
  type StrokePosition,
  type StrokeSet,
  type VirtualBoard,
} from "../../../src/index.js";
import { TICKS_PER_S } from "../../../src/units.js";
import { LocalPlanner, strokesOf } from "../plots/local-planner.js";

/** A planner that stores its plans. */
export class KeepingPlanner extends LocalPlanner {
  readonly plots: PlannedPlot[] = [];

  override async plan(request: PlanRequest): Promise<PlannedPlot> {
    const plot = await super.plan(request);
    this.plots.push(plot);
    return plot;
  }
}

/** Pen moves and waits, during which the motors rest. */
const isMove = (line: string): boolean => /^(LM|LT|T3|SM)/.test(line) && !/^SM,\d+,0,0$/.test(line);

/** Ticks for which the board's motors have run so far. */
export const ranTicks = (board: VirtualBoard): number => Math.round(board.statistics().movingS * TICKS_PER_S);

/** The plan's time after that many ticks of motion; at rest, the earliest. */
export function planSAfter(commands: MachineCommands, ticks: number): number {
  const stream = streamOf(commands);
  let left = ticks;
  for (let i = 0; i < stream.count; i++) {
    if (!isMove(commandLine(stream, i))) continue;
    const taken = Math.round((stream.boardS[i + 1] - stream.boardS[i]) * TICKS_PER_S);
    if (left <= taken) {
      return stream.planS[i] + (left / taken) * (stream.planS[i + 1] - stream.planS[i]);
    }
    left -= taken;
  }
  return stream.planS[stream.count];
}

/** mm drawn from the drawing's beginning at that time of the plan. */
export function drawnUntilMm(strokes: StrokeSet, { trajectory }: PlannedPlot, planS: number): number {
  const { runs } = trajectory;
  const { stroke, alongMm } = stateAt(trajectory, planS);
  if (stroke >= 0) return mmOf(strokes, { stroke, alongMm });
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] >= 0 && runs.startS[run] >= planS - 1e-7) {
      return mmOf(strokes, { stroke: runs.stroke[run], alongMm: 0 });
    }
  }
  return mmOf(strokes, { stroke: strokes.offsets.length - 1, alongMm: 0 });
}

/** mm of the drawing before a place. */
export function mmOf(strokes: StrokeSet, place: StrokePosition): number {
  let sum = place.alongMm;
  for (let stroke = 0; stroke < place.stroke; stroke++) sum += strokeLengthMm(strokes, stroke);
  return sum;
}

/** Two sides of a tip with an angle of that many degrees. */
const tip = (x: number, y: number, mm: number, deg: number): number[] => {
  const half = (deg / 360) * Math.PI;
  const [dx, dy] = [mm * Math.cos(half), mm * Math.sin(half)];
  return [x, y - dy, x + dx, y, x, y + dy];
};

/**
 * Lines that pass the same places more than once: tips, hairpins, a line drawn over itself many times, a
 * small zigzag.
 */
export const RETRACED: StrokeSet = strokesOf(
  tip(20, 20, 15, 0.9),
  tip(20, 30, 10, 0.3),
  tip(20, 40, 8, 3),
  tip(20, 45, 8, 12),
  [50, 20, 70, 20, 50, 20, 70, 20, 50, 20],
  [50, 30, 60, 33, 50, 30],
  Array.from({ length: 24 }, (_, i) => [50 + 1.5 * (i % 2), 40 + 0.6 * (i % 2)]).flat(),
  [20, 60, 40, 60, 40, 60.02, 20, 60.02, 20, 60.04, 40, 60.04],
);
