/**
 * A run of the trajectory by the millisecond: where both motors should be at each whole ms from its start, read as
 * the search for slices goes on.
 *
 * Where the plan is faster than slices can step, its time passes more slowly than the board's, and later samples
 * come the later.
 */
import { stepsPerSFromRate, TICKS_PER_MS } from "../../../units.js";
import type { MotorLeg, MotorPlace } from "./leg.js";
import { HIGHEST_SLICE_RATE } from "../protocol/limits.js";
import type { RunWalk } from "./run-walk.js";

/** Samples kept: more than a search looks back and ahead. A power of two. */
const KEPT = 2_048;
const MASK = KEPT - 1;

export class RunSamples {
  /** The board tick, from the run's start, at which the plan ends; Infinity until a sample has come to it. */
  endTick = Infinity;
  /** Motor speeds at the run's start, steps a ms. */
  startSpeed1 = 0;
  startSpeed2 = 0;
  /** Motor places at the run's end, steps. */
  readonly end1: MotorLeg = { p0: 0, p1: 0, v0: 0, v1: 0 };
  readonly end2: MotorLeg = { p0: 0, p1: 0, v0: 0, v1: 0 };
  isSlowed = false;
  /** The largest acceleration of the run, both motors' together, steps a ms². */
  peakAccel = 0;
  private readonly p1 = new Float64Array(KEPT);
  private readonly p2 = new Float64Array(KEPT);
  private readonly planTick = new Float64Array(KEPT);
  private count = 0;
  private block = 0;
  private firstTick = 0;
  private lastTick = 0;
  private readonly here1: MotorLeg = { p0: 0, p1: 0, v0: 0, v1: 0 };
  private readonly here2: MotorLeg = { p0: 0, p1: 0, v0: 0, v1: 0 };
  private readonly at = new Float64Array(4);

  constructor(private readonly walk: RunWalk) {}

  /** The first sample is of this board tick; the run that `walk` has begun sets out then or a little apart from it. */
  begin(boardTicks: number): void {
    const { walk } = this;
    const last = walk.end - 1;
    this.firstTick = walk.startTick();
    this.lastTick = walk.endTick(last);
    walk.endLegs(this.lastTick, last, true, this.end1, this.end2);
    this.count = 0;
    this.block = walk.first;
    this.endTick = Infinity;
    this.isSlowed = false;
    this.peakAccel = walk.peakAccel();
    this.add(boardTicks);
    this.startSpeed1 = stepsPerMs(this.here1.v0);
    this.startSpeed2 = stepsPerMs(this.here2.v0);
  }

  /** There is no step to make before the run's end, and no time to wait for it. */
  isNothing(m1: MotorPlace, m2: MotorPlace): boolean {
    const isThere = Math.round(this.end1.p1) === m1.steps && Math.round(this.end2.p1) === m2.steps;
    return isThere && this.lastTick - this.planTick[0]! < TICKS_PER_MS / 2;
  }

  /** Makes sure of the samples up to a tick from the run's start. */
  reach(tick: number): void {
    const last = Math.floor(tick / TICKS_PER_MS) + 1;
    while (this.count <= last) this.next();
  }

  /** Places of both motors (steps) and their speeds (steps a ms) at a tick that was made sure of. */
  read(tick: number, out: Float64Array): void {
    const { p1, p2 } = this;
    const ms = tick / TICKS_PER_MS;
    const whole = Math.floor(ms);
    const i = whole & MASK;
    const j = (whole + 1) & MASK;
    const part = ms - whole;
    out[2] = p1[j]! - p1[i]!;
    out[3] = p2[j]! - p2[i]!;
    out[0] = p1[i]! + part * out[2];
    out[1] = p2[i]! + part * out[3];
  }

  /** How far the straight way in steady speed between two ticks leaves the plan in the middle, steps. */
  sag(tick: number, ticks: number): number {
    const { at } = this;
    this.read(tick, at);
    const a1 = at[0]!;
    const a2 = at[1]!;
    this.read(tick + ticks, at);
    const b1 = at[0]!;
    const b2 = at[1]!;
    this.read(tick + ticks / 2, at);
    return Math.hypot(at[0]! - (a1 + b1) / 2, at[1]! - (a2 + b2) / 2);
  }

  /** Trajectory seconds at a tick. */
  planS(tick: number): number {
    const whole = Math.floor(tick / TICKS_PER_MS);
    const from = this.planTick[whole & MASK]!;
    const to = this.planTick[(whole + 1) & MASK]!;
    return this.walk.planS(from + (tick / TICKS_PER_MS - whole) * (to - from));
  }

  private next(): void {
    const { walk, lastTick } = this;
    const before = this.planTick[(this.count - 1) & MASK]!;
    const peak = Math.max(Math.abs(this.here1.v0), Math.abs(this.here2.v0));
    const pace = peak > HIGHEST_SLICE_RATE ? HIGHEST_SLICE_RATE / peak : 1;
    if (pace < 1) this.isSlowed = true;
    const tick = before + TICKS_PER_MS * pace;
    if (tick >= lastTick && this.endTick === Infinity) {
      this.endTick = (this.count - 1) * TICKS_PER_MS + (lastTick - before) / pace;
    }
    this.block = walk.blockAt(tick, this.block);
    this.add(tick);
  }

  private add(tick: number): void {
    const { walk, here1, here2, block } = this;
    const i = this.count++ & MASK;
    if (tick >= this.lastTick) {
      this.p1[i] = this.end1.p1;
      this.p2[i] = this.end2.p1;
      here1.v0 = 0;
      here2.v0 = 0;
    } else {
      walk.startLegs(Math.max(tick, this.firstTick), block, here1, here2);
      this.p1[i] = here1.p0;
      this.p2[i] = here2.p0;
    }
    this.planTick[i] = Math.min(tick, this.lastTick);
  }
}

const stepsPerMs = (rate: number): number => stepsPerSFromRate(rate) / 1_000;
