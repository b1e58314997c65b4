/**
 * The line on which corner curves are planned: within δ of the drawing, but softer, so that it can be drawn
 * faster.
 *
 *   δ     mm    corner deviation            s     sin(φ/2), φ the turn angle at a point
 *   ℓ     mm    length of the shorter segment at a point
 *   room  mm    max distance between a corner's curve and its own point
 *
 *          ·       P' moved outwards           A sharp corner's curve may pass δ inside P. If P moves
 *        ·   ·                                 outwards by up to δ, the curve can be rounder.
 *      ·   P   ·
 *    ·   / ‿ \   ·  the curve, of P'           Bends move to where the line bends least
 *      /       \                               (least-bending.ts): tight bends become wider, and small
 *    /  drawing  \                             unevenness, which only costs speed, disappears.
 *
 * There are three kinds of points. Corners so sharp that their curve cannot use half a segment (ℓ s/4 > δ) move
 * outwards. Bends below SMOOTH whose speed is limited by A move so that the line bends less. All others stay.
 *
 * Why this stays within δ: the stadium of a segment PQ is the set of points within δ of it. It is convex, and
 * every point P' is within δ of its P, so the moved segment P'Q' lies in the stadium of PQ. A corner's curve
 * crosses the bisector at a point M. If M is within δ of P, the control points of the part before M (two on the
 * segment, and M) lie in the stadium of the segment before P, and so does that part. The same is true for the
 * part after M. M is at most `room` from P', inwards. So, with b the unit vector in that direction,
 *
 *     room = −d·b + √(δ² − |d|² + (d·b)²)       d = P' − P
 */
import { capSegments, type RunLimits } from "./limits.js";
import { LeastBending } from "./least-bending.js";
import { RunPath } from "./run-path.js";

/** Max s of a bend that is part of a curve (41°). */
const SMOOTH = 0.35;
/** Curves that can be drawn under A at this many times V², or faster, are left unchanged. */
const FAST = 4;
/** Max displacement of two neighbours relative to each other, as a share of their segment's length. */
const SHEAR = 0.5;

/** What can be softened on a path. */
const NOTHING = 0;
const CORNERS = 1;
const BENDS = 2;

export class SoftLine {
  private readonly soft = new RunPath();
  private readonly bending = new LeastBending();
  private corner = 0;
  /** mm outwards at each corner; 0 elsewhere. */
  private outwards = new Float64Array(0);
  /** s at each point of the drawing. */
  private sine = new Float64Array(0);
  /** mm from the drawing's point. */
  private shiftX = new Float64Array(0);
  private shiftY = new Float64Array(0);
  /** Per segment: 1 if its ends would move too far relative to each other. */
  private isSheared = new Uint8Array(0);

  /**
   * The line to plan on, with the same number of points as `path` and the same ends; `path` itself if nothing
   * can be softened. `cap2` is filled. Valid until the next call.
   */
  of(path: RunPath, limits: RunLimits): RunPath {
    const n = path.segmentCount;
    this.reserve(n + 1);
    this.corner = limits.corner;
    capSegments(path, limits);
    const found = this.bound(path, limits);
    if (found === NOTHING) return this.unchanged(path);
    const { bending, soft, shiftX, shiftY } = this;
    if (found === BENDS) bending.solve(n, path.length);
    this.shift(path);
    // Resetting a point can shear its other segment, so check again.
    if (this.stayWhereSheared(path) > 0 && this.stayWhereSheared(path) > 0) return this.unchanged(path);
    soft.copyLayout(path);
    for (let i = 0; i <= n; i++) {
      soft.x[i] = path.x[i] + shiftX[i];
      soft.y[i] = path.y[i] + shiftY[i];
    }
    soft.measure();
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
    const along = dx * bx + dy * by;
    const rest = this.corner * this.corner - dx * dx - dy * dy;
    // 2 room / s, where d·b = along / (2 s).
    const max = (Math.sqrt(Math.max(0, 4 * s * s * rest + along * along)) - along) / (s * s);
    return Math.min(max, half);
  }

  private unchanged(path: RunPath): RunPath {
    this.shiftX.fill(0, 0, path.segmentCount + 1);
    this.shiftY.fill(0, 0, path.segmentCount + 1);
    return path;
  }

  /** Sets the turn at each point, and how far it may move to the left. Returns what can be softened. */
  private bound(path: RunPath, { accel, corner }: RunLimits): number {
    const { segmentCount: n, length, ux, uy, cap2 } = path;
    const { sine, outwards, bending } = this;
    bending.reserve(n + 1);
    const { low, high, turn } = bending;
    let found = NOTHING;
    sine[0] = turn[0] = low[0] = high[0] = 0;
    sine[n] = turn[n] = low[n] = high[n] = 0;
    for (let i = 1; i < n; i++) {
      const dx = ux[i] - ux[i - 1];
      const dy = uy[i] - uy[i - 1];
      const s = Math.sqrt(dx * dx + dy * dy) / 2;
      // Positive: to the left. Where the line goes straight back, to neither side.
      const side = Math.sign(ux[i - 1] * uy[i] - uy[i - 1] * ux[i]);
      const half = Math.min(length[i - 1], length[i]) / 2;
      // How far the longest curve passes inside its point.
      const depth = (half * s) / 2;
      const v2 = Math.min(cap2[i - 1], cap2[i]);
      // Max and min displacement to the outside of the turn.
      let most = 0;
      let least = 0;
      outwards[i] = 0;
      if (depth > corner) {
        outwards[i] = Math.max(0, Math.min(corner, depth - corner, (v2 * s * s) / (2 * accel) - corner));
        // This moves the ends of both segments across them by cos(φ/2) of it.
        most = outwards[i] * Math.sqrt(Math.max(0, 1 - s * s));
        least = most;
        if (outwards[i] > 0 && found === NOTHING) found = CORNERS;
      } else if (s <= SMOOTH && accel * half < FAST * v2 * s) {
        most = corner;
        // With less room than its depth the pen would have to slow down again.
        least = depth - corner;
        found = BENDS;
      }
      sine[i] = s;
      turn[i] = side * 2 * s;
      low[i] = side > 0 ? -most : least;
      high[i] = side > 0 ? -least : most;
    }
    return found;
  }

  private shift(path: RunPath): void {
    const { segmentCount: n, ux, uy } = path;
    const { sine, outwards, shiftX, shiftY } = this;
    const { y: moves, low, high } = this.bending;
    shiftX[0] = shiftY[0] = shiftX[n] = shiftY[n] = 0;
    for (let i = 1; i < n; i++) {
      if (low[i] < high[i]) {
        // u0 + u1 is 2 cos(φ/2) long.
        const per = moves[i] / (2 * Math.sqrt(1 - sine[i] * sine[i]));
        shiftX[i] = -per * (uy[i - 1] + uy[i]);
        shiftY[i] = per * (ux[i - 1] + ux[i]);
      } else {
        const per = outwards[i] === 0 ? 0 : -outwards[i] / (2 * sine[i]);
        shiftX[i] = per * (ux[i] - ux[i - 1]);
        shiftY[i] = per * (uy[i] - uy[i - 1]);
      }
    }
  }

  /** Returns the number of sheared segments, and resets both ends of each. */
  private stayWhereSheared({ segmentCount: n, length }: RunPath): number {
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
    if (this.sine.length >= points) return;
    const size = Math.max(points, 2 * this.sine.length);
    this.outwards = new Float64Array(size);
    this.sine = new Float64Array(size);
    this.shiftX = new Float64Array(size);
    this.shiftY = new Float64Array(size);
    this.isSheared = new Uint8Array(size);
  }
}
