/**
 * The line that corner curves are planned on: within δ of the drawing, but softer, so that it can be drawn faster.
 *
 *   δ     mm    corner deviation            s     sin(φ/2), φ the turn at a point
 *   ℓ/2   mm    half of the shorter segment at a point
 *   room  mm    how far from its own point each corner's curve may pass
 *
 *          ·       P' moved, outwards          A sharp corner's curve may pass at δ inside of the corner P. Moved
 *        ·   ·                                 outwards by up to δ, it is rounder by as much.
 *      ·   P   ·
 *    ·   / ‿ \   ·  the curve, of P'           Bends are moved to where the line bends least (least-bending.ts): tight
 *      /       \                               places become wider, and small unevenness goes, which would only be
 *    /  drawing  \                             braked and sped up for.
 *
 * Three kinds of points: corners too sharp for their curve to use half of a segment (ℓ s/2 > 2 δ), moved outwards; bends
 * below SMOOTH that A slows down, moved to bend less; others stay. Points of bends are also moved along the line
 * (EVEN), for a curve at a point can be no longer than the shorter segment allows.
 *
 * Why that stays within δ. Every point P' is within δ of its P, so each segment P'Q' lies in the stadium of PQ: the
 * places within δ of it, which is convex. A corner's curve crosses the bisector at some M. If M is within δ of P, the
 * control points of the part before it (two on the segment, and M) lie in the stadium of the segment before P, and so does
 * that part; the other part likewise. M is at most `room` from P', inwards, so with b the unit vector of that direction
 *
 *     room = −d·b + √(δ² − |d|² + (d·b)²)       d = P' − P
 *
 * Where a point has first been moved along the line by τ, segments leave the drawing by at most τ (s + half of the next
 * point's s); that much is taken from δ at the point and at its neighbours.
 */
import { capSegments, type RunLimits } from "./limits.js";
import { LeastBending } from "./least-bending.js";
import { RunPath } from "./run-path.js";

/** Largest s of a bend that counts as a curve's (41°). */
const SMOOTH = 0.35;
/** Curves that A lets be drawn at this many times V², or faster, are left alone. */
const FAST = 4;
/** Share of the difference of two lengths that a point is moved along the line to even them out. */
const EVEN = 0.3;
/** Moving along the line must leave that share of δ. */
const LEFT = 0.75;
/** Two neighbours are not moved apart or together by more than this share of their segment. */
const SHEAR = 0.5;
/** Below this s it is not yet said to which side the line will bend. */
const HARDLY = 0.015;
/** Below this s a line is straight. */
const STRAIGHT = 1e-12;

/** A point that may be moved to bend less, among mm outwards. */
const FREE = -1;

/** What there is to gain on a path. */
const NOTHING = 0;
const CORNERS = 1;
const BENDS = 2;

export class SoftLine {
  /** mm: how far each corner's curve may pass from its point. */
  room = new Float64Array(0);
  /** mm: how much of the drawing each segment stands for. */
  along = new Float64Array(0);
  private readonly even = new RunPath();
  private readonly soft = new RunPath();
  private readonly bending = new LeastBending();
  /** s at each point of the drawing, then of the evened line. */
  private sine = new Float64Array(0);
  /** mm outwards at corners; FREE where the line may bend, 0 where points stay. */
  private kind = new Float64Array(0);
  /** mm forwards along the line. */
  private forward = new Float64Array(0);
  /** mm of δ that moving along the line takes at each point, and what it leaves there. */
  private taken = new Float64Array(0);
  private left = new Float64Array(0);
  /** mm from the evened line. */
  private shiftX = new Float64Array(0);
  private shiftY = new Float64Array(0);
  /** Of each segment of the evened line: 1 where its ends would be moved apart too far. */
  private isSheared = new Uint8Array(0);

  /**
   * The line to plan on: as many points as `path`, and from end to end; `path` itself where nothing is gained. `cap2` is
   * filled. Good until the next call.
   */
  of(path: RunPath, limits: RunLimits): RunPath {
    const n = path.segmentCount;
    this.reserve(n + 1);
    capSegments(path, limits);
    const curves = this.sort(path, limits);
    if (curves === NOTHING) return this.same(path, limits);
    this.evenOut(path, limits.corner);
    this.bound(limits.corner);
    if (curves === BENDS) this.bending.solve(n, this.even.length);
    if (!this.move(n)) return this.same(path, limits);
    const { soft } = this;
    capSegments(soft, limits);
    this.measureRoom(n);
    return soft;
  }

  private same(path: RunPath, limits: RunLimits): RunPath {
    this.room.fill(limits.corner, 0, path.segmentCount + 1);
    this.along.set(path.length.subarray(0, path.segmentCount));
    return path;
  }

  /** Says of each point how it may move. */
  private sort(path: RunPath, { accel, corner }: RunLimits): number {
    const { segmentCount: n, length, ux, uy, cap2 } = path;
    const { sine, kind } = this;
    let found = NOTHING;
    sine[0] = sine[n] = kind[0] = kind[n] = 0;
    for (let i = 1; i < n; i++) {
      const dx = ux[i]! - ux[i - 1]!;
      const dy = uy[i]! - uy[i - 1]!;
      const s = Math.sqrt(dx * dx + dy * dy) / 2;
      const half = Math.min(length[i - 1]!, length[i]!) / 2;
      const v2 = Math.min(cap2[i - 1]!, cap2[i]!);
      sine[i] = s;
      kind[i] = 0;
      if (half * s > 2 * corner) {
        const outwards = Math.min(corner, (half * s) / 2 - corner, (v2 * s * s) / (2 * accel) - corner);
        if (!(outwards > 0)) continue;
        kind[i] = outwards;
        if (found === NOTHING) found = CORNERS;
      } else if (s <= SMOOTH && accel * half < FAST * v2 * s) {
        kind[i] = FREE;
        found = BENDS;
      }
    }
    return found;
  }

  /** Moves points of bends along the line, away from the nearer neighbour. */
  private evenOut(path: RunPath, corner: number): void {
    const { segmentCount: n, x, y, length, ux, uy } = path;
    const { even, sine, kind, forward, taken, along } = this;
    even.beLike(path);
    even.x.set(x.subarray(0, n + 1));
    even.y.set(y.subarray(0, n + 1));
    const mayLeave = (1 - LEFT) * corner;
    forward[0] = taken[0] = 0;
    for (let i = 1; i <= n; i++) {
      const before = length[i - 1]!;
      let tau = 0;
      taken[i] = 0;
      if (kind[i] === FREE) {
        const after = length[i]!;
        const s = sine[i]!;
        const leaves = s + Math.max(sine[i - 1]!, sine[i + 1]!) / 2;
        let most = (SHEAR / 2) * Math.min(before, after);
        if (most * leaves > mayLeave) most = mayLeave / leaves;
        tau = Math.max(-most, Math.min(most, EVEN * (after - before)));
        taken[i] = Math.abs(tau) * leaves;
        const per = tau * halfPerCosine(s * s);
        even.x[i] = x[i]! + per * (ux[i - 1]! + ux[i]!);
        even.y[i] = y[i]! + per * (uy[i - 1]! + uy[i]!);
      }
      forward[i] = tau;
      along[i - 1] = before + tau - forward[i - 1]!;
    }
    even.measure();
  }

  /** Turns of the evened line, and how far its points may go to the left and to the right. */
  private bound(corner: number): void {
    const { segmentCount: n, length, ux, uy } = this.even;
    const { sine, kind, taken, left, bending } = this;
    bending.reserve(n + 1);
    const { low, high, turn } = bending;
    // How far a curve of its own radius passes inside of a point, of this point and its neighbours: more than is left then
    // would have it slow down again.
    let depth0 = 0;
    let depth1 = 0;
    let taken0 = 0;
    let taken1 = 0;
    for (let i = 0; i <= n; i++) {
      const k = i + 1;
      let depth2 = 0;
      sine[k] = turn[k] = 0;
      if (k < n) {
        const dx = ux[k]! - ux[i]!;
        const dy = uy[k]! - uy[i]!;
        const s = Math.sqrt(dx * dx + dy * dy) / 2;
        sine[k] = s;
        turn[k] = ux[i]! * uy[k]! < uy[i]! * ux[k]! ? -2 * s : 2 * s;
        if (kind[k] === FREE) depth2 = (s * Math.min(length[i]!, length[k]!)) / 4;
      }
      const taken2 = i < n ? taken[k]! : 0;
      const rest = corner - Math.max(taken0, taken1, taken2);
      taken0 = taken1;
      taken1 = taken2;
      left[i] = rest;
      const toLeft = turn[i]! >= 0;
      if (kind[i] === FREE) {
        const inside = Math.max(0, rest - Math.max(depth0, depth1, depth2));
        const outside = sine[i]! < HARDLY ? inside : rest;
        low[i] = toLeft ? -outside : -inside;
        high[i] = toLeft ? inside : outside;
      } else {
        const outwards = Math.min(kind[i]!, rest);
        low[i] = high[i] = toLeft ? -outwards : outwards;
      }
      depth0 = depth1;
      depth1 = depth2;
    }
  }

  /** From the evened line to the soft one. Neighbours that would be sheared stay; false where even that does not help. */
  private move(n: number): boolean {
    const { even, soft, shiftX, shiftY } = this;
    this.shift(n);
    if (this.stayWhereSheared(n) > 0 && this.stayWhereSheared(n) > 0) return false;
    soft.beLike(even);
    for (let i = 0; i <= n; i++) {
      soft.x[i] = even.x[i]! + shiftX[i]!;
      soft.y[i] = even.y[i]! + shiftY[i]!;
    }
    soft.measure();
    return true;
  }

  private shift(n: number): void {
    const { even, sine, kind, bending, shiftX, shiftY } = this;
    const { ux, uy } = even;
    const { y, turn, low, high } = bending;
    shiftX[0] = shiftY[0] = shiftX[n] = shiftY[n] = 0;
    for (let i = 1; i < n; i++) {
      const left = low[i] === high[i] ? low[i]! : y[i]!;
      const s = sine[i]!;
      if (left === 0) {
        shiftX[i] = shiftY[i] = 0;
      } else if (kind[i] !== FREE) {
        const per = left / (turn[i]! < 0 ? -2 * s : 2 * s);
        shiftX[i] = per * (ux[i]! - ux[i - 1]!);
        shiftY[i] = per * (uy[i]! - uy[i - 1]!);
      } else {
        const per = left * halfPerCosine(s * s);
        shiftX[i] = -per * (uy[i - 1]! + uy[i]!);
        shiftY[i] = per * (ux[i - 1]! + ux[i]!);
      }
    }
  }

  /** How many segments would be; both ends of each then stay, whichever side one comes from. */
  private stayWhereSheared(n: number): number {
    const { length } = this.even;
    const { shiftX, shiftY, isSheared } = this;
    let count = 0;
    for (let i = 0; i < n; i++) {
      const dx = shiftX[i + 1]! - shiftX[i]!;
      const dy = shiftY[i + 1]! - shiftY[i]!;
      isSheared[i] = dx * dx + dy * dy > SHEAR * SHEAR * length[i]! * length[i]! ? 1 : 0;
      count += isSheared[i]!;
    }
    if (count === 0) return 0;
    for (let i = 0; i < n; i++) {
      if (isSheared[i] === 1) shiftX[i] = shiftY[i] = shiftX[i + 1] = shiftY[i + 1] = 0;
    }
    return count;
  }

  private measureRoom(n: number): void {
    const { room, left, shiftX, shiftY } = this;
    const { ux, uy } = this.soft;
    for (let i = 1; i < n; i++) {
      const bx = ux[i]! - ux[i - 1]!;
      const by = uy[i]! - uy[i - 1]!;
      const b = Math.sqrt(bx * bx + by * by);
      const dx = shiftX[i]!;
      const dy = shiftY[i]!;
      const inwards = b > 2 * STRAIGHT ? (dx * bx + dy * by) / b : 0;
      const rest = left[i]! * left[i]! - dx * dx - dy * dy + inwards * inwards;
      room[i] = Math.sqrt(Math.max(0, rest)) - inwards;
    }
  }

  private reserve(points: number): void {
    if (this.room.length > points) return;
    const size = Math.max(points + 1, 2 * this.room.length);
    this.room = new Float64Array(size);
    this.along = new Float64Array(size);
    this.sine = new Float64Array(size);
    this.kind = new Float64Array(size);
    this.forward = new Float64Array(size);
    this.taken = new Float64Array(size);
    this.left = new Float64Array(size);
    this.shiftX = new Float64Array(size);
    this.shiftY = new Float64Array(size);
    this.isSheared = new Uint8Array(size);
  }
}

/** 1/(2 cos(φ/2)) from s², for bends: less than 0.01 % too little. */
function halfPerCosine(s2: number): number {
  return 0.5 + s2 * (0.25 + s2 * (0.1875 + s2 * 0.15625));
}
