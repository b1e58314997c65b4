/**
 * Fewer, longer pieces for runs of a few straights with sharp corners or tiny segments between them: lines that were joined,
 * triangles, ticks. Such a run is a few long blocks, and a few short ones at each corner:
 *
 *   plan     |--------|----|-------|---|--------|-----|-------|       rise, cruise, fall, corner, rise, cruise, fall
 *   pieces   |----------|----------|---|----------|-----------|       two pieces in place of any three blocks or more
 *
 * Sharp corners stay as planned: where they are cut otherwise, the line has another length, and a place on it lies elsewhere for
 * who goes on from there.
 *
 * A pair of pieces goes from the plan's own state at the beginning of one block to that at the beginning of another.
 * With h1 and h2 the times they take, T their sum, and m the velocity between them:
 *
 *   m = (2 Δp − h1 v0 − h2 v1)/T          a1 = (m − v0)/h1          a2 = (v1 − m)/h2
 *
 * The knot is moved to where both need the same acceleration, and T grown to where that is A: a few rounds of both. T may be
 * more than the plan's time by a little, so that pieces come up to the floor.
 *
 * Which blocks are replaced is chosen over all of the run (shortest way, by dynamic programming): the fewest pieces,
 * and of these those with the fewest below the floor. Curves are for fit-accelerations.ts, which goes beside the plan where
 * that is longer; where there is hardly anything beside which to go this finds as few pieces, in a fraction of the steps.
 *
 * Kept, as there: within ε of the planned line wherever it is looked at, |a| ≤ A and |v| ≤ V within 0.1 %.
 */
import type { BlockColumns } from "./block-columns.js";
import { FitSource, SHARP, isBeside } from "./fit-source.js";
import { SLACK, canStep, type RunLimits } from "./limits.js";
import type { RunEnd, RunPath } from "./run-path.js";
import type { FitSettings } from "../settings/motion.js";

/** Longer runs have other fits; and so many blocks has a segment at most, with the corner after it. */
const MOST_SEGMENTS = 5;
const MOST_BLOCKS = 4 * MOST_SEGMENTS;

/** Segments of a curve are not so much shorter than its longest one. */
const EVEN = 1 / 8;

/** What a block below the floor costs, in pieces: less than the one that a pair saves at least. */
const SHORT = 0.9;

/** Fewest blocks that a pair stands for, and its longest time, s. */
const FEWEST = 3;
const LONGEST_S = 1;

/** A pair may take so many times the plan's time, and so many floors more. */
const LATER = 1.02;
const LATER_FLOORS = 0.8;

/** Rounds of the search for knot and time; it ends at once where acceleration would have to be so many times A. */
const ROUNDS = 12;
const HOPELESS = 1.25;

/** The time grows by this more than it would have to if the knot were in its place already. */
const OVER = 1.01;

/** What knots may use of the slack that limits have. */
const HARDLY = 1.0004;

/** Share of ε that the places looked at may use, and how many of them there are at least. */
const BETWEEN = 0.97;
const LOOKS = 12;

/** A pair: h1, h2, a1x, a1y, a2x, a2y. */
const FIELDS = 6;

export class ShortRunFitter {
  private readonly source = new FitSource();
  /** The planned run, and where it ends at rest. */
  private blocks!: BlockColumns;
  private end!: RunEnd;
  private limits!: RunLimits;
  private readonly floorS: number;
  private readonly near: number;
  /** By block: what the cheapest way to its beginning costs, and where its last step begins and the next one ends. */
  private readonly cost = new Float64Array(MOST_BLOCKS + 1);
  private readonly before = new Int32Array(MOST_BLOCKS + 1);
  private readonly next = new Int32Array(MOST_BLOCKS + 1);
  /** The pair that was found last, and those of the steps that end at each block. */
  private readonly pair = new Float64Array(FIELDS);
  private readonly pairs = new Float64Array(FIELDS * (MOST_BLOCKS + 1));

  constructor({ floorMs, toleranceMm }: FitSettings) {
    this.floorS = floorMs / 1000;
    this.near = BETWEEN * toleranceMm;
  }

  /** Whether it is of the kind of runs that this fits. */
  takes({ segmentCount: n, length, ux, uy }: RunPath, { speed, easeSpeed }: RunLimits): boolean {
    // Where it is to go slower, pieces between must keep that too.
    if (n > MOST_SEGMENTS || easeSpeed < speed) return false;
    let shortest = Infinity;
    let longest = 0;
    for (let i = 0; i < n; i++) {
      const l = length[i]!;
      if (l < shortest) shortest = l;
      if (l > longest) longest = l;
      if (i > 0 && ux[i]! * ux[i - 1]! + uy[i]! * uy[i - 1]! < SHARP) return true;
    }
    return shortest < EVEN * longest;
  }

  /** Appends the run in `from`, all of its blocks up to `end`, to `out` in fewer pieces. */
  write(from: BlockColumns, end: RunEnd, limits: RunLimits, out: BlockColumns): void {
    const { before, next } = this;
    this.blocks = from;
    this.end = end;
    this.limits = limits;
    this.source.open(from, end);
    this.findWay();
    out.reserve(from.count, end.segmentCount);
    for (let m = from.count; m > 0; m = before[m]!) next[before[m]!] = m;
    for (let k = 0; k < from.count; k = next[k]!) {
      if (next[k] === k + 1) out.pushFrom(from, k);
      else this.writePair(k, next[k]!, out);
    }
  }

  private findWay(): void {
    const { source, cost, before, pair, pairs, floorS } = this;
    const { count, durationS } = this.blocks;
    // No pair stands for blocks before this, nor for the next one to be kept.
    let first = 0;
    let kept = source.nextKept(0);
    for (let m = 1; m <= count; m++) {
      const d = durationS[m - 1]!;
      let least = cost[m - 1]! + (d < floorS ? 1 + SHORT : 1);
      let from = m - 1;
      if (m - 1 === kept) {
        first = m;
        kept = source.nextKept(m);
      }
      for (let k = first; k <= m - FEWEST; k++) {
        if (cost[k]! + 2 >= least || !this.findPair(k, m)) continue;
        least = cost[k]! + 2;
        from = k;
        for (let i = 0; i < FIELDS; i++) pairs[FIELDS * m + i] = pair[i]!;
      }
      cost[m] = least;
      before[m] = from;
    }
  }

  /** Finds a pair from the beginning of block k to that of block m, and leaves it in `pair`; false where there is none. */
  private findPair(k: number, m: number): boolean {
    const { floorS, pair, end } = this;
    const { startS, x, y, vx, vy, count, clockS } = this.blocks;
    const { accel, speed } = this.limits;
    const most = accel * SLACK;
    const fastest2 = (speed * HARDLY) ** 2;
    const isEnd = m === count;
    const length = (isEnd ? clockS : startS[m]!) - startS[k]!;
    const latest = LATER * length + LATER_FLOORS * floorS;
    let T = length < 2 * floorS ? 2 * floorS : length;
    if (length > LONGEST_S || T > latest) return false;
    const dx = 2 * ((isEnd ? end.x : x[m]!) - x[k]!);
    const dy = 2 * ((isEnd ? end.y : y[m]!) - y[k]!);
    const vx0 = vx[k]!;
    const vy0 = vy[k]!;
    const vx1 = isEnd ? 0 : vx[m]!;
    const vy1 = isEnd ? 0 : vy[m]!;
    let share = 0.5;
    let isLast = false;
    for (let round = 0; round < ROUNDS; round++) {
      const h1 = share * T;
      const h2 = T - h1;
      const mx = (dx - h1 * vx0 - h2 * vx1) / T;
      const my = (dy - h1 * vy0 - h2 * vy1) / T;
      const change1 = Math.sqrt((mx - vx0) * (mx - vx0) + (my - vy0) * (my - vy0));
      const change2 = Math.sqrt((vx1 - mx) * (vx1 - mx) + (vy1 - my) * (vy1 - my));
      const needed = (change1 + change2) / (most * T);
      if (!(needed < HOPELESS)) return false;
      if (change1 <= most * h1 && change2 <= most * h2) {
        pair[0] = h1;
        pair[1] = h2;
        pair[2] = (mx - vx0) / h1;
        pair[3] = (my - vy0) / h1;
        pair[4] = (vx1 - mx) / h2;
        pair[5] = (vy1 - my) / h2;
        if (mx * mx + my * my <= fastest2 && canStep(this.limits, mx, my) && this.isNear(k, m, length))
          return true;
        if (isLast) return false;
        // Once more with the knot in its place.
        isLast = true;
      }
      if (needed > 1) T *= needed * OVER;
      if (T > latest) return false;
      share = Math.max(floorS / T, Math.min(1 - floorS / T, change1 / (change1 + change2)));
    }
    return false;
  }

  /** Compares `pair` with blocks [k, m), which take `length` seconds: where each begins, and within those that are not short. */
  private isNear(k: number, m: number, length: number): boolean {
    const { near, pair } = this;
    const { accel } = this.limits;
    const { startS, durationS, x, y, vx, vy, ax, ay } = this.blocks;
    const h1 = pair[0]!;
    const a1x = pair[2]!;
    const a1y = pair[3]!;
    const changeX = pair[4]! - a1x;
    const changeY = pair[5]! - a1y;
    const start = startS[k]!;
    const stretch = (h1 + pair[1]!) / length;
    const often = LOOKS / length;
    for (let i = k; i < m; i++) {
      const d = durationS[i]!;
      const looks = d * often > 1.5 ? Math.round(d * often) : 1;
      for (let look = i === k ? 1 : 0; look < looks; look++) {
        const u = (d * look) / looks;
        const t = (startS[i]! + u - start) * stretch;
        const later = t > h1 ? t - h1 : 0;
        const wx = vx[i]! + u * ax[i]!;
        const wy = vy[i]! + u * ay[i]!;
        const dx =
          x[k]! + t * vx[k]! + (a1x * t * t + changeX * later * later) / 2 - x[i]! - (u * (vx[i]! + wx)) / 2;
        const dy =
          y[k]! + t * vy[k]! + (a1y * t * t + changeY * later * later) / 2 - y[i]! - (u * (vy[i]! + wy)) / 2;
        if (!isBeside(dx, dy, wx, wy, near, accel)) return false;
      }
    }
    return true;
  }

  private writePair(k: number, m: number, out: BlockColumns): void {
    const { pairs } = this;
    const { count, clockS, startS, x, y, vx, vy, alongMm } = this.blocks;
    const at = FIELDS * m;
    const h1 = pairs[at]!;
    const h2 = pairs[at + 1]!;
    const ax = pairs[at + 2]!;
    const ay = pairs[at + 3]!;
    const wx = vx[k]! + h1 * ax;
    const wy = vy[k]! + h1 * ay;
    const px = x[k]! + (h1 * (vx[k]! + wx)) / 2;
    const py = y[k]! + (h1 * (vy[k]! + wy)) / 2;
    out.push(h1, x[k]!, y[k]!, vx[k]!, vy[k]!, ax, ay, alongMm[k]!);
    const end = m < count ? startS[m]! : clockS;
    const tau = startS[k]! + ((end - startS[k]!) * h1) / (h1 + h2);
    let i = k;
    while (i + 1 < m && startS[i + 1]! <= tau) i++;
    out.push(
      h2,
      px,
      py,
      wx,
      wy,
      pairs[at + 4]!,
      pairs[at + 5]!,
      this.alongBeside(i, tau - startS[i]!, px, py),
    );
  }

  /** mm of the drawing at the place of the plan that is nearest to (px, py), which is beside block i `u` seconds from its beginning. */
  private alongBeside(i: number, u: number, px: number, py: number): number {
    const { count, durationS, x, y, vx, vy, ax, ay, alongMm } = this.blocks;
    const d = durationS[i]!;
    const wx = vx[i]! + u * ax[i]!;
    const wy = vy[i]! + u * ay[i]!;
    const ex = vx[i]! + d * ax[i]!;
    const ey = vy[i]! + d * ay[i]!;
    const v = Math.sqrt(vx[i]! * vx[i]! + vy[i]! * vy[i]!);
    const w = Math.sqrt(wx * wx + wy * wy);
    const e = Math.sqrt(ex * ex + ey * ey);
    const next = i + 1 < count ? alongMm[i + 1]! : this.end.alongMm;
    const behind = (next - alongMm[i]!) * ((u * (v + w)) / (d * (v + e)));
    const dx = px - x[i]! - (u * (vx[i]! + wx)) / 2;
    const dy = py - y[i]! - (u * (vy[i]! + wy)) / 2;
    return alongMm[i]! + behind + (w > 0 ? (dx * wx + dy * wy) / w : 0);
  }
}
