/**
 * The line on which corner curves are planned: within δ of the drawing, but softer, so that it can be drawn
 * faster.
 *
 *   δ     mm    corner deviation            s     sin(φ/2), φ the turn angle at a point
 *   ℓ/2   mm    half the shorter segment at a point
 *   room  mm    max distance between a corner's curve and its own point
 *
 *          ·       P' moved outwards           A sharp corner's curve may pass δ inside P. If P moves
 *        ·   ·                                 outwards by up to δ, the curve can be rounder.
 *      ·   P   ·
 *    ·   / ‿ \   ·  the curve, of P'           Bends move to where the line bends least
 *      /       \                               (least-bending.ts): tight bends become wider, and small
 *    /  drawing  \                             unevenness, which only costs speed, disappears.
 *
 * There are three kinds of points. Corners too sharp for their curve to use half a segment (ℓ s/2 > 2 δ) move
 * outwards. Bends below SMOOTH whose speed is limited by A move to bend less. All others stay. Points of
 * bends also move along the line (EVEN), since the curve at a point can be no longer than the shorter segment
 * allows.
 *
 * Why this stays within δ: every point P' is within δ of its P, so each segment P'Q' lies in the stadium of
 * PQ, the set of points within δ of PQ, which is convex. A corner's curve crosses the bisector at a point M.
 * If M is within δ of P, the control points of the part before it (two on the segment, and M) lie in the
 * stadium of the segment before P, and so does that part; likewise for the other part. M is at most `room`
 * from P', inwards, so with b the unit vector of that direction
 *
 *     room = −d·b + √(δ² − |d|² + (d·b)²)       d = P' − P
 *
 * If a point first moves along the line by τ, segments leave the drawing by at most τ (s + half the next
 * point's s). That amount is subtracted from δ at the point and at its neighbours.
 */
import { capSegments, type RunLimits } from "./limits.js";
import { LeastBending } from "./least-bending.js";
import { RunPath } from "./run-path.js";

/** Max s of a bend that is part of a curve (41°). */
const SMOOTH = 0.35;
/** Curves that can be drawn under A at this many times V², or faster, are left unchanged. */
const FAST = 4;
/**
 * A point moves along the line by this share of the difference between its two segments' lengths, to even
 * them out.
 */
const EVEN = 0.3;
/** Moving along the line must leave this share of δ. */
const LEFT = 0.75;
/** Max relative displacement of two neighbours, as a share of their segment. */
const SHEAR = 0.5;
/** Below this s the direction of the bend is uncertain. */
const HARDLY = 0.015;
/**
 * Added to an s before dividing by it, so that the quotient stays finite on straight lines; negligible
 * elsewhere.
 */
const NOT_ZERO = 1e-6;

/** A `kind` that marks a point of a bend, instead of mm outwards. */
const FREE = -1;

/** What can be softened on a path. */
const NOTHING = 0;
const CORNERS = 1;
const BENDS = 2;

export class SoftLine {
  /** mm of the drawing that each segment covers. */
  along = new Float64Array(0);
  private readonly even = new RunPath();
  private readonly soft = new RunPath();
  private readonly bending = new LeastBending();
  /** s at each point of the drawing, then of the evened line. */
  private sine = new Float64Array(0);
  /** mm outwards at corners; FREE at bends; 0 for points that stay. */
  private kind = new Float64Array(0);
  /** mm of δ that moving along the line uses up at each point, and mm of δ that are left there. */
  private taken = new Float64Array(0);
  private left = new Float64Array(0);
  /** mm from the evened line. */
  private shiftX = new Float64Array(0);
  private shiftY = new Float64Array(0);
  /** Per segment of the evened line: 1 if its ends would move too far relative to each other. */
  private isSheared = new Uint8Array(0);

  /**
   * The line to plan on, with the same number of points as `path` and the same ends; `path` itself if nothing
   * can be softened. `cap2` is filled. Valid until the next call.
   */
  of(path: RunPath, limits: RunLimits): RunPath {
    const n = path.segmentCount;
    this.reserve(n + 1);
    capSegments(path, limits);
    const curves = this.classify(path, limits);
    if (curves === NOTHING) return this.same(path, limits);
    this.evenOut(path, limits.corner);
    this.bound(limits.corner);
    const { bending } = this;
    if (curves === BENDS) bending.solve(n, this.even.length);
    else bending.y.set(bending.low.subarray(0, n + 1));
    if (!this.move(n)) return this.same(path, limits);
    const { soft } = this;
    capSegments(soft, limits);
    return soft;
  }

  /**
   * mm of each adjacent segment that the curve at corner i of the returned line may use: at most `half`, and
   * such that the curve passes within `room`. (bx, by) is u1 − u0, of length 2 s.
   */
  reach(i: number, bx: number, by: number, s: number, half: number): number {
    const dx = this.shiftX[i];
    const dy = this.shiftY[i];
    const left = this.left[i];
    const along = dx * bx + dy * by;
    const rest = left * left - dx * dx - dy * dy;
    const deep = (half * s) / 2;
    // Usually room ≥ deep, compared here in squares.
    if (rest >= deep * deep + (half * along) / 2) return half;
    const inwards = along / (2 * s);
    const room = Math.sqrt(Math.max(0, rest + inwards * inwards)) - inwards;
    return Math.min((2 * room) / s, half);
  }

  private same(path: RunPath, limits: RunLimits): RunPath {
    const points = path.segmentCount + 1;
    this.shiftX.fill(0, 0, points);
    this.shiftY.fill(0, 0, points);
    this.left.fill(limits.corner, 0, points);
    this.along.set(path.length.subarray(0, path.segmentCount));
    return path;
  }

  /** Sets the kind of each point; returns what can be softened. */
  private classify(path: RunPath, { accel, corner }: RunLimits): number {
    const { segmentCount: n, length, ux, uy, cap2 } = path;
    const { sine, kind } = this;
    let found = NOTHING;
    sine[0] = sine[n] = kind[0] = kind[n] = 0;
    let x0 = ux[0];
    let y0 = uy[0];
    let before = length[0];
    let cap0 = cap2[0];
    for (let i = 1; i < n; i++) {
      const x1 = ux[i];
      const y1 = uy[i];
      const after = length[i];
      const cap1 = cap2[i];
      const dx = x1 - x0;
      const dy = y1 - y0;
      const s = Math.sqrt(dx * dx + dy * dy) / 2;
      const half = Math.min(before, after) / 2;
      const v2 = Math.min(cap0, cap1);
      x0 = x1;
      y0 = y1;
      before = after;
      cap0 = cap1;
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

  /**
   * Moves points of bends along the line, away from the nearer neighbour. Here and in `shift`, segments are
   * measured in the same loop that places their points: a shared function or a separate loop takes 10 %
   * longer.
   */
  private evenOut(path: RunPath, corner: number): void {
    const { segmentCount: n, x, y, length, ux, uy } = path;
    const { even, sine, kind, taken, along } = this;
    even.beLike(path);
    const { x: ex, y: ey, length: evenLength, ux: ex1, uy: ey1 } = even;
    const mayLeave = (1 - LEFT) * corner;
    ex[0] = x[0]!;
    ey[0] = y[0]!;
    taken[0] = 0;
    let forward = 0;
    let px = x[0];
    let py = y[0];
    for (let i = 1; i <= n; i++) {
      const before = length[i - 1];
      let qx = x[i];
      let qy = y[i];
      let tau = 0;
      let leaves = 0;
      if (kind[i] === FREE) {
        const after = length[i];
        const s = sine[i];
        leaves = s + Math.max(sine[i - 1], sine[i + 1]) / 2;
        const limit = Math.min((SHEAR / 2) * Math.min(before, after), mayLeave / (leaves + NOT_ZERO));
        tau = between(EVEN * (after - before), -limit, limit);
        const per = tau * halfPerCosine(s * s);
        qx += per * (ux[i - 1] + ux[i]);
        qy += per * (uy[i - 1] + uy[i]);
      }
      taken[i] = Math.abs(tau) * leaves;
      along[i - 1] = before + tau - forward;
      forward = tau;
      const dx = qx - px;
      const dy = qy - py;
      const l = Math.sqrt(dx * dx + dy * dy);
      const per = 1 / l;
      evenLength[i - 1] = l;
      ex1[i - 1] = dx * per;
      ey1[i - 1] = dy * per;
      ex[i] = px = qx;
      ey[i] = py = qy;
    }
  }

  /** Computes the turns of the evened line, and how far its points may move to the left and to the right. */
  private bound(corner: number): void {
    const { segmentCount: n, length, ux, uy } = this.even;
    const { sine, kind, taken, left, bending } = this;
    bending.reserve(n + 1);
    const { low, high, turn } = bending;
    sine[0] = turn[0] = low[0] = high[0] = 0;
    sine[n] = turn[n] = low[n] = high[n] = 0;
    // How far inside its point a curve of that radius passes, for this point and its neighbours. With less
    // room than this the pen would have to slow down again.
    let depth0 = 0;
    let depth1 = 0;
    let taken0 = 0;
    let taken1 = 0;
    for (let k = 1; k <= n; k++) {
      // Point k is the last neighbour of point k − 1, whose bounds are set here.
      let depth2 = 0;
      let taken2 = 0;
      if (k < n) {
        const ax = ux[k - 1];
        const ay = uy[k - 1];
        const bx = ux[k];
        const by = uy[k];
        const cross = ax * by - ay * bx;
        taken2 = taken[k]!;
        if (kind[k] === FREE) {
          // 2 sin(φ/2) from sin φ.
          const t = cross * (1 + (cross * cross) / 8);
          const s = Math.abs(t) / 2;
          turn[k] = t;
          sine[k] = s;
          depth2 = (s * Math.min(length[k - 1], length[k])) / 4;
        } else {
          const s = Math.sqrt((bx - ax) * (bx - ax) + (by - ay) * (by - ay)) / 2;
          turn[k] = cross < 0 ? -2 * s : 2 * s;
          sine[k] = s;
        }
      }
      if (k > 1) {
        const i = k - 1;
        const rest = corner - Math.max(Math.max(taken0, taken2), taken1);
        left[i] = rest;
        if (kind[i] === FREE) {
          const inside = Math.max(0, rest - Math.max(Math.max(depth0, depth2), depth1));
          const side = between(turn[i] / (2 * HARDLY), -1, 1);
          const more = (rest - inside) / 2;
          const middle = -side * more;
          const half = inside + Math.abs(side) * more;
          low[i] = middle - half;
          high[i] = middle + half;
        } else {
          const outwards = Math.min(kind[i], rest);
          low[i] = high[i] = turn[i] >= 0 ? -outwards : outwards;
        }
      }
      depth0 = depth1;
      depth1 = depth2;
      taken0 = taken1;
      taken1 = taken2;
    }
  }

  /**
   * From the evened line to the soft one. Sheared neighbours stay in place; false if even that does not help.
   */
  private move(n: number): boolean {
    const { even, soft, shiftX, shiftY } = this;
    if (this.shift(n)) return true;
    if (this.stayWhereSheared(n) > 0 && this.stayWhereSheared(n) > 0) return false;
    for (let i = 0; i <= n; i++) {
      soft.x[i] = even.x[i] + shiftX[i];
      soft.y[i] = even.y[i] + shiftY[i];
    }
    soft.measure();
    return true;
  }

  /** Moves all points; returns whether no segment is sheared. */
  private shift(n: number): boolean {
    const { even, soft, sine, kind, shiftX, shiftY } = this;
    const { x, y, ux, uy, length } = even;
    const { y: moves } = this.bending;
    soft.beLike(even);
    const { x: sx, y: sy, length: softLength, ux: sx1, uy: sy1 } = soft;
    let isSheared = false;
    let dx0 = 0;
    let dy0 = 0;
    let px = x[0];
    let py = y[0];
    shiftX[0] = shiftY[0] = 0;
    sx[0] = px;
    sy[0] = py;
    for (let i = 1; i <= n; i++) {
      const left = moves[i];
      let dx = 0;
      let dy = 0;
      if (kind[i] === FREE) {
        const s = sine[i];
        const per = left * halfPerCosine(s * s);
        dx = -per * (uy[i - 1] + uy[i]);
        dy = per * (ux[i - 1] + ux[i]);
      } else if (left !== 0) {
        // Outwards, which is to the right in a left turn.
        const per = -Math.abs(left) / (2 * sine[i]);
        dx = per * (ux[i] - ux[i - 1]);
        dy = per * (uy[i] - uy[i - 1]);
      }
      shiftX[i] = dx;
      shiftY[i] = dy;
      const apartX = dx - dx0;
      const apartY = dy - dy0;
      const before = length[i - 1];
      if (apartX * apartX + apartY * apartY > SHEAR * SHEAR * before * before) isSheared = true;
      dx0 = dx;
      dy0 = dy;
      const qx = x[i] + dx;
      const qy = y[i] + dy;
      const stepX = qx - px;
      const stepY = qy - py;
      const l = Math.sqrt(stepX * stepX + stepY * stepY);
      const per = 1 / l;
      softLength[i - 1] = l;
      sx1[i - 1] = stepX * per;
      sy1[i - 1] = stepY * per;
      sx[i] = px = qx;
      sy[i] = py = qy;
    }
    return !isSheared;
  }

  /** Returns the number of sheared segments, and resets both ends of each. */
  private stayWhereSheared(n: number): number {
    const { length } = this.even;
    const { shiftX, shiftY, isSheared } = this;
    let count = 0;
    for (let i = 0; i < n; i++) {
      const dx = shiftX[i + 1] - shiftX[i];
      const dy = shiftY[i + 1] - shiftY[i];
      isSheared[i] = dx * dx + dy * dy > SHEAR * SHEAR * length[i] * length[i] ? 1 : 0;
      count += isSheared[i];
    }
    if (count === 0) return 0;
    for (let i = 0; i < n; i++) {
      if (isSheared[i] === 1) shiftX[i] = shiftY[i] = shiftX[i + 1] = shiftY[i + 1] = 0;
    }
    return count;
  }

  private reserve(points: number): void {
    if (this.along.length > points) return;
    const size = Math.max(points + 1, 2 * this.along.length);
    this.along = new Float64Array(size);
    this.sine = new Float64Array(size);
    this.kind = new Float64Array(size);
    this.taken = new Float64Array(size);
    this.left = new Float64Array(size);
    this.shiftX = new Float64Array(size);
    this.shiftY = new Float64Array(size);
    this.isSheared = new Uint8Array(size);
  }
}

/** 1/(2 cos(φ/2)) from s², for bends: too small by less than 0.01 %. */
function halfPerCosine(s2: number): number {
  return 0.5 + s2 * (0.25 + s2 * (0.1875 + s2 * 0.15625));
}

const between = (a: number, low: number, high: number): number => Math.min(high, Math.max(low, a));
