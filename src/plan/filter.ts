/**
 * A filter over time: the output is the mean of the planned motion q over a window of w seconds (a box).
 *
 *   u(t) = 1/w ∫ q over [t − w, t] = (Q(t) − Q(t − w)) / w        Q: the integral of q
 *
 * This is the sum of two taps: copies of the integral, each delayed and weighted. The input has constant
 * acceleration per block. So u has constant jerk as long as neither tap passes the end of a block, and the output
 * consists of blocks again, exactly. It is longer than the input by w.
 *
 * The output obeys every convex limit of the input: |v| ≤ V, |a| ≤ A. Its velocity is a difference of
 * positions, its acceleration (v(t) − v(t − w))/w, and its jerk (a(t) − a(t − w))/w, at most 2A/w.
 *
 * Deviation from the path: at most the mean of A τ²/2 over |τ| ≤ w/2, which is A w²/24; zero on a straight.
 *
 * Source: finite-impulse-response filtering of feed rates, common in machine-tool controls. impulse-filter.ts
 * has the filter of input shapers.
 */
import type { BlockColumns } from "./block-columns.js";
import type { RunEnd } from "./run-path.js";

/** Block ends closer in time than this are treated as one, s. */
const SAME_S = 1e-12;

/**
 * Appends the filtered run to `out`, which must have jerk columns. `from` holds only the blocks of this run,
 * which ends at rest at `end`. Two rows are added to `from`: rest at the end, and rest before the start.
 */
export function writeFiltered(from: BlockColumns, end: RunEnd, widthS: number, out: BlockColumns): void {
  const { count } = from;
  addRests(from, end);
  const { durationS, x: px, y: py, vx: pvx, vy: pvy, ax: pax, ay: pay } = from;
  const { alongMm } = from;
  const { rate, change } = alongRates(from, count);
  // Position of each tap in the input: its block, and the seconds since the block's start and until its end.
  const weight = [1 / widthS, -1 / widthS];
  const block = [0, count + 1];
  const since = [0, 0];
  const left = [durationS[0], widthS];
  let x = px[0];
  let y = py[0];
  let along = from.alongMm[0];
  for (;;) {
    const dt = left[1] < left[0] ? left[1] : left[0];
    if (dt === Infinity) break;
    let vx = 0;
    let vy = 0;
    let ax = 0;
    let ay = 0;
    let jx = 0;
    let jy = 0;
    let alongV = 0;
    let alongA = 0;
    let alongJ = 0;
    for (let i = 0; i < 2; i++) {
      const k = block[i];
      const t = since[i];
      const w = weight[i];
      const ax1 = pax[k];
      const ay1 = pay[k];
      const vx1 = pvx[k] + t * ax1;
      const vy1 = pvy[k] + t * ay1;
      const alongV1 = rate[k] + t * change[k];
      // The weights sum to zero, so positions are taken relative to the output's position: this keeps
      // precision far from the origin.
      vx += w * (px[k] - x + (t * (pvx[k] + vx1)) / 2);
      vy += w * (py[k] - y + (t * (pvy[k] + vy1)) / 2);
      ax += w * vx1;
      ay += w * vy1;
      jx += w * ax1;
      jy += w * ay1;
      alongV += w * (alongMm[k] - along + (t * (rate[k] + alongV1)) / 2);
      alongA += w * alongV1;
      alongJ += w * change[k];
    }
    if (block[0] === block[1]) {
      // Both taps are in one block, where the mean is known exactly. Differences would add up rounding errors.
      const k = block[0];
      const t = since[0] - widthS / 2;
      ax = pax[k]!;
      ay = pay[k]!;
      vx = pvx[k] + t * ax;
      vy = pvy[k] + t * ay;
      jx = jy = 0;
    }
    if (dt > 2 * SAME_S) {
      out.push(dt, x, y, vx, vy, ax, ay, along);
      out.setJerk(jx, jy);
    }
    x += dt * (vx + dt * (ax / 2 + (dt * jx) / 6));
    y += dt * (vy + dt * (ay / 2 + (dt * jy) / 6));
    along += dt * (alongV + dt * (alongA / 2 + (dt * alongJ) / 6));
    for (let i = 0; i < 2; i++) {
      since[i] += dt;
      left[i] -= dt;
      if (left[i] > SAME_S) continue;
      // Block 0 follows the rest before the start.
      block[i] = block[i] > count ? 0 : block[i] + 1;
      since[i] = 0;
      left[i] = durationS[block[i]]!;
    }
  }
}

/** Adds two rows after the last block: at rest at the end of the run, and at rest at its start. */
function addRests(from: BlockColumns, end: RunEnd): void {
  const [x0, y0, along0] = [from.x[0], from.y[0], from.alongMm[0]];
  from.push(Infinity, end.x, end.y, 0, 0, 0, 0, end.alongMm);
  from.push(Infinity, x0, y0, 0, 0, 0, 0, along0);
}

/** Speed along the drawing's own line at the start of each block, mm/s, and its rate of change, mm/s². */
function alongRates(
  { durationS, vx, vy, alongMm }: BlockColumns,
  count: number,
): { readonly rate: Float64Array; readonly change: Float64Array } {
  const rate = new Float64Array(count + 2);
  const change = new Float64Array(count + 2);
  let v1 = 0;
  for (let k = count - 1; k >= 0; k--) {
    const v0 = Math.sqrt(vx[k] * vx[k] + vy[k] * vy[k]);
    const perMm = v0 + v1 > 0 ? (2 * (alongMm[k + 1] - alongMm[k])) / ((v0 + v1) * durationS[k]) : 0;
    rate[k] = perMm * v0;
    change[k] = (perMm * (v1 - v0)) / durationS[k];
    v1 = v0;
  }
  return { rate, change };
}
