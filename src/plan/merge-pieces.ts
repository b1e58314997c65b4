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
import type { FitSettings } from "./settings.js";

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

/** Rounds of that search: it goes on while the distance is below so many times ε, until it is within the share GOOD of it. */
const HOPES = [1.7];
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
    this.walk = new PlanWalk(source);
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
    const near = BETWEEN * this.settings.toleranceMm;
    const { jump } = this.notes;
    if (!this.isTame(i, 3, Math.abs(jump[i + 1]!) + Math.abs(jump[i + 2]!), WILD_THREE * near)) return false;
    const most = this.open(i, 3);
    if (most === 0) return false;
    const { fewer, guess } = this;
    const floor = this.settings.floorMs / 1000;
    guess.forTwo(this.pieces, this.notes, i);
    let best = near;
    let share = 0;
    for (let way = 0; way < 4 && best > GOOD * near; way++) {
      const s = way === 1 ? guess.both : guess.across + (way === 2 ? -ASIDE : way === 3 ? ASIDE : 0);
      if (Math.min(s, 1 - s) * most < floor) continue;
      const far = fewer.solveTwo(s, most, best);
      if (!(far < best)) continue;
      best = far;
      share = s;
    }
    if (share === 0) return false;
    for (const sooner of SOONER) {
      if (Math.min(share, 1 - share) * most * sooner < floor) continue;
      if (fewer.solveTwo(share, most * sooner, near) < near && this.replaces(i, near)) return true;
    }
    return false;
  }

  private mergesFour(i: number): boolean {
    const near = BETWEEN * this.settings.toleranceMm;
    const { jump } = this.notes;
    const jumps = Math.abs(jump[i + 1]!) + Math.abs(jump[i + 2]!) + Math.abs(jump[i + 3]!);
    if (!this.isTame(i, 4, jumps, WILD_FOUR * near)) return false;
    const most = this.open(i, 4);
    if (most === 0) return false;
    const { guess } = this;
    const later = most / this.fewer.oldS;
    guess.forThree(this.pieces, this.notes, i);
    let { first, second } = guess;
    let best = this.solveThree(i, first, second, later, HOPES[0]! * near);
    let step = STEP;
    for (const hope of HOPES) {
      if (best <= GOOD * near || !(best < hope * near)) break;
      const before = best;
      for (let way = 0; way < 4; way++) {
        const f = first + (way === 0 ? step : way === 1 ? -step : 0);
        const s = second + (way === 2 ? step : way === 3 ? -step : 0);
        const far = this.solveThree(i, f, s, later, best);
        if (!(far < best)) continue;
        best = far;
        first = f;
        second = s;
        // Not back again.
        if (way === 0) way = 1;
        else if (way === 2) break;
      }
      if (best === before) step /= 2;
    }
    if (!(best < near)) return false;
    for (const sooner of SOONER) {
      if (this.solveThree(i, first, second, later * sooner, near) < near && this.replaces(i, near))
        return true;
    }
    return false;
  }

  /** Whether fewer pieces than [i, i + old) can do at all, with these jumps between them; not where the pen is at rest there. */
  private isTame(i: number, old: number, jumps: number, most: number): boolean {
    const { durationS } = this.pieces;
    let T = 0;
    for (let p = i; p < i + old; p++) T += durationS[p]!;
    return jumps * T * T < most;
  }

  /** Opens pieces [i, i + old) to become fewer; returns the seconds these may take, 0 where nothing may be changed. */
  private open(i: number, old: number): number {
    const { fewer, notes } = this;
    const length = notes.tau[i + old]! - notes.tau[i]!;
    const speed = this.speedFor(i, old);
    if (!(length < LONGEST_S) || speed === 0) return 0;
    fewer.open(this.pieces, notes, i, old, speed, this.limits.accel);
    return Math.max(fewer.oldS, LATER * length);
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

  /** Three pieces with knots at these shares of the second and the third of pieces [i, i + 4), everything `later` times as long. */
  private solveThree(i: number, first: number, second: number, later: number, most: number): number {
    const { durationS, vx, vy, ax, ay } = this.pieces;
    const floor = this.settings.floorMs / 1000;
    const u = first * durationS[i + 1]!;
    const v = second * durationS[i + 2]!;
    const h1 = (durationS[i]! + u) * later;
    const h2 = (durationS[i + 1]! - u + v) * later;
    const h3 = (durationS[i + 2]! - v + durationS[i + 3]!) * later;
    if (!(h1 >= floor && h2 >= floor && h3 >= floor)) return Infinity;
    return this.fewer.solveThree(h1, h2, h3, vx[i + 1]! + u * ax[i + 1]!, vy[i + 1]! + u * ay[i + 1]!, most);
  }

  /** Puts the fewer pieces in the place of those from i on, if they are within `near` of the line all the way. */
  private replaces(i: number, near: number): boolean {
    if (!this.holds(i, near)) return false;
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

  private holds(i: number, near: number): boolean {
    const { walk, notes } = this;
    const { count, h, vx, vy } = this.fewer;
    walk.k = notes.block[i]!;
    walk.tau = notes.tau[i]!;
    let x = this.pieces.x[i]!;
    let y = this.pieces.y[i]!;
    for (let j = 0; j < count; j++) {
      const d = h[j]!;
      const wx = vx[j]!;
      const wy = vy[j]!;
      if (!canStep(this.limits, wx, wy)) return false;
      this.block[j] = walk.k;
      this.tau[j] = walk.tau;
      this.knot[j] = walk.end;
      const ax = (vx[j + 1]! - wx) / d;
      const ay = (vy[j + 1]! - wy) / d;
      const half = Math.max(HALF_LOOKS, Math.ceil(d / (2 * LOOK_S)));
      if (!walk.follow(x, y, wx, wy, ax, ay, d, half, near)) return false;
      this.middle[j] = walk.middle;
      x += (d * (wx + vx[j + 1]!)) / 2;
      y += (d * (wy + vy[j + 1]!)) / 2;
    }
    return Math.abs(walk.tau - notes.tau[i + count + 1]!) <= SAME_S;
  }
}
