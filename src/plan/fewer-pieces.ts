/**
 * Two pieces of constant acceleration in the place of three, or three in the place of four, from the same state to the same
 * state.
 *
 *   v0      w1      w2      v1         velocities at the knots
 *   |---h1--|---h2--|---h3--|          durations of the new pieces
 *
 *   two     w1 = (2 Δp − h1 v0 − h2 v1)/(h1 + h2)                the velocity at the knot follows from the way
 *   three   (h1 + h2) w1 + (h2 + h3) w2 = 2 Δp − h1 v0 − h3 v1   w1 is free, and w2 = q − r w1
 *
 * How far they leave the plan's line is foreseen from the old pieces, at their knots and middles, where their own distance from
 * it is known (it shrinks or grows by how far the new ones pass beside them). All that is linear in w1:
 *
 *   distance to the left = base + slope (u × w1)        u: the old pieces' direction there
 *
 * With three pieces w1 is found by least squares over the places, and then brought within the limits: |w1| ≤ V, |w2| ≤ V and
 * |a| ≤ A of each piece are five discs for w1.
 */
import type { BlockColumns } from "./block-columns.js";
import type { PieceNotes } from "./piece-notes.js";
import { SLACK } from "./limits.js";

/** What knots may use of the slack that limits have. */
const HARDLY = 1.0004;

/** How much the velocity that was there weighs against the distances: on a straight line it is all that matters. */
const STEADY = 0.003;

/** Rounds in which w1 is brought to each disc in its turn; a little more than the disc will do. */
const ROUNDS = 3;
const INSIDE = 1.0001;

/** Old pieces at most; places looked at. */
const PIECES = 4;
const PLACES = 2 * PIECES - 1;
const DISCS = 5;

export class FewerPieces {
  /** How many new pieces: one less than there were. */
  count = 0;
  /** How far they may be from the line, mm; and how far they are, or Infinity where a limit is broken. */
  most = 0;
  far = 0;
  /** Durations of the new pieces, and velocities where they begin and end, from v0 to v1. */
  readonly h = new Float64Array(PIECES - 1);
  readonly vx = new Float64Array(PIECES);
  readonly vy = new Float64Array(PIECES);
  /** Seconds that the old ones took. */
  private oldS = 0;
  private dx = 0;
  private dy = 0;
  private speed = 0;
  private accel = 0;
  /** Of three pieces: w2 = q − r w1. */
  private r = 0;
  private qx = 0;
  private qy = 0;
  private places = 0;
  /** Of each place of the old pieces: when; direction; distance if the pen were at the beginning or end; u × v0, u × v1. */
  private readonly t = new Float64Array(PLACES);
  private readonly ux = new Float64Array(PLACES);
  private readonly uy = new Float64Array(PLACES);
  private readonly off0 = new Float64Array(PLACES);
  private readonly off1 = new Float64Array(PLACES);
  private readonly turn0 = new Float64Array(PLACES);
  private readonly turn1 = new Float64Array(PLACES);
  private readonly base = new Float64Array(PLACES);
  private readonly slope = new Float64Array(PLACES);
  private readonly discX = new Float64Array(DISCS);
  private readonly discY = new Float64Array(DISCS);
  private readonly discR = new Float64Array(DISCS);

  /** Looks at pieces [i, i + old); the state in which they end stands at i + old. */
  open(pieces: BlockColumns, notes: PieceNotes, i: number, old: number, speed: number, accel: number): void {
    const end = i + old;
    const { durationS, x, y, vx, vy } = pieces;
    const { vx: wx, vy: wy } = this;
    this.dx = x[end]! - x[i]!;
    this.dy = y[end]! - y[i]!;
    wx[0] = vx[i]!;
    wy[0] = vy[i]!;
    wx[old - 1] = vx[end]!;
    wy[old - 1] = vy[end]!;
    this.count = old - 1;
    this.places = 0;
    const { knot, middle, knotUx, knotUy, middleX, middleY, middleUx, middleUy } = notes;
    const x0 = x[i]!;
    const y0 = y[i]!;
    let t = 0;
    for (let p = i; p < end; p++) {
      if (p > i) this.see(t, x[p]! - x0, y[p]! - y0, knotUx[p]!, knotUy[p]!, knot[p]!);
      const d = durationS[p]!;
      this.see(t + d / 2, middleX[p]! - x0, middleY[p]! - y0, middleUx[p]!, middleUy[p]!, middle[p]!);
      t += d;
    }
    this.oldS = t;
    this.speed = speed * HARDLY;
    this.accel = accel * (SLACK - 2 * (INSIDE - 1));
  }

  private see(t: number, x: number, y: number, ux: number, uy: number, left: number): void {
    const i = this.places++;
    const { vx, vy, count } = this;
    this.t[i] = t;
    this.ux[i] = ux;
    this.uy[i] = uy;
    this.off0[i] = left - ux * y + uy * x;
    this.off1[i] = left + ux * (this.dy - y) - uy * (this.dx - x);
    this.turn0[i] = ux * vy[0]! - uy * vx[0]!;
    this.turn1[i] = ux * vy[count]! - uy * vx[count]!;
  }

  /**
   * Two pieces of h₁ and h₂ seconds. Finds w1, and says whether they are nearer to the line than `most`; if not, `far` is how far
   * they are at least. (They are fields because numbers given and returned are boxed at each call.)
   */
  solveTwo(): boolean {
    const { h, vx, vy, speed, accel, t, ux, uy, off0, off1, turn0, turn1, most } = this;
    const h1 = h[0]!;
    const h2 = h[1]!;
    const T = h1 + h2;
    const wx = (2 * this.dx - h1 * vx[0]! - h2 * vx[2]!) / T;
    const wy = (2 * this.dy - h1 * vy[0]! - h2 * vy[2]!) / T;
    this.far = Infinity;
    if (!(wx * wx + wy * wy <= speed * speed)) return false;
    if (!isWithin(wx - vx[0]!, wy - vy[0]!, accel * h1)) return false;
    if (!isWithin(vx[2]! - wx, vy[2]! - wy, accel * h2)) return false;
    const { places } = this;
    const later = T / this.oldS;
    const per1 = 1 / (2 * h1);
    const per2 = 1 / (2 * h2);
    let far = 0;
    for (let s = 0; s < places; s++) {
      const u = t[s]! * later;
      const turn = ux[s]! * wy - uy[s]! * wx;
      let left: number;
      if (u <= h1) {
        const g = u * u * per1;
        left = off0[s]! + (u - g) * turn0[s]! + g * turn;
      } else {
        const d = T - u;
        const g = d * d * per2;
        left = off1[s]! - (d - g) * turn1[s]! - g * turn;
      }
      const off = Math.abs(left);
      if (!(off <= far)) far = off;
      if (!(far < most)) break;
    }
    vx[1] = wx;
    vy[1] = wy;
    this.far = far;
    return far < most;
  }

  /**
   * Three pieces of h₁, h₂ and h₃ seconds; w1 is about what it should be. Finds it, and says whether they are nearer to the line
   * than `most`.
   */
  solveThree(): boolean {
    const { h, vx, vy, t, ux, uy, off0, off1, turn0, turn1, base, slope } = this;
    const h1 = h[0]!;
    const h2 = h[1]!;
    const h3 = h[2]!;
    this.far = Infinity;
    const r = (h1 + h2) / (h2 + h3);
    const qx = (2 * this.dx - h1 * vx[0]! - h3 * vx[3]!) / (h2 + h3);
    const qy = (2 * this.dy - h1 * vy[0]! - h3 * vy[3]!) / (h2 + h3);
    // No w1 keeps both itself and w2 below the limit of speed.
    const reach = (1 + r) * this.speed;
    if (qx * qx + qy * qy > reach * reach) return false;
    const T = h1 + h2 + h3;
    const later = T / this.oldS;
    const per1 = 1 / (2 * h1);
    const per2 = 1 / (2 * h2);
    const per3 = 1 / (2 * h3);
    let n1 = 0;
    let n2 = 0;
    let n3 = 0;
    let bx = 0;
    let by = 0;
    let sum = 0;
    for (let s = 0; s < PLACES; s++) {
      const u = t[s]! * later;
      const ex = ux[s]!;
      const ey = uy[s]!;
      let g: number;
      let b: number;
      if (u <= h1) {
        g = u * u * per1;
        b = off0[s]! + (u - g) * turn0[s]!;
      } else if (u <= h1 + h2) {
        const d = u - h1;
        const f = d * d * per2;
        g = h1 / 2 + d - f * (1 + r);
        b = off0[s]! + (h1 / 2) * turn0[s]! + f * (ex * qy - ey * qx);
      } else {
        const d = T - u;
        const f = d * d * per3;
        g = r * f;
        b = off1[s]! - (d - f) * turn1[s]! - f * (ex * qy - ey * qx);
      }
      slope[s] = g;
      base[s] = b;
      const g2 = g * g;
      sum += g2;
      n1 += g2 * ey * ey;
      n2 -= g2 * ex * ey;
      n3 += g2 * ex * ex;
      bx += g * b * ey;
      by -= g * b * ex;
    }
    const steady = STEADY * sum;
    n1 += steady;
    n3 += steady;
    bx += steady * vx[1]!;
    by += steady * vy[1]!;
    const inverse = 1 / (n1 * n3 - n2 * n2);
    vx[1] = (bx * n3 - by * n2) * inverse;
    vy[1] = (by * n1 - bx * n2) * inverse;
    if (!this.isNear()) return false;
    this.r = r;
    this.qx = qx;
    this.qy = qy;
    if (!this.keepsLimits() && !(this.bringWithin() && this.isNear())) return false;
    vx[2] = qx - r * vx[1];
    vy[2] = qy - r * vy[1];
    return true;
  }

  /** Whether three pieces with this w1 are nearer to the line than `most`. */
  private isNear(): boolean {
    const { ux, uy, base, slope, most } = this;
    const wx = this.vx[1]!;
    const wy = this.vy[1]!;
    let far = 0;
    for (let s = 0; s < PLACES; s++) {
      const off = Math.abs(base[s]! + slope[s]! * (ux[s]! * wy - uy[s]! * wx));
      if (!(off <= far)) far = off;
    }
    this.far = far;
    return far < most;
  }

  private keepsLimits(): boolean {
    const { h, vx, vy, accel, speed, r, qx, qy } = this;
    const wx = vx[1]!;
    const wy = vy[1]!;
    const zx = qx - r * wx;
    const zy = qy - r * wy;
    return (
      isWithin(wx - vx[0]!, wy - vy[0]!, accel * h[0]!) &&
      isWithin(zx - wx, zy - wy, accel * h[1]!) &&
      isWithin(vx[3]! - zx, vy[3]! - zy, accel * h[2]!) &&
      isWithin(wx, wy, speed) &&
      isWithin(zx, zy, speed)
    );
  }

  /** Moves w1 to where all limits are kept; false where that is not found. */
  private bringWithin(): boolean {
    const { h, vx, vy, accel, speed, discX, discY, discR, r, qx, qy } = this;
    discX[0] = vx[0]!;
    discY[0] = vy[0]!;
    discR[0] = accel * h[0]!;
    discX[1] = qx / (1 + r);
    discY[1] = qy / (1 + r);
    discR[1] = (accel * h[1]!) / (1 + r);
    discX[2] = (qx - vx[3]!) / r;
    discY[2] = (qy - vy[3]!) / r;
    discR[2] = (accel * h[2]!) / r;
    discX[3] = discY[3] = 0;
    discR[3] = speed;
    discX[4] = qx / r;
    discY[4] = qy / r;
    discR[4] = speed / r;
    let wx = vx[1]!;
    let wy = vy[1]!;
    for (let round = 0; round < ROUNDS; round++) {
      let isInside = true;
      for (let c = 0; c < DISCS; c++) {
        const ex = wx - discX[c]!;
        const ey = wy - discY[c]!;
        const d2 = ex * ex + ey * ey;
        if (!(d2 > (discR[c]! * INSIDE) ** 2)) continue;
        isInside = false;
        const nearer = discR[c]! / Math.sqrt(d2);
        wx = discX[c]! + ex * nearer;
        wy = discY[c]! + ey * nearer;
      }
      if (!isInside) continue;
      vx[1] = wx;
      vy[1] = wy;
      return true;
    }
    return false;
  }
}

const isWithin = (x: number, y: number, r: number): boolean => x * x + y * y <= r * r;
