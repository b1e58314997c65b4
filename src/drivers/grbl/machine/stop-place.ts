/** Finds the place on a plan at which a stop left the carriage. */
import { nearestShare } from "../../../geometry/polyline.js";
import { penMovesOf } from "../../../plan/pen-moves.js";
import { stateAt, type Trajectory } from "../../../plan/trajectory.js";

/** Blocks within this of the nearest one count as equally near, because the path may cross itself. */
const SAME_MM = 0.03;

/** A point on the plan, in seconds along it, and how far the carriage is from it. */
interface StopPlace {
  readonly awayMm: number;
  readonly atS: number;
}

/**
 * The point of the plan nearest to x, y between two times; if there are several, the one nearest to the estimate. Null
 * if nothing moves between the two.
 */
export function stopPlace(
  trajectory: Trajectory,
  { x, y }: { readonly x: number; readonly y: number },
  [fromS, toS]: readonly [number, number],
  nearS: number,
): StopPlace | null {
  const found: StopPlace[] = [];
  for (let k = 0; k < trajectory.blockCount; k++) {
    const startS = trajectory.startS[k];
    if (startS + trajectory.durationS[k] < fromS || startS > toS) continue;
    found.push(nearestOn(trajectory, k, x, y));
  }
  const minMm = Math.min(...found.map(({ awayMm }) => awayMm));
  const near = found.filter(({ awayMm }) => awayMm <= minMm + SAME_MM);
  near.sort((a, b) => Math.abs(a.atS - nearS) - Math.abs(b.atS - nearS));
  return near[0] ?? null;
}

/** How far a point is from the straight line between the places at two times of the plan, mm. */
export function awayFromCut(
  trajectory: Trajectory,
  { x, y }: { readonly x: number; readonly y: number },
  [fromS, toS]: readonly [number, number],
): number {
  const from = { ...stateAt(trajectory, fromS) };
  const to = { ...stateAt(trajectory, toS) };
  const share = nearestShare(from.x, from.y, to.x, to.y, x, y);
  return Math.hypot(x - from.x - share * (to.x - from.x), y - from.y - share * (to.y - from.y));
}

/** Whether the pen is up, and has come to rest, at all times between the two. */
export function isPenUpThroughout(trajectory: Trajectory, [fromS, toS]: readonly [number, number]): boolean {
  return !penMovesOf(trajectory).some(
    ({ up, startS, moveS }, i, all) =>
      startS <= toS && (all[i + 1]?.startS ?? Infinity) >= fromS && (!up || startS + moveS > fromS),
  );
}

function nearestOn(trajectory: Trajectory, k: number, x: number, y: number): StopPlace {
  const { vx, vy, ax, ay, durationS, startS } = trajectory;
  const t = durationS[k];
  const dx = vx[k] * t + (ax[k] * t * t) / 2;
  const dy = vy[k] * t + (ay[k] * t * t) / 2;
  const lengthMm = Math.hypot(dx, dy);
  const [px, py] = [x - trajectory.x[k], y - trajectory.y[k]];
  const share = nearestShare(0, 0, dx, dy, px, py);
  const awayMm = Math.hypot(px - share * dx, py - share * dy);
  const v = Math.hypot(vx[k], vy[k]);
  const a = lengthMm > 0 ? (ax[k] * dx + ay[k] * dy) / lengthMm : 0;
  const s = share * lengthMm;
  // s = v t + a t²/2, in a form that is valid for a = 0 too.
  const root = v + Math.sqrt(Math.max(0, v * v + 2 * a * s));
  return { awayMm, atS: startS[k] + Math.min(t, root > 0 ? (2 * s) / root : 0) };
}
