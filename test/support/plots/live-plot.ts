/** A plot on the virtual board with a manual clock, and checks of the line that it drew. */
import { simplifyLines } from "../../../src/prepare/steps/points.js";
import { expect } from "vitest";
import { NodePlotter } from "./node-plotter.js";
import type { RunningPlot } from "../../../host/plotter/plotter-port.js";
import type { StrokeSet, VirtualBoard } from "../../../src/index.js";
import type { MotionMode } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../src/schema/index.js";
import { LocalPlanner, strokesOf } from "./local-planner.js";
import { ManualClock } from "../clocks/manual-clock.js";
import { farthest, SegmentGrid } from "../drawings/segment-grid.js";
import { virtualBoardOf, virtualPlotter } from "./virtual-plotter.js";

/** Curves, sharp corners, a reversal, short strokes: about ten seconds of plotting. */
export const DRAWING: StrokeSet = strokesOf(
  Array.from({ length: 200 }, (_, i) => [
    60 + 30 * Math.cos((i / 199) * 2 * Math.PI),
    50 + 30 * Math.sin((i / 199) * 2 * Math.PI),
  ]).flat(),
  [20, 20, 90, 20, 90, 45, 25, 45.5, 90, 46],
  [100, 60, 103, 61],
  [105, 60, 108, 61],
);

export interface LivePlot {
  readonly world: ManualClock;
  readonly driver: NodePlotter;
  readonly board: VirtualBoard;
  readonly run: RunningPlot;
}

export const settingsOf = (mode: MotionMode): PlotSettings => ({
  ...DEFAULT_PLOT_SETTINGS,
  motion: { ...DEFAULT_PLOT_SETTINGS.motion, mode },
});

export async function plotting(
  mode: MotionMode,
  strokes = DRAWING,
  firmware = "2.8.1",
  pen = DEFAULT_PLOT_SETTINGS.pen,
  settings: PlotSettings = { ...settingsOf(mode), pen },
): Promise<LivePlot> {
  const { world, driver } = await virtualPlotter({ firmware });
  const run = await world.run(driver.plot(new LocalPlanner(strokes), settings));
  return { world, driver, board: virtualBoardOf(driver), run };
}

/** The lines drawn so far, pen down. */
const lines = (board: Pick<VirtualBoard, "drawn">): Float64Array[] =>
  board
    .drawn()
    .filter(({ penDown, xy }) => penDown && xy.length > 2)
    .map(({ xy }) => xy);

function gridOfStrokes({ xy, offsets }: StrokeSet): SegmentGrid {
  const grid = new SegmentGrid(1);
  for (let s = 0; s + 1 < offsets.length; s++) grid.addPolyline(xy, 2 * offsets[s], 2 * offsets[s + 1]);
  return grid;
}

function* pairs(xy: ArrayLike<number>): Iterable<readonly [number, number]> {
  for (let i = 0; i < xy.length; i += 2) yield [xy[i], xy[i + 1]];
}

/** Everything drawn lies on the drawing, and the whole drawing is drawn. */
export function expectDrawn(board: VirtualBoard, strokes: StrokeSet, withinMm: number): void {
  const drawn = new SegmentGrid(1);
  const source = gridOfStrokes(strokes);
  for (const line of lines(board)) {
    drawn.addPolyline(line);
    expect(farthest(pairs(line), source)).toBeLessThan(withinMm);
  }
  expect(farthest(pairs(strokes.xy), drawn)).toBeLessThan(withinMm);
}

/** mm between the end of each line and the beginning of the next, if both belong to the same stroke. */
export function seamsMm(board: VirtualBoard): number[] {
  const all = lines(board);
  const seams: number[] = [];
  for (let i = 1; i < all.length; i++) {
    const [before, after] = [all[i - 1], all[i]];
    const mm = Math.hypot(after[0] - before[before.length - 2], after[1] - before[before.length - 1]);
    if (mm < 2) seams.push(mm);
  }
  return seams;
}

/**
 * mm drawn, without the zigzag of the steps, which adds up to a twentieth to a line, depending on how the two
 * motors' steps interleave.
 */
export function drawnMm(board: Pick<VirtualBoard, "drawn">): number {
  let sum = 0;
  for (const xy of lines(board)) {
    const whole = { xy, offsets: Uint32Array.of(0, xy.length / 2), tag: Uint32Array.of(0) };
    const { xy: kept } = simplifyLines(whole, 0.02);
    for (let i = 2; i < kept.length; i += 2) {
      sum += Math.hypot(kept[i] - kept[i - 2], kept[i + 1] - kept[i - 1]);
    }
  }
  return sum;
}

export function seeded(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}
