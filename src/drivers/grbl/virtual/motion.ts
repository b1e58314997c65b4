/** The move queue of the virtual Grbl, and the axes that perform it over time. */
import type { GrblAxisLimits, Axes, Move } from "../model/planner.js";
import { exitLimit2, moveOf } from "../model/planner.js";

/** A piece of constant acceleration. */
interface Phase {
  readonly durationS: number;
  readonly accel: number;
}

/** How many slices of motion a Grbl has ready, and how long each is, s. A move that is cut into them has left its queue. */
const SLICES = 5;
const SLICE_S = 0.01;

/** Speeds and lengths below this count as 0: mm/s, mm. */
const NOTHING = 1e-9;

export class GrblMotion {
  /** Times at which it came to rest only because the next move was not there yet. */
  starvedCount = 0;
  movingS = 0;
  /** It has come to rest, and no line has asked for that. */
  private isDry = false;
  /** The first one is running. */
  private moves: Move[] = [];
  private phases: Phase[] = [];
  /** Start of the first move, and its progress at `atS`. */
  private start: Axes = [0, 0, 0];
  private doneMm = 0;
  private speed = 0;
  private atS = 0;
  /** End of the last move in the queue. */
  private target: Axes = [0, 0, 0];
  private isHolding = false;

  constructor(
    private readonly queueMoves: number,
    private readonly limits: () => GrblAxisLimits,
    private readonly onSteps: (at: Axes) => Axes,
    private readonly arrived: (at: Axes) => void,
  ) {}

  get isFull(): boolean {
    return this.freeCount <= 0;
  }

  get isEmpty(): boolean {
    return this.moves.length === 0;
  }

  get isMoving(): boolean {
    return this.speed > 0 || this.phases.length > 0;
  }

  get freeCount(): number {
    return this.queueMoves - this.moves.length + this.cutCount;
  }

  get end(): Axes {
    return this.target;
  }

  get at(): Axes {
    return this.isEmpty ? this.start : this.along(this.moves[0].unit, this.doneMm);
  }

  get speedMmPerS(): number {
    return this.speed;
  }

  /** Machine seconds at which the current piece ends; Infinity at rest. */
  get nextS(): number {
    return this.phases.length > 0 ? this.atS + this.phases[0].durationS : Infinity;
  }

  /** Queues a move to `to`, which must differ from the end of the queue. `go` starts the motion. */
  queue(to: Axes, feed: number): void {
    const before = this.moves[this.moves.length - 1] ?? null;
    if (this.isDry && this.isEmpty) this.starvedCount++;
    this.isDry = false;
    this.moves.push(moveOf(this.target, to, feed, this.limits(), before));
    this.target = to;
    if (this.isMoving && !this.isHolding) this.plan();
  }

  /** A line has waited for the rest. */
  mayRest(): void {
    this.isDry = false;
  }

  /** Starts the motion, or resumes it after a hold. */
  go(nowS: number): void {
    this.atS = nowS;
    this.isHolding = false;
    this.plan();
  }

  /** Brakes along the path. */
  hold(): void {
    this.isHolding = true;
    this.plan();
  }

  /** Drops the queue and stops at the current position. */
  stop(): void {
    this.start = this.target = this.onSteps(this.at);
    this.moves = [];
    this.phases = [];
    this.doneMm = this.speed = 0;
    this.isHolding = this.isDry = false;
    this.arrived(this.start);
  }

  /** At rest: it stands at this position by its own count from now on. */
  jumpTo(at: Axes): void {
    this.start = this.target = at;
  }

  /** Performs everything before a given time. */
  advance(toS: number): void {
    while (this.phases.length > 0) {
      const { durationS, accel } = this.phases[0];
      const isWhole = this.atS + durationS <= toS;
      const t = isWhole ? durationS : Math.max(0, toS - this.atS);
      this.movingS += t;
      this.doneMm += this.speed * t + (accel * t * t) / 2;
      this.speed = Math.max(0, this.speed + accel * t);
      this.atS += t;
      if (!isWhole) {
        this.phases[0] = { durationS: durationS - t, accel };
        return;
      }
      this.phases.shift();
      if (this.phases.length === 0) this.phasesOver();
    }
    this.atS = Math.max(this.atS, toS);
  }

  /** The moves at the front that are cut into slices already: as many as possible, at their highest speeds. */
  private get cutCount(): number {
    if (!this.isMoving) return 0;
    const isShort = ({ lengthMm, speed }: Move): boolean => lengthMm <= speed * SLICE_S;
    const long = this.moves.findIndex((move) => !isShort(move));
    return Math.min(SLICES, long < 0 ? this.moves.length : long);
  }

  private phasesOver(): void {
    const [move] = this.moves;
    const isOver = move.lengthMm - this.doneMm < 1e-6;
    if (isOver) {
      // At the end of the queue, use the exact target: the sum of many moves drifts by rounding.
      this.start = this.moves.length === 1 ? this.target : this.along(move.unit, move.lengthMm);
      this.moves.shift();
      this.doneMm = 0;
      this.isDry = this.isEmpty;
      this.arrived(this.start);
    }
    if (this.speed < 1e-6 || this.isEmpty) this.speed = 0;
    if (!(this.isHolding && this.speed === 0)) this.plan();
  }

  /** The position `mm` after the start of the first move. */
  private along(unit: Axes, mm: number): Axes {
    const [x, y, z] = this.start;
    return [x + unit[0] * mm, y + unit[1] * mm, z + unit[2] * mm];
  }

  /** Plans the rest of the first move, from its current speed. */
  private plan(): void {
    this.phases = [];
    if (this.isEmpty) return;
    const { accel, speed, lengthMm } = this.moves[0];
    const leftMm = Math.max(0, lengthMm - this.doneMm);
    const now2 = this.speed ** 2;
    if (this.isHolding) {
      const end2 = Math.max(0, now2 - 2 * accel * leftMm);
      this.add((this.speed - Math.sqrt(end2)) / accel, -accel);
      return;
    }
    const end2 = Math.min(
      exitLimit2(this.moves, 0, Math.min(this.moves.length, this.queueMoves)),
      now2 + 2 * accel * leftMm,
    );
    const peak2 = Math.max(now2, Math.min(speed ** 2, accel * leftMm + (now2 + end2) / 2));
    const [peak, end] = [Math.sqrt(peak2), Math.sqrt(end2)];
    const cruiseMm = leftMm - (2 * peak2 - now2 - end2) / (2 * accel);
    this.add((peak - this.speed) / accel, accel);
    if (cruiseMm > NOTHING) this.add(cruiseMm / peak, 0);
    this.add((peak - end) / accel, -accel);
    // If only a rounding error is left of the move, it still has to end.
    if (this.phases.length === 0) this.phases.push({ durationS: 0, accel: 0 });
  }

  private add(durationS: number, accel: number): void {
    if (durationS > 0) this.phases.push({ durationS, accel });
  }
}
