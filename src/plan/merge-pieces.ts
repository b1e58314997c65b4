/**
 * Merges neighbouring pieces of constant acceleration of one run: the last three become two, or the last four three, as
 * long as that holds; then the next piece is taken up.
 *
 *   pieces   |----|---|-----|-------|--- …
 *   become   |------|-------|-------|--- …      or      |------|------|-------|--- …
 *
 * fewer-pieces.ts finds the velocities at the knots between the new pieces and foresees how far those are from the plan's line;
 * where the knots should be is guessed (knot-guess.ts), and tried out around that here. What promises to hold is followed along
 * the plan (plan-walk.ts) before it is taken. New pieces take less time than the old ones where that is possible, and never more than those or LATER of the
 * plan's time.
 */
import type { BlockColumns } from "./block-columns.js";
import { FewerPieces } from "./fewer-pieces.js";
import type { FitSource } from "./fit-source.js";
import { KnotGuess } from "./knot-guess.js";
import { canStep, type RunLimits } from "./limits.js";
import type { PieceNotes } from "./piece-notes.js";
import { PlanWalk } from "./plan-walk.js";
import type { FitSettings } from "../settings/motion.js";

/** Share of ε that the places looked at may use: between them the distance can be a little more. */
const BETWEEN = 0.96;

/** More of the plan than this is not made anew at once, s. */
const LONGEST_S = 1.5;

/** Of the plan's time, what new pieces may take; shares of that, of which the first that holds is taken. */
const LATER = 1.01;
const SOONER = [0.97, 0.98, 0.99, 1];

/** Nothing is tried where jumps of acceleration across the line, times the square of the time, are so many times ε. */
const WILD_THREE = 600;
const WILD_FOUR = 2000;

/** The knot between two pieces: where it is looked for beside the places that are guessed, as a share of their time. */
const ASIDE = 0.1;

/** The knots between three pieces: steps of the search around those guessed, as shares of an old piece. */
const STEP = 0.15;

/** They are looked for where the first guess is within so many times ε, until it is within the share GOOD of it. */
const HOPE_TWO = 2;
const HOPE_THREE = 1.7;
const GOOD = 0.75;

/** Half of the looks at a new piece, at least; and the seconds between two looks, at most. */
const HALF_LOOKS = 3;
const LOOK_S = 0.008;

/** New pieces must come to the same instant of the plan as the old ones, s. */
const SAME_S = 0.004;

/** Above this share of it a knot's speed is not below a limit of speed. */
const AT_LIMIT = 1.001;

export class PieceMerger {
  private readonly walk: PlanWalk;
  private readonly fewer = new FewerPieces();
  private readonly guess = new KnotGuess();
  /** How near new pieces must be, mm. */
  private readonly near: number;
  /** The limit of speed for those that are open. */
  private speed = 0;
  private pieces!: BlockColumns;
  private limits!: RunLimits;
  /** The notes of new pieces, while it is not known whether they hold. */
  private readonly block = new Int32Array(3);
  private readonly tau = new Float64Array(3);
  private readonly middle = new Float64Array(3);
  private readonly knot = new Float64Array(3);

  /** @param notes for τ: the instant of the plan at which each piece begins */
  constructor(
    private readonly source: FitSource,
    private readonly settings: FitSettings,
    private readonly notes: PieceNotes,
  ) {
    this.near = BETWEEN * settings.toleranceMm;
    this.walk = new PlanWalk(source, this.near);
  }

  /** Merges `pieces`, which cover the source's run. */
  merge(pieces: BlockColumns, limits: RunLimits): void {
    const { count } = pieces;
    this.pieces = pieces;
    this.limits = limits;
    this.putEnd(count);
    let kept = 0;
    for (let i = 0; i < count; i++) {
      this.take(i, kept++);
      while ((kept >= 3 && this.mergesThree(kept - 3)) || (kept >= 4 && this.mergesFour(kept - 4))) kept--;
    }
    pieces.count = kept;
  }

  /** The run's end, at rest, as the state after the last piece. */
  private putEnd(count: number): void {
    const { source, pieces, notes } = this;
    const end = source.blocks.count;
    pieces.x[count] = source.xOf(end);
    pieces.y[count] = source.yOf(end);
    pieces.vx[count] = pieces.vy[count] = 0;
    notes.tau[count] = source.startOf(end);
    notes.knot[count] = 0;
    notes.block[count] = end - 1;
  }

  /** Puts piece i at `to`, and the state in which it ends after it. */
  private take(i: number, to: number): void {
    const { notes, pieces } = this;
    const { durationS, ax, ay } = pieces;
    if (i > to) {
      durationS[to] = durationS[i]!;
      ax[to] = ax[i]!;
      ay[to] = ay[i]!;
      notes.middle[to] = notes.middle[i]!;
      this.putState(i, to);
      this.putState(i + 1, to + 1);
    }
    notes.note(to, pieces);
  }

  private putState(from: number, to: number): void {
    const { x, y, vx, vy } = this.pieces;
    const { tau, block, knot } = this.notes;
    x[to] = x[from]!;
    y[to] = y[from]!;
    vx[to] = vx[from]!;
    vy[to] = vy[from]!;
    tau[to] = tau[from]!;
    block[to] = block[from]!;
    knot[to] = knot[from]!;
  }

  private mergesThree(i: number): boolean {
    const { fewer, guess, near } = this;
    const { jump } = this.notes;
    const T = this.secondsOf(i, 3);
    // Not where the pen is at rest: jumps are NaN there.
    if (!((Math.abs(jump[i + 1]!) + Math.abs(jump[i + 2]!)) * T * T < WILD_THREE * near)) return false;
    const most = this.mostFor(i, 3, T);
    if (most === 0 || !this.reaches(i, most)) return false;
    this.open(i, 3);
    guess.forTwo(this.pieces, this.notes, i);
    let best = HOPE_TWO * near;
    let share = 0;
    for (let way = 0; way < 4 && best > GOOD * near; way++) {
      const s = way === 1 ? guess.both : guess.across + (way === 2 ? -ASIDE : way === 3 ? ASIDE : 0);
      fewer.most = best;
      if (this.solveTwo(s, most)) {
        best = fewer.far;
        share = s;
      } else if (way === 0 && fewer.far < Infinity) return false;
    }
    if (!(best < near)) return false;
    fewer.most = near;
    for (const sooner of SOONER) {
      if (this.solveTwo(share, most * sooner) && this.replaces(i)) return true;
    }
    return false;
  }

  /** Two pieces of T seconds, the first for this share of them; the floor is a limit like others. */
  private solveTwo(share: number, T: number): boolean {
    const { fewer } = this;
    const { h } = fewer;
    h[0] = share * T;
    h[1] = T - h[0];
    fewer.far = Infinity;
    return Math.min(h[0], h[1]) >= this.settings.floorMs / 1000 && fewer.solveTwo();
  }

  private mergesFour(i: number): boolean {
    const { fewer, guess, near } = this;
    const { jump } = this.notes;
    const jumps = Math.abs(jump[i + 1]!) + Math.abs(jump[i + 2]!) + Math.abs(jump[i + 3]!);
    const T = this.secondsOf(i, 4);
    if (!(jumps * T * T < WILD_FOUR * near)) return false;
    const most = this.mostFor(i, 4, T);
    if (most === 0) return false;
    this.open(i, 4);
    const later = most / T;
    guess.forThree(this.pieces, this.notes, i);
    fewer.most = HOPE_THREE * near;
    if (!this.solveThree(i, later)) return false;
    let best = fewer.far;
    let { first, second } = guess;
    for (let way = 0; way < 4 && best > GOOD * near; way++) {
      guess.first = first + (way === 0 ? STEP : way === 1 ? -STEP : 0);
      guess.second = second + (way === 2 ? STEP : way === 3 ? -STEP : 0);
      fewer.most = best;
      if (!this.solveThree(i, later)) continue;
      best = fewer.far;
      ({ first, second } = guess);
      // Not back again.
      if (way === 0) way = 1;
      else if (way === 2) break;
    }
    if (!(best < near)) return false;
    guess.first = first;
    guess.second = second;
    fewer.most = near;
    for (const sooner of SOONER) if (this.solveThree(i, later * sooner) && this.replaces(i)) return true;
    return false;
  }

  private secondsOf(i: number, old: number): number {
    const { durationS } = this.pieces;
    let T = 0;
    for (let p = i; p < i + old; p++) T += durationS[p]!;
    return T;
  }

  /**
   * Seconds that fewer pieces may take in the place of [i, i + old), which take T; 0 where nothing may be changed. Leaves their
   * limit of speed.
   */
  private mostFor(i: number, old: number, T: number): number {
    const { tau } = this.notes;
    const length = tau[i + old]! - tau[i]!;
    this.speed = this.speedFor(i, old);
    return length < LONGEST_S && this.speed > 0 ? Math.max(T, LATER * length) : 0;
  }

  /** Whether two pieces can come from i to i + 3 in T seconds: by the least speed that a knot between them can have. */
  private reaches(i: number, T: number): boolean {
    const { x, y, vx, vy } = this.pieces;
    const end = i + 3;
    // It is (2 Δp − h1 v0 − h2 v1)/T, on the line from c = 2 Δp/T − v1 to c − (v0 − v1).
    const cx = (2 * (x[end]! - x[i]!)) / T - vx[end]!;
    const cy = (2 * (y[end]! - y[i]!)) / T - vy[end]!;
    const dx = vx[i]! - vx[end]!;
    const dy = vy[i]! - vy[end]!;
    const share = (cx * dx + cy * dy) / (dx * dx + dy * dy);
    const s = share > 0 ? Math.min(share, 1) : 0;
    const wx = cx - s * dx;
    const wy = cy - s * dy;
    return wx * wx + wy * wy <= (AT_LIMIT * this.speed) ** 2;
  }

  private open(i: number, old: number): void {
    this.fewer.open(this.pieces, this.notes, i, old, this.speed, this.limits.accel);
  }

  /** The limit of speed for pieces [i, i + old): a lower one where a stroke begins and ends, if that is asked for; 0 on the verge. */
  private speedFor(i: number, old: number): number {
    const { speed, easeSpeed } = this.limits;
    if (easeSpeed >= speed) return speed;
    const { vx, vy } = this.pieces;
    let slow = 0;
    for (let p = i; p <= i + old; p++) if (Math.hypot(vx[p]!, vy[p]!) <= AT_LIMIT * easeSpeed) slow++;
    if (slow === 0) return speed;
    return slow > old ? easeSpeed : 0;
  }

  /** Three pieces with knots at the shares guessed of the second and the third of pieces [i, i + 4), everything `later` times as long. */
  private solveThree(i: number, later: number): boolean {
    const { fewer, guess } = this;
    const { durationS, vx, vy, ax, ay } = this.pieces;
    const { h } = fewer;
    const floor = this.settings.floorMs / 1000;
    const u = guess.first * durationS[i + 1]!;
    const v = guess.second * durationS[i + 2]!;
    h[0] = (durationS[i]! + u) * later;
    h[1] = (durationS[i + 1]! - u + v) * later;
    h[2] = (durationS[i + 2]! - v + durationS[i + 3]!) * later;
    if (!(h[0] >= floor && h[1] >= floor && h[2] >= floor)) return false;
    fewer.vx[1] = vx[i + 1]! + u * ax[i + 1]!;
    fewer.vy[1] = vy[i + 1]! + u * ay[i + 1]!;
    return fewer.solveThree();
  }

  /** Puts the fewer pieces in the place of those from i on, if they are near the line all the way. */
  private replaces(i: number): boolean {
    if (!this.holds(i)) return false;
    const { fewer, pieces, notes } = this;
    const { count, h, vx: wx, vy: wy } = fewer;
    const { durationS, x, y, vx, vy, ax, ay } = pieces;
    for (let j = 0; j < count; j++) {
      const p = i + j;
      const d = h[j]!;
      durationS[p] = d;
      ax[p] = (wx[j + 1]! - wx[j]!) / d;
      ay[p] = (wy[j + 1]! - wy[j]!) / d;
      notes.middle[p] = this.middle[j]!;
      if (j > 0) {
        const before = h[j - 1]! / 2;
        x[p] = x[p - 1]! + before * (wx[j - 1]! + wx[j]!);
        y[p] = y[p - 1]! + before * (wy[j - 1]! + wy[j]!);
        vx[p] = wx[j]!;
        vy[p] = wy[j]!;
        notes.tau[p] = this.tau[j]!;
        notes.block[p] = this.block[j]!;
        notes.knot[p] = this.knot[j]!;
      }
      notes.note(p, pieces);
    }
    const end = i + count;
    this.putState(end + 1, end);
    return true;
  }

  private holds(i: number): boolean {
    const { walk, notes } = this;
    const { count, h, vx, vy } = this.fewer;
    walk.k = notes.block[i]!;
    walk.tau = notes.tau[i]!;
    walk.x = this.pieces.x[i]!;
    walk.y = this.pieces.y[i]!;
    for (let j = 0; j < count; j++) {
      if (!canStep(this.limits, vx[j]!, vy[j]!)) return false;
      this.block[j] = walk.k;
      this.tau[j] = walk.tau;
      this.knot[j] = walk.end;
      const half = Math.max(HALF_LOOKS, Math.ceil(h[j]! / (2 * LOOK_S)));
      if (!walk.follow(j, h, vx, vy, half)) return false;
      this.middle[j] = walk.middle;
    }
    return Math.abs(walk.tau - notes.tau[i + count + 1]!) <= SAME_S;
  }
}
