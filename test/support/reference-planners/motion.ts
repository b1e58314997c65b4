/**
 * The motion by another system's rules, as blocks: for the pen of a swinging machine it matters where velocity and
 * acceleration jump, and not only how long a plan takes.
 */
import { BlockColumns } from "../../../src/plan/block-columns.js";
import { ImpulseFilter, type Kernel } from "../../../src/plan/shaping/impulse-filter.js";
import type { RunPath } from "../../../src/plan/run-path.js";
import type { RunPlanner } from "../../../src/plan/run-writer.js";
import { newStraight, writeStraight, type Straight } from "../../../src/plan/trapezoid.js";
import { distance, type Point, type ReferencePlanner, type SCurve } from "./polyline.js";

/** Shorter straights are rounding errors, mm. */
const NO_LENGTH_MM = 1e-9;

/** Writes runs by a reference planner, for `plan`. */
export const referenceRuns = (reference: ReferencePlanner): RunPlanner => ({
  write(path, { speed, accel, corner, jerk }, out) {
    const points = pointsOf(path);
    const limits = { speed, accel, deviation: corner, jerk };
    const { speeds } = reference.plan(points, limits);
    const first = out.count;
    const straight = { ...newStraight(), cap2: speed * speed };
    let alongMm = path.startAlong;
    /** How much of the segment the blend at its start has taken. */
    let takenMm = 0;
    for (let i = 0; i + 1 < points.length; i++) {
      const [[x, y], length] = [points[i], distance(points[i], points[i + 1])];
      const [ux, uy] = direction(points, i);
      const blend = reference.blends ? blendAt(points, i + 1, speeds[i + 1], accel) : null;
      const reach = blend?.reachMm ?? 0;
      straight.x = x + takenMm * ux;
      straight.y = y + takenMm * uy;
      straight.ux = ux;
      straight.uy = uy;
      straight.length = length - takenMm - reach;
      straight.v0 = speeds[i];
      straight.v1 = speeds[i + 1];
      straight.alongMm = alongMm + takenMm;
      if (reference.scurvesOf !== undefined) {
        writeSCurves(straight, reference.scurvesOf(length, speeds[i], speeds[i + 1], limits), out);
      } else if (straight.length > NO_LENGTH_MM) writeStraight(straight, accel, out);
      if (blend) {
        const [v, before] = [speeds[i + 1], length - reach];
        out.push(
          blend.durationS,
          x + before * ux,
          y + before * uy,
          v * ux,
          v * uy,
          blend.ax,
          blend.ay,
          alongMm + before,
        );
      }
      takenMm = reach;
      alongMm += length;
    }
    if (reference.sliceS !== undefined) cutIntoSlices(out, first, reference.sliceS);
    out.addSegments(path.segmentCount);
  },
});

/** Needs columns with jerk, as mode `scurve` has them. */
function writeSCurves(
  { x, y, ux, uy, alongMm }: Straight,
  curves: readonly SCurve[],
  out: BlockColumns,
): void {
  if (out.jx === null || out.jy === null) throw new RangeError("S-curves need the mode scurve");
  let mm = 0;
  for (const { durationS, v0, v1 } of curves) {
    const halfS = durationS / 2;
    const peak = (v1 - v0) / halfS;
    for (const [v, accel, jerk] of [
      [v0, 0, peak / halfS],
      [(v0 + v1) / 2, peak, -peak / halfS],
    ]) {
      out.push(halfS, x + mm * ux, y + mm * uy, v * ux, v * uy, accel * ux, accel * uy, alongMm + mm);
      out.jx[out.count - 1] = jerk * ux;
      out.jy[out.count - 1] = jerk * uy;
      mm += halfS * (v + halfS * (accel / 2 + (halfS * jerk) / 6));
    }
  }
}

/** The same runs through an input shaper. */
export function shapedRuns(runs: RunPlanner, kernel: Kernel): RunPlanner {
  const filter = new ImpulseFilter(kernel);
  const planned = new BlockColumns(0, false);
  return {
    write(path, limits, out) {
      const first = out.count;
      const startS = out.clockS;
      planned.clear();
      runs.write(path, limits, planned, planned);
      const beginS = filter.write(planned, 0, path.end(), out);
      let k = 0;
      for (let i = first; i < out.count; i++) {
        const tS = out.startS[i] - startS + beginS - kernel.meanDelayS;
        while (k + 1 < planned.count && planned.startS[k + 1] <= tS) k++;
        const { durationS, vx, vy, ax, ay, alongMm } = planned;
        const s = Math.min(durationS[k], Math.max(0, tS - planned.startS[k]));
        // Exact on straights, which are long; blends are short.
        const speed = Math.hypot(vx[k] + (s * ax[k]) / 2, vy[k] + (s * ay[k]) / 2);
        out.alongMm[i] = alongMm[k] + s * speed;
      }
      out.addSegments(path.segmentCount);
    },
  };
}

const pointsOf = ({ segmentCount, x, y }: RunPath): Point[] =>
  Array.from({ length: segmentCount + 1 }, (_, i) => [x[i], y[i]] as const);

function direction(points: readonly Point[], i: number): Point {
  const [a, b] = [points[i], points[i + 1]];
  const length = distance(a, b);
  return [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
}

/** The parabola at a vertex: from direction u to w at speed v takes 2 v s/A, and v² s/A of each side. */
function blendAt(points: readonly Point[], i: number, v: number, accel: number) {
  if (i + 1 >= points.length || v === 0) return null;
  const [u, w] = [direction(points, i - 1), direction(points, i)];
  const s = Math.hypot(w[0] - u[0], w[1] - u[1]) / 2;
  const durationS = (2 * v * s) / accel;
  if (!(durationS > 1e-12)) return null;
  return {
    durationS,
    reachMm: (v * v * s) / accel,
    ax: (v * (w[0] - u[0])) / durationS,
    ay: (v * (w[1] - u[1])) / durationS,
  };
}

/** Replaces the blocks from `first` on by slices of constant speed, as old firmware knows only these. */
function cutIntoSlices(blocks: BlockColumns, first: number, sliceS: number): void {
  const whole = new BlockColumns(0, false);
  for (let k = first; k < blocks.count; k++) whole.pushFrom(blocks, k);
  blocks.clockS = blocks.startS[first];
  blocks.count = first;
  for (let k = 0; k < whole.count; k++) {
    const [vx, vy, ax, ay] = [whole.vx[k], whole.vy[k], whole.ax[k], whole.ay[k]];
    const count = Math.ceil(whole.durationS[k] / sliceS);
    const d = whole.durationS[k] / count;
    for (let i = 0; i < count; i++) {
      const [t, middle] = [i * d, (i + 0.5) * d];
      const [dx, dy] = [t * (vx + (t * ax) / 2), t * (vy + (t * ay) / 2)];
      const along = whole.alongMm[k] + Math.hypot(dx, dy);
      blocks.push(d, whole.x[k] + dx, whole.y[k] + dy, vx + middle * ax, vy + middle * ay, 0, 0, along);
    }
  }
}
