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

/** One end of the window, walking through the blocks; at rest before the first and after the last. */
class Walker {
  k = -1;
  private t = 0;
  private startAlongSpeed = 0;
  x: number;
  y: number;
  vx = 0;
  vy = 0;
  ax = 0;
  ay = 0;
  /** mm along the drawing, its speed and its acceleration: the third coordinate of the motion. */
  along: number;
  alongSpeed = 0;
  alongAccel = 0;
  /** Seconds until this end reaches the end of its block. */
  left: number;

  constructor(
    private readonly from: BlockColumns,
    private readonly end: RunEnd,
    delay: number,
  ) {
    this.x = from.x[0]!;
    this.y = from.y[0]!;
    this.along = from.alongMm[0]!;
    this.left = delay;
    if (!(delay > 0)) this.enter();
  }

  advance(dt: number): void {
    if (this.left - dt <= SAME_TIME) return this.enter();
    this.left -= dt;
    const { k, from } = this;
    if (k < 0 || k >= from.count) return;
    this.t += dt;
    const t = this.t;
    this.x = from.x[k]! + t * (from.vx[k]! + (t * this.ax) / 2);
    this.y = from.y[k]! + t * (from.vy[k]! + (t * this.ay) / 2);
    this.vx = from.vx[k]! + t * this.ax;
    this.vy = from.vy[k]! + t * this.ay;
    this.along = from.alongMm[k]! + t * (this.startAlongSpeed + (t * this.alongAccel) / 2);
    this.alongSpeed = this.startAlongSpeed + t * this.alongAccel;
  }

  private enter(): void {
    const { from } = this;
    const k = ++this.k;
    this.t = 0;
    const inside = k < from.count;
    this.left = inside ? from.durationS[k]! : Infinity;
    this.x = inside ? from.x[k]! : this.end.x;
    this.y = inside ? from.y[k]! : this.end.y;
    this.vx = inside ? from.vx[k]! : 0;
    this.vy = inside ? from.vy[k]! : 0;
    this.ax = inside ? from.ax[k]! : 0;
    this.ay = inside ? from.ay[k]! : 0;
    this.along = inside ? from.alongMm[k]! : this.end.alongMm;
    this.startAlong(inside ? k : -1);
  }

  /** The block's part of the drawing is passed as fast as the block is, at its start and at its end. */
  private startAlong(k: number): void {
    const { from } = this;
    if (k < 0) {
      this.alongSpeed = this.alongAccel = 0;
      return;
    }
    const duration = from.durationS[k]!;
    const mm = (k + 1 < from.count ? from.alongMm[k + 1]! : this.end.alongMm) - from.alongMm[k]!;
    const vx1 = this.vx + duration * this.ax;
    const vy1 = this.vy + duration * this.ay;
    const v0 = Math.sqrt(this.vx * this.vx + this.vy * this.vy);
    const v1 = Math.sqrt(vx1 * vx1 + vy1 * vy1);
    const perMm = v0 + v1 > 0 ? (2 * mm) / ((v0 + v1) * duration) : 0;
    this.startAlongSpeed = this.alongSpeed = perMm * v0;
    this.alongAccel = (perMm * (v1 - v0)) / duration;
  }
}

/** Appends the mean over `window` seconds of the run in `from`, which ends at rest at `end`. */
export function writeSmoothed(from: BlockColumns, end: RunEnd, window: number, out: BlockColumns): void {
  out.reserve(2 * from.count + 2, end.segmentCount);
  const { durationS, startS, alongMm } = out;
  const jxOut = out.jx!;
  const jyOut = out.jy!;
  const lead = new Walker(from, end, 0);
  const trail = new Walker(from, end, window);
  let x = lead.x;
  let y = lead.y;
  let along = lead.along;
  let k = out.count;
  let clock = out.clockS;
  for (;;) {
    const dt = lead.left < trail.left ? lead.left : trail.left;
    if (dt === Infinity) break;
    // Within one block the mean is known exactly; differences of far coordinates would add up over a long one.
    const same = lead.k === trail.k;
    const vx = same ? lead.vx - (lead.ax * window) / 2 : (lead.x - trail.x) / window;
    const vy = same ? lead.vy - (lead.ay * window) / 2 : (lead.y - trail.y) / window;
    const ax = same ? lead.ax : (lead.vx - trail.vx) / window;
    const ay = same ? lead.ay : (lead.vy - trail.vy) / window;
    const alongSpeed = (lead.along - trail.along) / window;
    const alongAccel = (lead.alongSpeed - trail.alongSpeed) / window;
    const alongJerk = (lead.alongAccel - trail.alongAccel) / window;
    const jx = (lead.ax - trail.ax) / window;
    const jy = (lead.ay - trail.ay) / window;
    if (dt > 2 * SAME_TIME) {
      durationS[k] = dt;
      out.x[k] = x;
      out.y[k] = y;
      out.vx[k] = vx;
      out.vy[k] = vy;
      out.ax[k] = ax;
      out.ay[k] = ay;
      jxOut[k] = jx;
      jyOut[k] = jy;
      startS[k] = clock;
      alongMm[k] = along;
      k++;
    }
    clock += dt;
    x += dt * (vx + dt * (ax / 2 + (dt * jx) / 6));
    y += dt * (vy + dt * (ay / 2 + (dt * jy) / 6));
    along += dt * (alongSpeed + dt * (alongAccel / 2 + (dt * alongJerk) / 6));
    lead.advance(dt);
    trail.advance(dt);
  }
  out.count = k;
  out.clockS = clock;
}
