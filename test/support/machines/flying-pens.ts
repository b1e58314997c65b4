/**
 * Plots whose pen moves while the carriage does, on a virtual board with a simulated servo. Marks are where its tip
 * touches the paper.
 */
import { DEFAULT_PEN, VirtualBoard, type PenSettings, type StrokeSet } from "../../../src/index.js";
import type { DrawnPolyline, VirtualServo } from "../../../src/drivers/ebb/virtual/virtual-board.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";
import type { PenMove, Trajectory } from "../../../src/plan/trajectory.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../src/schema/index.js";
import { compareDrawn, type DrawnTruth } from "../drawings/drawn-truth.js";
import { strokesOf } from "../plots/local-planner.js";
import type { ManualClock } from "../clocks/manual-clock.js";
import { plotOnBoard, type PlotOnBoard } from "../plots/plot-on-board.js";

const arc = (x: number, y: number, r: number): number[] =>
  Array.from({ length: 40 }, (_, i) => [x + r * Math.cos(i / 13), y + r * Math.sin(i / 13)]).flat();

/** Short strokes, some mm apart, in rows: short travels and long ones. About 12 s of plotting. */
export const HOPS: StrokeSet = strokesOf(
  ...Array.from({ length: 18 }, (_, i) => {
    const [x, y] = [20 + 12 * (i % 6), 20 + 24 * Math.floor(i / 6)];
    if (i % 4 === 1) return arc(x + 3, y + 3, 3);
    if (i % 4 === 2) return [x, y, x + 6, y];
    return i % 4 === 3 ? [x, y + 8, x + 4, y, x + 7, y + 8] : [x, y, x, y + 7];
  }),
);

/** How a servo may differ from the planner's assumptions: the corners of the range. */
export const SERVOS = [
  { speed: 0.8, phaseMs: 1, contact: 0.55 },
  { speed: 1.2, phaseMs: 13, contact: 0.55 },
  { speed: 0.8, phaseMs: 23, contact: 0.45 },
  { speed: 1.2, phaseMs: 7, contact: 0.45 },
] as const;
export const STATED_SERVO = { speed: 1, phaseMs: 11, contact: 0.5 } as const;

export interface FlyingServo {
  readonly speed: number;
  readonly phaseMs: number;
  /** Share of the distance from down to up below which the tip touches. */
  readonly contact: number;
}

export const virtualServo = (
  { speed, phaseMs, contact }: FlyingServo,
  { downPct, upPct }: PenSettings = DEFAULT_PEN,
): VirtualServo => ({
  speed,
  framePhaseMs: phaseMs,
  contactPct: downPct + contact * (upPct - downPct),
});

export const penSettings = (overlap: PenSettings["overlap"]): PlotSettings => ({
  ...DEFAULT_PLOT_SETTINGS,
  pen: { ...DEFAULT_PEN, overlap },
});

interface FlyingPlot extends PlotOnBoard {
  readonly board: VirtualBoard;
}

/** A plot that has just begun: the clock is at the start of its plan. */
export async function flyingPlot(
  world: ManualClock,
  overlap: PenSettings["overlap"],
  firmware: string,
  servo: FlyingServo,
): Promise<FlyingPlot> {
  const board = new VirtualBoard({ clock: world, firmware, servo: virtualServo(servo) });
  return { board, ...(await plotOnBoard(world, board, HOPS, penSettings(overlap))) };
}

/** An instant of the plan; mostly while the pen moves, or up to 50 ms before. */
export function instant(trajectory: Trajectory, random: () => number): number {
  if (random() < 0.2) return trajectory.totalS * random();
  const moves = penMovesOf(trajectory);
  const move = moves[Math.floor(random() * moves.length)];
  return move.startS - 0.05 + (penEndS(trajectory, move) + 0.05 - move.startS) * random();
}

function penEndS({ runs }: Trajectory, { up, startS, moveS, beforeRun }: PenMove): number {
  return up ? startS + moveS : runs.startS[beforeRun];
}

/** Rounding to steps. */
const STEP_MM = 0.02;

/** The lines on the paper. A dot is a line of length 0. */
export function marksOn(drawn: readonly Pick<DrawnPolyline, "penDown" | "xy">[]): DrawnTruth {
  const marks = drawn.map(({ penDown, xy }) => ({ penDown, xy: xy.length === 2 ? [...xy, ...xy] : xy }));
  const { awayMm } = compareDrawn(HOPS, marks);
  // A landing after which the plot stopped is a mark before the stroke's start: beside the stroke, not a part of it.
  const strokes = marks.filter(({ xy }) => !endsAtStart([xy[xy.length - 2], xy[xy.length - 1]]));
  return { ...compareDrawn(HOPS, strokes), awayMm };
}

const endsAtStart = ([x, y]: readonly [number, number]): boolean =>
  Array.from(HOPS.offsets.subarray(0, -1), (at) =>
    Math.hypot(HOPS.xy[2 * at] - x, HOPS.xy[2 * at + 1] - y),
  ).some((mm) => mm < STEP_MM);
