/**
 * The minimum time to draw a run's own line under |v| ≤ V and |a| ≤ A, computed independently of the planner:
 * cuts the line finely, takes its curvature κ, and integrates speed² backwards and forwards over the friction
 * circle (tangential acceleration ≤ √(A² − (κ v²)²), κ v² ≤ A).
 */
import type { Trajectory } from "../../src/index.js";

const STEPS = 200;

export function optimalRunTime(t: Trajectory, run: number, speed: number, accel: number): number {
  const ds: number[] = [];
  const curvature: number[] = [];
  for (let k = t.runs.firstBlock[run]; k < t.runs.firstBlock[run + 1]; k++) cutBlock(t, k, ds, curvature);
  const n = ds.length;
  if (n === 0) return 0;
  const limit = curvature.map((c) => Math.min(speed * speed, accel / c));
  const v2 = new Float64Array(n + 1);
  const gain = (at: number, piece: number): number =>
    2 * ds[piece] * Math.sqrt(Math.max(0, accel * accel - (curvature[piece] * at) ** 2));
  for (let i = n - 1; i > 0; i--) {
    v2[i] = Math.min(v2[i + 1] + gain(v2[i + 1], i), limit[i], limit[i - 1]);
  }
  for (let i = 0; i < n - 1; i++) v2[i + 1] = Math.min(v2[i] + gain(v2[i], i), v2[i + 1]);
  let time = 0;
  for (let i = 0; i < n; i++) {
    // The peak between the two ends of a piece that could be driven faster inside than at both ends.
    const sum = Math.sqrt(v2[i]) + Math.sqrt(v2[i + 1]);
    time += sum > 0 ? (2 * ds[i]) / sum : 2 * Math.sqrt(ds[i] / accel);
  }
  return time;
}

/** Cuts block `k` into pieces. Straight ones are cut finer towards the ends, where speed changes most. */
function cutBlock(t: Trajectory, k: number, ds: number[], curvature: number[]): void {
  const at = (u: number): readonly [number, number, number, number] => {
    const { x, y, vx, vy, ax, ay } = t;
    return [
      x[k] + vx[k] * u + (ax[k] * u * u) / 2,
      y[k] + vy[k] * u + (ay[k] * u * u) / 2,
      vx[k] + ax[k] * u,
      vy[k] + ay[k] * u,
    ];
  };
  const duration = t.durationS[k];
  let [x, y] = at(0);
  for (let i = 1; i <= STEPS; i++) {
    const [, , vx, vy] = at((duration * (i - 0.5)) / STEPS);
    const [x1, y1] = at((duration * i) / STEPS);
    const v = Math.hypot(vx, vy);
    ds.push(Math.hypot(x1 - x, y1 - y));
    curvature.push(v > 0 ? Math.abs(vx * t.ay[k] - vy * t.ax[k]) / v ** 3 : 0);
    [x, y] = [x1, y1];
  }
}
