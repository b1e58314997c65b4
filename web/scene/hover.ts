/** The stroke under the pointer, and the plan's numbers at that point. */
import { stateAt, type Trajectory } from "../../src/index.js";
import type { StrokeLayer } from "../../src/internal.js";
import { nearestPiece } from "./pick.js";
import { LAYER_SHORT, PIECE_FLOATS, PIECE_SHORTS } from "./pieces.js";
import type { Scene } from "./scene.js";

export interface Hover {
  readonly xPx: number;
  readonly yPx: number;
  /** The pointer is in the right or lower part of the preview: the tip is shown on the other side. */
  readonly isRight: boolean;
  readonly isLow: boolean;
  readonly xMm: number;
  readonly yMm: number;
  readonly tS: number;
  readonly speedMmPerS: number;
  readonly accelMmPerS2: number;
  /** From 1, in the order of drawing. */
  readonly strokeNumber: number;
  readonly layerName: string;
  /** Index in `drawnLayers`. */
  readonly layer: number;
}

/** The parts of a plan that are needed here. */
interface PlanParts {
  readonly scene: Scene;
  readonly trajectory: Trajectory;
  readonly drawnLayers: readonly StrokeLayer[];
}

/** Max. distance of a stroke from the pointer, px. */
const REACH_PX = 7;

export const hoverAt = (
  planned: PlanParts,
  at: Pick<Hover, "xPx" | "yPx" | "isRight" | "isLow" | "xMm" | "yMm">,
  scale: number,
): Hover | null => {
  const { scene, trajectory, drawnLayers } = planned;
  const picked = nearestPiece(scene.grid, scene.draw, at.xMm, at.yMm, REACH_PX / scale);
  if (!picked) return null;
  const f = picked.piece * PIECE_FLOATS;
  const floats = new Float32Array(scene.draw.bytes, f * 4, PIECE_FLOATS);
  const [x0, y0, x1, y1, t0, t1] = floats;
  // The scene's times are 32-bit floats. Staying slightly inside the piece avoids the waits at its ends.
  const tS = t0 + (t1 - t0) * Math.min(0.999, Math.max(0.001, picked.share));
  const state = stateAt(trajectory, tS);
  const layer = new Uint16Array(scene.draw.bytes)[picked.piece * PIECE_SHORTS + LAYER_SHORT];
  return {
    ...at,
    xMm: x0 + (x1 - x0) * picked.share,
    yMm: y0 + (y1 - y0) * picked.share,
    tS,
    speedMmPerS: Math.hypot(state.vx, state.vy),
    accelMmPerS2: Math.hypot(state.ax, state.ay),
    strokeNumber: strokeAt(planned, tS) + 1,
    layerName: drawnLayers[layer]?.name ?? "",
    layer,
  };
};

/** The stroke of the last draw run that has begun by `tS`. Dots are draw runs without motion. */
const strokeAt = ({ trajectory: { runs } }: PlanParts, tS: number): number => {
  let low = 0;
  let high = runs.count;
  while (low < high) {
    const mid = (low + high) >> 1;
    if (runs.startS[mid] <= tS + 1e-4) low = mid + 1;
    else high = mid;
  }
  for (let r = low - 1; r >= 0; r--) if (runs.stroke[r] >= 0) return runs.stroke[r];
  return 0;
};
