/**
 * Jerk limiting by a moving average: the output is the mean of the planned motion over the last w seconds.
 *
 *     q̄(t) = 1/w ∫ q over [t − w, t]       v̄ = (q(t) − q(t−w)) / w
 *                                           ā = (v(t) − v(t−w)) / w,    j̄ = (a(t) − a(t−w)) / w
 *
 * A mean never leaves a convex limit, so |v̄| ≤ V and |ā| ≤ A; |j̄| ≤ 2 A / w, so w = 2 A / J keeps J. For an
 * input of constant acceleration a block, j̄ is constant between the instants where t or t − w passes a
 * block's end: the output is constant-jerk blocks, exactly. It takes w longer than the input. It leaves the
 * line by at most A w² / 24 (the mean of A u²/2 over |u| ≤ w/2), and not at all on a straight.
 *
 * Source: finite-impulse-response filtering of feed rates, common in machine-tool controls.
 */
import type { BlockColumns } from "./block-columns.js";
import type { RunEnd } from "./run-path.js";

/** Ends of blocks nearer in time than this fall together, s. */
const SAME_TIME = 1e-12;

export class Smoother {
  /** How fast the drawing's own line is passed at the start of each block, mm/s, and how that changes, mm/s². */
  private alongSpeed = new Float64Array(0);
  private alongAccel = new Float64Array(0);

  /** Appends the mean over `window` seconds of the run in `from`, which ends at rest at `end`. */
  write(from: BlockColumns, end: RunEnd, window: number, out: BlockColumns): void {
    const { count } = from;
    this.addRests(from, end);
    this.measureAlong(from);
    out.reserve(2 * count + 2, end.segmentCount);
    const { durationS, x: px, y: py, vx: pvx, vy: pvy, ax: pax, ay: pay, alongMm: pAlong } = from;
    const { alongSpeed, alongAccel } = this;
    const { x: outX, y: outY, vx: outVx, vy: outVy, ax: outAx, ay: outAy, startS, alongMm } = out;
    const outS = out.durationS;
    const outJx = out.jx!;
    const outJy = out.jy!;
    const per = 1 / window;
    // The window's two ends, 1 the later one: in which block, for how long already, and for how long still.
    let k1 = 0;
    let t1 = 0;
    let left1 = durationS[0]!;
    let k0 = count + 1;
    let t0 = 0;
    let left0 = window;
    let x = px[0]!;
    let y = py[0]!;
    let along = pAlong[0]!;
    let k = out.count;
    let clock = out.clockS;
    for (;;) {
      const dt = left1 < left0 ? left1 : left0;
      if (dt === Infinity) break;
      const ax1 = pax[k1]!;
      const ay1 = pay[k1]!;
      const vx1 = pvx[k1]! + t1 * ax1;
      const vy1 = pvy[k1]! + t1 * ay1;
      const ax0 = pax[k0]!;
      const ay0 = pay[k0]!;
      const vx0 = pvx[k0]! + t0 * ax0;
      const vy0 = pvy[k0]! + t0 * ay0;
      let vx = vx1 - (ax1 * window) / 2;
      let vy = vy1 - (ay1 * window) / 2;
      let ax = ax1;
      let ay = ay1;
      // Within one block the mean is known exactly; differences of far coordinates would add up over a long one.
      if (k1 !== k0) {
        const x1 = px[k1]! + (t1 * (pvx[k1]! + vx1)) / 2;
        const y1 = py[k1]! + (t1 * (pvy[k1]! + vy1)) / 2;
        const x0 = px[k0]! + (t0 * (pvx[k0]! + vx0)) / 2;
        const y0 = py[k0]! + (t0 * (pvy[k0]! + vy0)) / 2;
        vx = (x1 - x0) * per;
        vy = (y1 - y0) * per;
        ax = (vx1 - vx0) * per;
        ay = (vy1 - vy0) * per;
      }
      const jx = (ax1 - ax0) * per;
      const jy = (ay1 - ay0) * per;
      // The third coordinate of the motion: mm along the drawing.
      const speed1 = alongSpeed[k1]! + t1 * alongAccel[k1]!;
      const speed0 = alongSpeed[k0]! + t0 * alongAccel[k0]!;
      const along1 = pAlong[k1]! + (t1 * (alongSpeed[k1]! + speed1)) / 2;
      const along0 = pAlong[k0]! + (t0 * (alongSpeed[k0]! + speed0)) / 2;
      if (dt > 2 * SAME_TIME) {
        outS[k] = dt;
        outX[k] = x;
        outY[k] = y;
        outVx[k] = vx;
        outVy[k] = vy;
        outAx[k] = ax;
        outAy[k] = ay;
        outJx[k] = jx;
        outJy[k] = jy;
        startS[k] = clock;
        alongMm[k] = along;
        k++;
      }
      clock += dt;
      x += dt * (vx + dt * (ax / 2 + (dt * jx) / 6));
      y += dt * (vy + dt * (ay / 2 + (dt * jy) / 6));
      const alongAccelMean = (speed1 - speed0) * per;
      const alongJerk = (alongAccel[k1]! - alongAccel[k0]!) * per;
      along += dt * ((along1 - along0) * per + dt * (alongAccelMean / 2 + (dt * alongJerk) / 6));
      left1 -= dt;
      t1 += dt;
      if (left1 <= SAME_TIME) {
        k1++;
        t1 = 0;
        left1 = durationS[k1]!;
      }
      left0 -= dt;
      t0 += dt;
      if (left0 <= SAME_TIME) {
        k0 = k0 > count ? 0 : k0 + 1;
        t0 = 0;
        left0 = durationS[k0]!;
      }
    }
    out.count = k;
    out.clockS = clock;
  }

  /** Two blocks at rest behind the last one: where the run ends, for ever, and where it begins, from before it. */
  private addRests(from: BlockColumns, end: RunEnd): void {
    const { count } = from;
    from.reserve(2, 0);
    const { durationS, x, y, vx, vy, ax, ay, alongMm } = from;
    for (let k = count; k < count + 2; k++) vx[k] = vy[k] = ax[k] = ay[k] = 0;
    durationS[count] = durationS[count + 1] = Infinity;
    x[count] = end.x;
    y[count] = end.y;
    alongMm[count] = end.alongMm;
    x[count + 1] = x[0]!;
    y[count + 1] = y[0]!;
    alongMm[count + 1] = alongMm[0]!;
  }

  /** A block's part of the drawing is passed as fast as the block is, at its start and at its end. */
  private measureAlong({ count, durationS, vx, vy, alongMm }: BlockColumns): void {
    if (this.alongSpeed.length < count + 2) {
      const size = Math.max(count + 2, 2 * this.alongSpeed.length);
      this.alongSpeed = new Float64Array(size);
      this.alongAccel = new Float64Array(size);
    }
    const { alongSpeed, alongAccel } = this;
    let v1 = 0;
    for (let k = count + 1; k >= 0; k--) {
      const v0 = Math.sqrt(vx[k]! * vx[k]! + vy[k]! * vy[k]!);
      const perMm = v0 + v1 > 0 ? (2 * (alongMm[k + 1]! - alongMm[k]!)) / ((v0 + v1) * durationS[k]!) : 0;
      alongSpeed[k] = perMm * v0;
      alongAccel[k] = (perMm * (v1 - v0)) / durationS[k]!;
      v1 = v0;
    }
  }
}
