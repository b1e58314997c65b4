/** Plans for moves by hand: to anywhere, and of what is drawn where the carriage stands. */
import { plan, type StrokeSet, type Trajectory } from "../../src/index.js";
import type { PlotSettings } from "../../src/schema/index.js";

const NO_STROKES: StrokeSet = {
  xy: new Float64Array(0),
  offsets: new Uint32Array(1),
  layer: new Uint16Array(0),
  layers: [],
};

/** A plan to home of nothing, moved so that home is the goal. */
export function planWalk(
  fromX: number,
  fromY: number,
  toX: number,
  toY: number,
  settings: PlotSettings,
): Trajectory {
  const start = { startX: fromX - toX, startY: fromY - toY };
  return shifted(plan(NO_STROKES, settings.motion, settings.pen, start), toX, toY);
}

/** The same motion elsewhere, mm. */
export function shifted(trajectory: Trajectory, byX: number, byY: number): Trajectory {
  return {
    ...trajectory,
    x: trajectory.x.map((x) => x + byX),
    y: trajectory.y.map((y) => y + byY),
    endX: trajectory.endX + byX,
    endY: trajectory.endY + byY,
  };
}
