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
import type { BlockColumns } from "../block-columns.js";
import type { RunEnd } from "../run-path.js";

/** Block ends closer in time than this are treated as one, s. */
const SAME_S = 1e-12;

/**
 * Appends the filtered run to `out`, which must have jerk columns. `from` holds only the blocks of this run,
 * which ends at rest at `end`. Two rows are added to `from`: rest at the end, and rest before the start.
 */
export function writeFiltered(from: BlockColumns, end: RunEnd, widthS: number, out: BlockColumns): void {
  const { count } = from;
  addRests(from, end);
  const { durationS, x: px, y: py, vx: pvx, vy: pvy, ax: pax, ay: pay, alongMm } = from;
  const { rate, change } = alongRates(from, count);
  const per = 1 / widthS;
  // The taps: 1 is not delayed, 0 is delayed by w. For each: its block, and the seconds since the block's start and
  // until its end.
  let k1 = 0;
  let t1 = 0;
  let left1 = durationS[0];
  let k0 = count + 1;
  let t0 = 0;
  let left0 = widthS;
  let x = px[0];
  let y = py[0];
  let along = alongMm[0];
  for (;;) {
    const dt = Math.min(left0, left1);
    if (dt === Infinity) break;
    let vx: number;
    let vy: number;
    let ax: number;
    let ay: number;
    let jx = 0;
    let jy = 0;
    if (k0 === k1) {
      // Both taps are in one block, where the mean is known exactly. Differences would add up rounding errors.
      const t = t1 - widthS / 2;
      ax = pax[k1];
      ay = pay[k1];
      vx = pvx[k1] + t * ax;
      vy = pvy[k1] + t * ay;
    } else {
      const vx1 = pvx[k1] + t1 * pax[k1];
      const vy1 = pvy[k1] + t1 * pay[k1];
      const vx0 = pvx[k0] + t0 * pax[k0];
      const vy0 = pvy[k0] + t0 * pay[k0];
      // Differences between the blocks' positions come first: this keeps precision far from the origin.
      vx = per * (px[k1] - px[k0] + (t1 * (pvx[k1] + vx1) - t0 * (pvx[k0] + vx0)) / 2);
      vy = per * (py[k1] - py[k0] + (t1 * (pvy[k1] + vy1) - t0 * (pvy[k0] + vy0)) / 2);
      ax = per * (vx1 - vx0);
      ay = per * (vy1 - vy0);
      jx = per * (pax[k1] - pax[k0]);
      jy = per * (pay[k1] - pay[k0]);
    }
    const rate1 = rate[k1] + t1 * change[k1];
    const rate0 = rate[k0] + t0 * change[k0];
    const covered = (t1 * (rate[k1] + rate1) - t0 * (rate[k0] + rate0)) / 2;
    const alongV = per * (alongMm[k1] - alongMm[k0] + covered);
    const alongA = per * (rate1 - rate0);
    const alongJ = per * (change[k1] - change[k0]);
    if (dt > 2 * SAME_S) {
      const k = out.add(dt);
      out.x[k] = x;
      out.y[k] = y;
      out.vx[k] = vx;
      out.vy[k] = vy;
      out.ax[k] = ax;
      out.ay[k] = ay;
      out.alongMm[k] = along;
      if (out.jx !== null) out.jx[k] = jx;
      if (out.jy !== null) out.jy[k] = jy;
    }
    x += dt * (vx + dt * (ax / 2 + (dt * jx) / 6));
    y += dt * (vy + dt * (ay / 2 + (dt * jy) / 6));
    along += dt * (alongV + dt * (alongA / 2 + (dt * alongJ) / 6));
    t1 += dt;
    left1 -= dt;
    if (left1 <= SAME_S) {
      k1++;
      t1 = 0;
      left1 = durationS[k1];
    }
    t0 += dt;
    left0 -= dt;
    if (left0 <= SAME_S) {
      // Block 0 follows the rest before the start.
      k0 = k0 > count ? 0 : k0 + 1;
      t0 = 0;
      left0 = durationS[k0];
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
