/**
 * Fewer, longer pieces of constant acceleration: the fit of `junction` and `blend` plans, so that the board gets a
 * command every 50 to 500 ms on a curve instead of one every few ms.
 *
 *   plan     |--|-|--|-|-|--|------------------|--|-|-|--|-|            blocks
 *   pieces   |------|-------|------------------|-----|-----|
 *            steady … , pair   kept             pair
 *
 * steady  one piece from wherever the last one ended, found by least squares (steady-piece.ts), as long as ε allows.
 *         It need not end on the plan; τ, the instant of the plan that it has come to, is where the plan is nearest.
 * pair    two pieces that end in the plan's own state at the end of a block. With T the time they take and m the
 *         velocity between them:  m = 2 Δp/T − (v0 + v1)/2,  a1 = 2 (m − v0)/T,  a2 = 2 (v1 − m)/T
 * kept    a block as planned: long, or a sharp corner, or where nothing else holds. Only from a state of the plan's.
 *
 * Where nothing goes on from a state beside the plan's, pieces are taken back until a pair leads onto the plan. In the end
 * neighbouring pieces are merged (merge-pieces.ts), but for `junction` plans.
 *
 * Two parabolas for an arc are slower in the middle of each than at their ends. At full speed pieces may
 * therefore take up to LATER of the plan's time, so that V holds at their ends.
 *
 * Kept: wherever it is looked at (`isNear`) the pieces are within ε of the planned line, beside it; along the line
 * they may run ahead or behind a little (`isBeside`). |a| ≤ A and |v| ≤ V within 0.1 %. Jumps of velocity at the
 * vertices of `junction` plans stay at the ends of pieces only.
 */
import { BlockColumns } from "./block-columns.js";
import { FitSource, isBeside } from "./fit-source.js";
import { SLACK, canStep, type RunLimits } from "./limits.js";
import type { RunEnd } from "./run-path.js";
import type { FitSettings, MotionMode } from "../settings/motion.js";
import { PieceMerger } from "./merge-pieces.js";
import { PieceChain } from "./piece-chain.js";
import { PieceNotes } from "./piece-notes.js";
import { SteadyPiece, type PieceStart } from "./steady-piece.js";

/** Looks at the distance for a piece or a pair, about, besides where blocks begin; and the share of ε that it may be there. */
const LOOKS = 6;
const BETWEEN = 0.93;
/** The same for `junction` plans, which bend at their vertices only. */
const JUNCTION_LOOKS = 12;
const JUNCTION_BETWEEN = 0.97;

/** Share of ε that a steady piece aims at: it is looked at less closely there. */
const AIM = 0.92;

/** Longest piece, s. */
const LONGEST_S = 1;

/** At full speed pairs may take so much more time than the plan. */
const LATER = 1.03;

/** Times of the plan that a pair may take, the first that keeps A. */
const STRETCHES = [1, 1.03];

/** What knots may use of the slack that limits have. */
const HARDLY = 1.0004;

/** Trials for one steady piece's length, and the length of the first piece of a run, s. */
const TRIALS = 3;
const FIRST_S = 0.06;

/** Blocks' ends that are tried for a pair; and so many pieces are taken back before one below the floor will do. */
const PAIR_TRIALS = 8;
const LONG_PAIRS = 4;

export class AccelerationFitter {
  private readonly source = new FitSource();
  private readonly steady: SteadyPiece;
  private readonly merger: PieceMerger;
  private readonly notes = new PieceNotes();
  private limits!: RunLimits;
  /** The run's pieces until they are merged. */
  private readonly out = new BlockColumns(0, false);
  /** v² times the line's bend is at most this; at a vertex of a `junction` plan it bends in no time. */
  private bend = 0;
  /** Where the next piece begins; whether that is the plan's own state at the beginning of block k. */
  private readonly at: PieceStart = { k: 0, tau: 0, x: 0, y: 0, vx: 0, vy: 0 };
  private isPlanned = true;
  /** First block that is to be kept, at or after `at.k`. */
  private anchor = 0;
  private guess = FIRST_S;
  /** What the next piece's length may be by that of the last one, by how near it came to ε. */
  private next = 1;
  /** Steady pieces since the last planned state: what `at`, and the count and clock of `out`, were before each. */
  private readonly chain = new PieceChain();
  /** The piece or pair that was found last: durations and accelerations. */
  private h1 = 0;
  private h2 = 0;
  private a1x = 0;
  private a1y = 0;
  private a2x = 0;
  private a2y = 0;

  constructor(
    private readonly settings: FitSettings,
    private readonly mode: MotionMode,
  ) {
    this.merger = new PieceMerger(this.source, settings, this.notes);
    this.steady = new SteadyPiece(mode !== "junction");
  }

  /** Appends the run in `from`, all of its blocks up to `end`, to `out` in fewer pieces. */
  write(from: BlockColumns, end: RunEnd, limits: RunLimits, out: BlockColumns): void {
    const { out: pieces, mode } = this;
    this.source.open(from, end);
    this.limits = limits;
    this.bend = mode === "junction" ? Infinity : limits.accel;
    pieces.clear();
    pieces.reserve(from.count + 1, 0);
    this.notes.reserve(from.count + 1);
    this.cover(from.count);
    // Merged pieces may be anywhere on the line at an instant: not where velocity jumps.
    if (mode !== "junction") this.merger.merge(pieces, limits);
    out.reserve(pieces.count, end.segmentCount);
    const { block, tau } = this.notes;
    for (let i = 0; i < pieces.count; i++) {
      pieces.alongMm[i] = this.source.alongAt(block[i]!, tau[i]!);
      out.pushFrom(pieces, i);
    }
  }

  /** Puts pieces in `out` for all of the plan's blocks. */
  private cover(blocks: number): void {
    this.chain.count = 0;
    this.anchor = 0;
    this.guess = FIRST_S;
    this.startPlanned(0);
    // Up to here only pairs and kept blocks: steady pieces have led nowhere.
    let calm = 0;
    while (this.at.k < blocks) {
      this.anchor = this.source.nextKept(Math.max(this.anchor, this.at.k));
      if (this.isPlanned && this.at.k === this.anchor) this.keep();
      else if (this.reachAnchor()) continue;
      else if (!(this.at.k >= calm && this.advance()) && !this.join()) {
        if (this.isPlanned) this.keep();
        else calm = Math.max(calm, this.goBack());
      }
    }
  }

  /** Writes a pair to the block that is kept next, where that is no farther than two pieces like the last one. */
  private reachAnchor(): boolean {
    const left = this.source.startOf(this.anchor) - this.at.tau;
    if (left > 2.1 * this.guess || (this.isPlanned && this.anchor < this.at.k + 2)) return false;
    if (!this.tryPair(this.anchor)) return false;
    this.writePair(this.anchor);
    return true;
  }

  /** Writes a steady piece, as long as is found; false where there is none worth it. */
  private advance(): boolean {
    const { at, source } = this;
    const left = source.startOf(this.anchor) - at.tau;
    const floor = this.settings.floorMs / 1000;
    const least = Math.max(floor, source.startOf(at.k + 1) - at.tau);
    let most = Math.min(LONGEST_S, left > 3 * this.guess ? left / 2 : left / 3);
    while (most >= least) {
      const h = this.longest(Math.min(this.guess, most), least, most);
      if (h === 0) return false;
      this.h1 = h;
      if (this.isNear(Infinity)) {
        this.guess = Math.min(h * this.next, LONGEST_S);
        this.writeSteady();
        return true;
      }
      most = 0.88 * h;
    }
    return false;
  }

  /** Duration of a steady piece between `least` and `most`, `first` or else shorter, its acceleration left in a1; or 0. */
  private longest(first: number, least: number, most: number): number {
    let h = Math.min(most, Math.max(first, least));
    for (let trial = 0; trial < TRIALS; trial++) {
      const share = this.tryPiece(h);
      const change = 1 / Math.cbrt(Math.max(share, 0.01));
      this.next = Math.min(1.5, Math.max(0.8, 0.95 * change));
      if (share <= 1) return h;
      if (h <= least) return 0;
      h = Math.max(least, h * Math.max(0.4, Math.min(0.8, 0.85 * change)));
    }
    return 0;
  }

  /** One trial: the distance from the line as a share of what is allowed; 2 where a limit is broken. */
  private tryPiece(h: number): number {
    const { at, steady, limits } = this;
    steady.solve(this.source.blocks, at, h);
    let vx = at.vx + h * steady.ax;
    let vy = at.vy + h * steady.ay;
    const v = Math.sqrt(vx * vx + vy * vy);
    if (!(v < Infinity)) return 8;
    const less = v > limits.speed * HARDLY ? (limits.speed * HARDLY) / v : 1;
    vx *= less;
    vy *= less;
    this.a1x = (vx - at.vx) / h;
    this.a1y = (vy - at.vy) / h;
    if (this.a1x * this.a1x + this.a1y * this.a1y > (limits.accel * SLACK) ** 2) return 2;
    if (!this.keepsSpeed(vx, vy)) return 2;
    return steady.beside / (AIM * this.settings.toleranceMm);
  }

  private writeSteady(): void {
    const { at, h1: h, source, steady, notes, out } = this;
    this.chain.push(at, out);
    notes.middle[out.count] = steady.leftHalfway(h, this.a1x, this.a1y);
    notes.knot[out.count + 1] = steady.leftAtEnd(h, this.a1x, this.a1y);
    this.push(h, this.a1x, this.a1y, at.k, at.tau);
    this.isPlanned = false;
    // τ goes to where the plan is nearest.
    const { x, y, vx, vy, ax, ay, startS } = source.blocks;
    const end = source.startOf(this.anchor);
    let tau = at.tau + h;
    let k = at.k;
    while (k + 1 < this.anchor && startS[k + 1]! <= tau) k++;
    const d = tau - startS[k]!;
    const wx = vx[k]! + d * ax[k]!;
    const wy = vy[k]! + d * ay[k]!;
    const px = x[k]! + (d * (vx[k]! + wx)) / 2;
    const py = y[k]! + (d * (vy[k]! + wy)) / 2;
    const w2 = wx * wx + wy * wy;
    if (w2 > 0) tau += ((at.x - px) * wx + (at.y - py) * wy) / w2;
    tau = Math.min(Math.max(tau, at.tau + h / 2), end - h / 2);
    while (k > at.k && startS[k]! > tau) k--;
    while (k + 1 < this.anchor && startS[k + 1]! <= tau) k++;
    at.tau = tau;
    at.k = k;
  }

  /** Writes a pair that ends as planned, at the anchor or before it; false where none holds. */
  private join(): boolean {
    const { at, source } = this;
    const floor = this.settings.floorMs / 1000;
    const reach = at.tau + 2 * Math.min(LONGEST_S, 1.5 * this.guess);
    let m = at.k + 1;
    while (m < this.anchor && source.startOf(m) <= reach) m++;
    const least = at.k + (this.isPlanned ? 2 : 1);
    for (let trial = 0; trial < PAIR_TRIALS && m >= least; trial++) {
      if (source.startOf(m) - at.tau < 2 * floor) break;
      if (this.tryPair(m)) {
        this.writePair(m);
        return true;
      }
      m = Math.min(m - 1, at.k + Math.floor(0.7 * (m - at.k)));
    }
    return false;
  }

  /** Whether a pair leads to the beginning of block m in the plan's time or a little more; leaves it for `writePair`. */
  private tryPair(m: number): boolean {
    const length = this.source.startOf(m) - this.at.tau;
    if (!(length > 0) || length > 2 * LONGEST_S) return false;
    for (const stretch of STRETCHES) {
      if (this.solvePair(m, length * stretch)) return this.isNear(length);
    }
    return false;
  }

  /** The pair that leads to the beginning of block m in `wanted` seconds or, for V, a little more; whether it keeps the limits. */
  private solvePair(m: number, wanted: number): boolean {
    const { at, source, limits } = this;
    const { durationS, vx, vy, ax, ay } = source.blocks;
    const d = durationS[m - 1]!;
    const vx1 = vx[m - 1]! + d * ax[m - 1]!;
    const vy1 = vy[m - 1]! + d * ay[m - 1]!;
    const dx = source.xOf(m) - at.x;
    const dy = source.yOf(m) - at.y;
    const sx = (at.vx + vx1) / 2;
    const sy = (at.vy + vy1) / 2;
    let T = wanted;
    let mx = (2 * dx) / T - sx;
    let my = (2 * dy) / T - sy;
    const most2 = (limits.speed * HARDLY) ** 2;
    if (mx * mx + my * my > most2) {
      // The latest T for which |2 Δp / T − s| = V.
      const d2 = dx * dx + dy * dy;
      const along = dx * sx + dy * sy;
      const root = along * along - d2 * (sx * sx + sy * sy - most2);
      if (!(root >= 0)) return false;
      T = (2 * d2) / (along + Math.sqrt(root));
      if (!(T <= wanted * LATER)) return false;
      mx = (2 * dx) / T - sx;
      my = (2 * dy) / T - sy;
    }
    if (!this.keepsSpeed(mx, my)) return false;
    const h = T / 2;
    this.h1 = this.h2 = h;
    this.a1x = (mx - at.vx) / h;
    this.a1y = (my - at.vy) / h;
    this.a2x = (vx1 - mx) / h;
    this.a2y = (vy1 - my) / h;
    const most = (limits.accel * SLACK) ** 2;
    if (this.a1x * this.a1x + this.a1y * this.a1y > most) return false;
    return this.a2x * this.a2x + this.a2y * this.a2y <= most;
  }

  private writePair(m: number): void {
    const { at, out, chain } = this;
    // Steady pieces and the pair are one way from planned state to planned state.
    if (this.isWorth(this.chain.firstBlock(at.k), m, this.chain.count + 2)) {
      this.pushPair(m);
    } else {
      while (chain.count > 0) chain.pop(at, out);
      for (let k = at.k; k < m; k++) this.copy(k);
    }
    this.startPlanned(m);
  }

  private pushPair(m: number): void {
    const { at, source, notes, out, h1, a1x, a1y, h2, a2x, a2y } = this;
    const { tau } = at;
    const end = source.startOf(m);
    notes.middle[out.count] = this.leftAfter(h1 / 2, a1x, a1y, (3 * tau + end) / 4);
    this.push(h1, a1x, a1y, at.k, tau);
    // τ goes to where the plan is nearest.
    at.tau = (tau + end) / 2;
    this.leftAfter(0, 0, 0, at.tau);
    at.tau = Math.min(Math.max(at.tau + source.aheadS, tau), end);
    while (at.k + 1 < m && source.startOf(at.k + 1) <= at.tau) at.k++;
    notes.knot[out.count] = this.leftAfter(0, 0, 0, at.tau);
    notes.middle[out.count] = this.leftAfter(h2 / 2, a2x, a2y, (at.tau + end) / 2);
    this.push(h2, a2x, a2y, at.k, at.tau);
  }

  /** How far to the left of the plan's line at an instant the pen is `t` seconds after `at`, under (ax, ay). */
  private leftAfter(t: number, ax: number, ay: number, tau: number): number {
    const { at, source } = this;
    const x = at.x + t * (at.vx + (t * ax) / 2);
    const y = at.y + t * (at.vy + (t * ay) / 2);
    return source.leftOf(x, y, at.k, tau);
  }

  /** Whether so many pieces for blocks [k, m) are fewer; or as many, where that leaves fewer short ones. */
  private isWorth(k: number, m: number, pieces: number): boolean {
    if (pieces !== m - k) return pieces < m - k;
    const { durationS } = this.source.blocks;
    const floor = this.settings.floorMs / 1000;
    for (let i = k; i < m; i++) if (durationS[i]! < floor) return true;
    return false;
  }

  /** Takes back steady pieces until a pair leads onto the plan; returns up to where that has been tried. */
  private goBack(): number {
    const { at, out, chain, source } = this;
    const floor = this.settings.floorMs / 1000;
    const tried = at.k + 1;
    let far = Math.min(tried, this.anchor);
    for (let taken = 0; chain.count > 0; taken++) {
      chain.pop(at, out);
      this.isPlanned = chain.count === 0;
      while (source.startOf(far) > at.tau + 2 * LONGEST_S) far--;
      for (let m = far; m > at.k + 1; m--) {
        if (taken < LONG_PAIRS && source.startOf(m) - at.tau < 2 * floor) break;
        if (!this.tryPair(m)) continue;
        this.writePair(m);
        return at.k;
      }
    }
    return tried;
  }

  private keep(): void {
    this.copy(this.at.k);
    this.startPlanned(this.at.k + 1);
  }

  private copy(k: number): void {
    const { notes, out, source } = this;
    const i = out.count;
    notes.tau[i] = source.startOf(k);
    notes.block[i] = k;
    notes.knot[i] = notes.middle[i] = 0;
    source.copy(k, out);
  }

  private startPlanned(k: number): void {
    const { at, source } = this;
    const { blocks } = source;
    this.chain.count = 0;
    this.isPlanned = true;
    this.notes.knot[this.out.count] = 0;
    at.k = k;
    at.tau = source.startOf(k);
    at.x = source.xOf(k);
    at.y = source.yOf(k);
    at.vx = k < blocks.count ? blocks.vx[k]! : 0;
    at.vy = k < blocks.count ? blocks.vy[k]! : 0;
  }

  /** Writes one piece and goes to its end. */
  private push(h: number, ax: number, ay: number, k: number, tau: number): void {
    const { at, notes, out } = this;
    notes.tau[out.count] = tau;
    notes.block[out.count] = k;
    out.push(h, at.x, at.y, at.vx, at.vy, ax, ay, 0);
    at.x += h * (at.vx + (h * ax) / 2);
    at.y += h * (at.vy + (h * ay) / 2);
    at.vx += h * ax;
    at.vy += h * ay;
  }

  /** Speed runs straight between a piece's ends, and both limits are convex: the ends tell. */
  private keepsSpeed(vx: number, vy: number): boolean {
    const { limits } = this;
    return vx * vx + vy * vy <= (limits.speed * SLACK) ** 2 && canStep(limits, vx, vy);
  }

  /**
   * Compares the pieces with the plan: where each block that they replace begins, and within those that are not short.
   *
   * @param length how much of the plan's time the pair stands for; Infinity: one steady piece of h1 seconds
   */
  private isNear(length: number): boolean {
    const { at, source, h1, a1x, a1y, bend } = this;
    const { count, startS, durationS, x, y, vx, vy, ax, ay } = source.blocks;
    const { tau, x: x0, y: y0, vx: vx0, vy: vy0 } = at;
    const isPair = length < Infinity;
    const end = tau + (isPair ? length : h1);
    const stretch = isPair ? (h1 + this.h2) / length : 1;
    const changeX = isPair ? this.a2x - a1x : 0;
    const changeY = isPair ? this.a2y - a1y : 0;
    const isJunction = this.mode === "junction";
    const most = (isJunction ? JUNCTION_BETWEEN : BETWEEN) * this.settings.toleranceMm;
    // At a vertex of a `junction` plan the way between two looks may bend.
    const least = isJunction ? 2 : 1;
    const often = (isJunction ? JUNCTION_LOOKS : LOOKS) / (end - tau);
    for (let i = at.k; i < count; i++) {
      const start = startS[i]!;
      if (start >= end) break;
      const d = durationS[i]!;
      const looks = d * often > least + 0.5 ? Math.round(d * often) : least;
      for (let look = 0; look < looks; look++) {
        const u = (d * look) / looks;
        if (start + u <= tau) continue;
        if (start + u >= end) break;
        const t = (start + u - tau) * stretch;
        const later = t > h1 ? t - h1 : 0;
        const wx = vx[i]! + u * ax[i]!;
        const wy = vy[i]! + u * ay[i]!;
        const px = x[i]! + (u * (vx[i]! + wx)) / 2;
        const py = y[i]! + (u * (vy[i]! + wy)) / 2;
        const dx = x0 + t * vx0 + (a1x * t * t + changeX * later * later) / 2 - px;
        const dy = y0 + t * vy0 + (a1y * t * t + changeY * later * later) / 2 - py;
        if (!isBeside(dx, dy, wx, wy, most, bend)) return false;
      }
    }
    return true;
  }
}
