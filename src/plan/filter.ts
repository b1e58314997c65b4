/**
 * A filter over time: the output is a weighted mean of the planned motion q at earlier instants.
 *
 *   impulses   u(t) = Σ Aᵢ q(t − tᵢ)              Σ Aᵢ = 1
 *   box        u(t) = 1/w ∫ q over [t − w, t]     = (Q(t) − Q(t − w)) / w        Q: the integral of q
 *
 * Both are a sum of taps: copies of the motion (or of its integral), each delayed and weighted. x and y may
 * have different weights. If the input has constant acceleration per block, u has constant acceleration
 * (impulses) or constant jerk (box) between any two instants at which a tap passes the end of a block. So the
 * output consists of blocks again, exactly. It is longer than the input by the delay of the last tap.
 *
 * With weights Aᵢ ≥ 0, as in a box, the output obeys every convex limit of the input: |v| ≤ V, |a| ≤ A. For a
 * box, the output's velocity is a difference of positions, its acceleration (v(t) − v(t − w))/w, and its jerk
 * (a(t) − a(t − w))/w, at most 2A/w.
 *
 * Deviation of a box from the path: the mean of A u²/2 over |u| ≤ w/2, which is A w²/24; zero on a straight.
 *
 * Source: finite-impulse-response filtering of feed rates, common in machine-tool controls.
 */
import type { BlockColumns } from "./block-columns.js";
import type { RunEnd } from "./run-path.js";

/** A copy of the motion: its delay, and its weight in either axis. */
interface Tap {
  readonly delayS: number;
  readonly x: number;
  readonly y: number;
}

/** A copy of the motion of one axis. */
export interface Impulse {
  readonly delayS: number;
  readonly weight: number;
}

export interface Kernel {
  /** Sorted by delay; the first delay is 0. */
  readonly taps: readonly Tap[];
  /** What the taps copy: the motion itself, or its integral over time. */
  readonly of: "motion" | "integral";
  /** Mean delay of the output, s; the same in both axes. */
  readonly meanDelayS: number;
  /** Delay of the last tap, s: how much longer the output is than the input. */
  readonly lengthS: number;
}

export function boxKernel(widthS: number): Kernel {
  const weight = 1 / widthS;
  const taps = [
    { delayS: 0, x: weight, y: weight },
    { delayS: widthS, x: -weight, y: -weight },
  ];
  return { taps, of: "integral", meanDelayS: widthS / 2, lengthS: widthS };
}

/**
 * Impulses for each axis. The axis with the shorter mean delay is delayed further, so that both have the same
 * mean delay: otherwise straight lines would bend.
 */
export function impulseKernel(x: readonly Impulse[], y: readonly Impulse[]): Kernel {
  const [meanX, meanY] = [meanDelayOf(x), meanDelayOf(y)];
  const meanDelayS = Math.max(meanX, meanY);
  const taps: Tap[] = [
    ...x.map(({ delayS, weight }) => ({ delayS: delayS + meanDelayS - meanX, x: weight, y: 0 })),
    ...y.map(({ delayS, weight }) => ({ delayS: delayS + meanDelayS - meanY, x: 0, y: weight })),
  ];
  const all = joined(taps);
  return { taps: all, of: "motion", meanDelayS, lengthS: all[all.length - 1].delayS };
}

const meanDelayOf = (impulses: readonly Impulse[]): number =>
  impulses.reduce((sum, { delayS, weight }) => sum + weight * delayS, 0);

/** Sorted by delay; taps of the same delay become one. */
function joined(taps: readonly Tap[]): Tap[] {
  const out: Tap[] = [];
  for (const tap of [...taps].sort((a, b) => a.delayS - b.delayS)) {
    const last = out[out.length - 1];
    if (last === undefined || tap.delayS - last.delayS > SAME_S) out.push(tap);
    else out[out.length - 1] = { delayS: last.delayS, x: last.x + tap.x, y: last.y + tap.y };
  }
  return out;
}

/** Block ends closer in time than this are treated as one, s. */
const SAME_S = 1e-12;

/**
 * Appends the filtered run to `out`, which must have jerk columns. `from` holds only the blocks of this run,
 * which ends at rest at `end`. Two rows are added to `from`: rest at the end, and rest before the start.
 */
export function writeFiltered(from: BlockColumns, end: RunEnd, kernel: Kernel, out: BlockColumns): void {
  const { taps, meanDelayS } = kernel;
  const { count } = from;
  addRests(from, end);
  const { durationS, x: px, y: py, vx: pvx, vy: pvy, ax: pax, ay: pay } = from;
  const { alongMm } = from;
  const isIntegral = kernel.of === "integral";
  // Of impulses the place along the drawing is set later (shaped-along.ts).
  const { rate, change } = isIntegral ? alongRates(from, count) : NO_RATES;
  // Position of each tap in the input: its block, the seconds since the start of that block, and the seconds
  // left in it.
  const n = taps.length;
  const weightsX = taps.map(({ x }) => x);
  const weightsY = taps.map(({ y }) => y);
  const block = taps.map(({ delayS }) => (delayS > 0 ? count + 1 : 0));
  const since = taps.map(() => 0);
  const left = taps.map(({ delayS }) => (delayS > 0 ? delayS : durationS[0]));
  let x = px[0];
  let y = py[0];
  let along = from.alongMm[0];
  for (;;) {
    let dt = Infinity;
    let isOneBlock = true;
    for (let i = 0; i < n; i++) {
      if (left[i] < dt) dt = left[i]!;
      if (block[i] !== block[0]) isOneBlock = false;
    }
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
    if (!isIntegral) x = y = 0;
    for (let i = 0; i < n; i++) {
      const k = block[i];
      const t = since[i];
      const weightX = weightsX[i];
      const weightY = weightsY[i];
      const ax1 = pax[k];
      const ay1 = pay[k];
      const vx1 = pvx[k] + t * ax1;
      const vy1 = pvy[k] + t * ay1;
      if (isIntegral) {
        const alongV1 = rate[k] + t * change[k];
        // The weights sum to zero, so positions are taken relative to the output's position: this keeps
        // precision far from the origin.
        vx += weightX * (px[k] - x + (t * (pvx[k] + vx1)) / 2);
        vy += weightY * (py[k] - y + (t * (pvy[k] + vy1)) / 2);
        ax += weightX * vx1;
        ay += weightY * vy1;
        jx += weightX * ax1;
        jy += weightY * ay1;
        alongV += weightX * (alongMm[k] - along + (t * (rate[k] + alongV1)) / 2);
        alongA += weightX * alongV1;
        alongJ += weightX * change[k];
      } else {
        x += weightX * (px[k] + (t * (pvx[k] + vx1)) / 2);
        y += weightY * (py[k] + (t * (pvy[k] + vy1)) / 2);
        vx += weightX * vx1;
        vy += weightY * vy1;
        ax += weightX * ax1;
        ay += weightY * ay1;
      }
    }
    if (isOneBlock) {
      // Within a single block the mean is known exactly; rounding errors of differences would add up over a
      // long block.
      const k = block[0];
      const t = since[0] - meanDelayS;
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
    for (let i = 0; i < n; i++) {
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

const NO_RATES = { rate: new Float64Array(0), change: new Float64Array(0) };

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
