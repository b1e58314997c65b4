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
 * There are three kinds of points. Corners so sharp that their curve cannot use half a segment (ℓ s/2 > 2 δ) move
 * outwards. Bends below SMOOTH whose speed is limited by A move so that the line bends less. All others stay. Points
 * of bends also move along the line (EVEN) to make their two segments more equal, because the shorter one limits
 * the length of the curve.
 *
 * Why this stays within δ: the stadium of a segment PQ is the set of points within δ of it. It is convex, and
 * every point P' is within δ of its P, so the moved segment P'Q' lies in the stadium of PQ. A corner's curve
 * crosses the bisector at a point M. If M is within δ of P, the control points of the part before M (two on the
 * segment, and M) lie in the stadium of the segment before P, and so does that part. The same is true for the
 * part after M. M is at most `room` from P', inwards. So, with b the unit vector in that direction,
 *
 *     room = −d·b + √(δ² − |d|² + (d·b)²)       d = P' − P
 *
 * If a point first moves along the line by τ, segments leave the drawing by at most τ (s + half the next
 * point's s). That amount is subtracted from δ at the point and at its neighbours.
 */
import { capSegments, type RunLimits } from "./limits.js";
import { clamped, greater, lesser } from "./choose.js";
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
const KEEP_SHARE = 0.75;
/** Max displacement of two neighbours relative to each other, as a share of their segment's length. */
const SHEAR = 0.5;
/** Added to a divisor that is 0 on straight lines, to keep the quotient finite; negligible elsewhere. */
const TINY = 1e-6;

/** Value of `kind` for a point of a bend. */
const FREE = -1;

/** What can be softened on a path. */
const NOTHING = 0;
const CORNERS = 1;
const BENDS = 2;

export class SoftLine {
  /** mm of the drawing that each segment covers. */
  along = new Float64Array(0);
  /** The evened line, then the soft line. */
  private readonly soft = new RunPath();
  private readonly bending = new LeastBending();
  /** s at each point of the drawing, then of the evened line. */
  private sine = new Float64Array(0);
  /** mm outwards at corners; FREE at bends; 0 for points that stay. */
  private kind = new Float64Array(0);
  /** mm of δ that moving along the line takes at each point, and mm of δ that remain there. */
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
    if (curves === NOTHING) return this.unchanged(path, limits);
    this.evenOut(path, limits.corner);
    this.bound(limits.corner);
    const { bending, soft } = this;
    if (curves === BENDS) bending.solve(n, soft.length);
    else bending.y.set(bending.low.subarray(0, n + 1));
    if (!this.move(n)) return this.unchanged(path, limits);
    capSegments(soft, limits);
    return soft;
  }

  /**
   * mm of each adjacent segment that the curve at corner i of the returned line may use: at most `half`, and so few
   * that the curve passes within `room` of the corner. (bx, by) is u1 − u0, of length 2 s.
   */
  reach(i: number, bx: number, by: number, s: number, half: number): number {
    const dx = this.shiftX[i];
    const dy = this.shiftY[i];
    const left = this.left[i];
    const along = dx * bx + dy * by;
    const rest = left * left - dx * dx - dy * dy;
    // Usually a curve that uses all of `half` is within `room`. Testing this first saves a root and a division: planning
    // in `blend` takes 236 ms for a million segments in place of 244.
    const depth = (half * s) / 2;
    if (rest >= depth * depth + (half * along) / 2) return half;
    // 2 room / s, where d·b = along / (2 s).
    const max = (Math.sqrt(Math.max(0, 4 * s * s * rest + along * along)) - along) / (s * s);
    return Math.min(max, half);
  }

  private unchanged(path: RunPath, limits: RunLimits): RunPath {
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
    for (let i = 1; i < n; i++) {
      const dx = ux[i] - ux[i - 1];
      const dy = uy[i] - uy[i - 1];
      const s = Math.sqrt(dx * dx + dy * dy) / 2;
      const half = lesser(length[i - 1], length[i]) / 2;
      const v2 = Math.min(cap2[i - 1], cap2[i]);
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
    const { soft, sine, kind, taken, along } = this;
    soft.copyLayout(path);
    soft.x[0] = x[0];
    soft.y[0] = y[0];
    taken[0] = 0;
    let previousTau = 0;
    for (let i = 1; i <= n; i++) {
      soft.x[i] = x[i];
      soft.y[i] = y[i];
      taken[i] = 0;
      let tau = 0;
      if (kind[i] === FREE) {
        const s = sine[i];
        const leaves = s + greater(sine[i - 1], sine[i + 1]) / 2;
        const mayLeave = ((1 - KEEP_SHARE) * corner) / (leaves + TINY);
        const limit = lesser((SHEAR / 2) * lesser(length[i - 1], length[i]), mayLeave);
        tau = clamped(EVEN * (length[i] - length[i - 1]), -limit, limit);
        const per = tau * halfPerCosine(s * s);
        soft.x[i] += per * (ux[i - 1] + ux[i]);
        soft.y[i] += per * (uy[i - 1] + uy[i]);
        taken[i] = Math.abs(tau) * leaves;
      }
      along[i - 1] = length[i - 1] + tau - previousTau;
      previousTau = tau;
    }
    soft.measure();
  }

  /** Computes the turns of the evened line, and how far its points may move to the left and to the right. */
  private bound(corner: number): void {
    const { segmentCount: n, length, ux, uy } = this.soft;
    const { sine, kind, taken, left, bending } = this;
    bending.reserve(n + 1);
    const { low, high, turn } = bending;
    sine[0] = turn[0] = low[0] = high[0] = 0;
    sine[n] = turn[n] = low[n] = high[n] = 0;
    for (let i = 1; i < n; i++) {
      const dx = ux[i] - ux[i - 1];
      const dy = uy[i] - uy[i - 1];
      const s = Math.sqrt(dx * dx + dy * dy) / 2;
      const isLeftTurn = ux[i - 1] * uy[i] > uy[i - 1] * ux[i];
      sine[i] = s;
      turn[i] = isLeftTurn ? 2 * s : -2 * s;
      const rest = corner - greater(greater(taken[i - 1], taken[i]), taken[i + 1]);
      left[i] = rest;
      let outwards = rest;
      let inwards: number;
      if (kind[i] === FREE) {
        // The curve passes this far inside its point. With less room than that the pen would have to slow down again.
        const depth = (s * lesser(length[i - 1], length[i])) / 4;
        inwards = Math.max(0, rest - depth);
      } else {
        outwards = Math.min(kind[i], rest);
        inwards = -outwards;
      }
      low[i] = isLeftTurn ? -outwards : -inwards;
      high[i] = isLeftTurn ? inwards : outwards;
    }
  }

  /**
   * Moves the points of the evened line. Neighbours that would shear their segment stay; false if segments are still
   * sheared after that.
   */
  private move(n: number): boolean {
    const { soft, shiftX, shiftY } = this;
    this.shift(n);
    if (this.stayWhereSheared(n) > 0 && this.stayWhereSheared(n) > 0) return false;
    for (let i = 0; i <= n; i++) {
      soft.x[i] += shiftX[i];
      soft.y[i] += shiftY[i];
    }
    soft.measure();
    return true;
  }

  private shift(n: number): void {
    const { sine, kind, shiftX, shiftY } = this;
    const { ux, uy } = this.soft;
    const { y: moves } = this.bending;
    shiftX.fill(0, 0, n + 1);
    shiftY.fill(0, 0, n + 1);
    for (let i = 1; i < n; i++) {
      if (kind[i] === FREE) {
        const per = moves[i] * halfPerCosine(sine[i] * sine[i]);
        shiftX[i] = -per * (uy[i - 1] + uy[i]);
        shiftY[i] = per * (ux[i - 1] + ux[i]);
      } else if (moves[i] !== 0) {
        // Outwards, which is to the right in a left turn.
        const per = -Math.abs(moves[i]) / (2 * sine[i]);
        shiftX[i] = per * (ux[i] - ux[i - 1]);
        shiftY[i] = per * (uy[i] - uy[i - 1]);
      }
    }
  }

  /** Returns the number of sheared segments, and resets both ends of each. */
  private stayWhereSheared(n: number): number {
    const { length } = this.soft;
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
