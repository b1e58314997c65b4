/**
 * Writes runs for firmware with ramps (2.5.3 and newer): cuts each run into legs, in order of time, and writes each
 * leg as one command of the kind that the firmware has.
 *
 *   plan    |--block--|--block--|b|b|b|----------block----------|
 *   legs    |---leg---|---leg---|--leg--|--leg--|--leg--|--leg--|     every leg at least 5 ms (8 with LM)
 *
 * Cuts are at block ends where possible: the leg is then one parabola, and its command exact. Blocks too short for a
 * command are combined. Every leg leads from the predicted exact state of the board (steps and accumulators) to the
 * plan's position at the leg's end, with the plan's speeds at both ends. So rounding never adds up. Linear in the
 * number of blocks.
 */
import type { Trajectory } from "../../../plan/trajectory.js";
import { ACCUMULATOR_RANGE, rateFromStepsPerS, TICKS_PER_MS, TICKS_PER_S } from "../../../units.js";
import {
  newLeg,
  type Leg,
  type LegWriter,
  type Midway,
  type MotorLeg,
  type MotorState,
  type RunWriter,
} from "./leg.js";
import { HIGHEST_PLANNED_RATE, TOO_FAST } from "../protocol/limits.js";
import type { RunWalk } from "./run-walk.js";
import type { StreamColumns } from "./stream-columns.js";

/** If one acceleration misses a leg's end speeds by more than this, the leg gets two (0.2 mm/s at 80 steps/mm). */
const JOIN_RATE = rateFromStepsPerS(0.2 * 80);

/** Max deviation from the line: half a step, as a rate during one tick. */
const MAX_DEVIATION_RATE = ACCUMULATOR_RANGE / 2;

/** Max extra speed to make up for idle ticks: 32 steps/s, 0.4 mm/s at 80 steps/mm. */
const MAX_MAKE_UP_RATE = rateFromStepsPerS(32);

/** `turnTicks` for shaped motion: shorter, because its acceleration is higher, so the motor moves farther in that time. */
const SHAPED_TURN_TICKS = 12;

/** Min ticks of the command that ends a run, about 1 ms. The idle tick must fit too. */
const SHORTEST_TICKS = 26;

export class LegRuns implements RunWriter {
  private readonly leg = newLeg();
  private readonly half = newLeg();
  private runIndex = 0;
  /** Where the current leg ends: the tick, the block there, and whether the run ends too. */
  private cutTick = 0;
  private cutBlock = 0;
  private cutIsRunEnd = false;
  /** Pen moves still to be written during the run, in order of time. */
  private midway: readonly Midway[] = [];

  constructor(
    private readonly trajectory: Trajectory,
    private readonly walk: RunWalk,
    private readonly writer: LegWriter,
    private readonly columns: StreamColumns,
    private readonly m1: MotorState,
    private readonly m2: MotorState,
  ) {}

  /** A reversal within this many ticks of a cut needs no separate cut. */
  private get turnTicks(): number {
    return this.trajectory.planned ? SHAPED_TURN_TICKS : this.writer.turnTicks;
  }

  write(run: number, midway: readonly Midway[]): void {
    const { walk, columns, leg } = this;
    walk.begin(run, columns.boardTicks);
    if (walk.first === walk.end) return;
    this.runIndex = run;
    this.midway = midway;
    let block = walk.first;
    let notBefore = 0;
    for (;;) {
      const tick = columns.boardTicks;
      this.cut(tick, block, notBefore);
      this.setLeg(leg, tick, block);
      if (this.writer.turnTicks > 0 && this.shortenForTurn(leg, tick, block, notBefore))
        this.setLeg(leg, tick, block);
      if (this.writeLeg(leg)) {
        notBefore = 0;
        block = walk.blockAt(columns.boardTicks, Math.max(block, this.cutBlock));
      } else {
        notBefore = this.cutTick + this.writer.minTicks;
      }
      this.writeMidway(this.cutIsRunEnd ? Infinity : columns.boardTicks);
      if (this.cutIsRunEnd) break;
    }
    this.rest(run);
  }

  /** Writes the pen moves due by `tick`. */
  private writeMidway(tick: number): void {
    while (this.midwayTick() <= tick) {
      const [next, ...later] = this.midway;
      if (!next) return;
      this.midway = later;
      next.write(this.runIndex, this.walk.planS(this.columns.boardTicks));
    }
  }

  private midwayTick(): number {
    const next = this.midway[0];
    return next ? this.walk.tickOf(next.atS) : Infinity;
  }

  /** Waits if the last step of a run comes before its planned end, so that it takes the planned time on every firmware. */
  private rest(run: number): void {
    const { walk, columns, m1, m2 } = this;
    const ms = Math.round((walk.endTick(walk.end - 1) - columns.boardTicks) / TICKS_PER_MS);
    if (ms < 1) return;
    columns.text.line(`SM,${ms},0,0`);
    const planS = walk.planS(columns.boardTicks);
    columns.add(ms * TICKS_PER_MS, planS, run, m1.steps, m2.steps, m1.acc, m2.acc);
  }

  /** Sets the next cut after `tick`, which is in `block`; not before `notBefore`. */
  private cut(tick: number, block: number, notBefore: number): void {
    const { walk, writer } = this;
    const last = walk.end - 1;
    const runEnd = Math.max(walk.endTick(last), tick + 1);
    const shortest = Math.max(tick + writer.minTicks, notBefore);
    let soonest = shortest;
    let k = block;
    while (k < last && walk.endTick(k) < soonest) k++;
    if (k !== block && this.trajectory.planned) {
      // Room for two commands: short blocks of a shaped motion seldom fit one acceleration.
      soonest = Math.max(shortest, tick + 2 * writer.minTicks);
      while (k < last && walk.endTick(k) < soonest) k++;
    }
    let end = k === last ? runEnd : walk.endTick(k);
    if (k !== block) {
      // Short blocks are combined. Take no more of a following long block than needed.
      if (end - soonest >= writer.minTicks) end = soonest;
    } else {
      end = this.withinBlock(tick, block, soonest, end);
    }
    const midwayTick = this.midwayTick();
    if (midwayTick < end) {
      end = Math.max(soonest, midwayTick);
      k = walk.blockAt(end, block);
    }
    if (writer.turnTicks > 0) {
      let turn = this.firstTurn(tick, block, k, shortest, end);
      if (turn === Infinity) turn = this.turnNear(end, block, soonest, runEnd);
      if (turn !== Infinity) {
        end = turn;
        k = walk.blockAt(end, block);
      }
    }
    // The rest of the run must be long enough for a command, plus a tick for each pen move.
    const restTicks = writer.minTicks + this.midway.length;
    if (end < runEnd && runEnd - end < restTicks) {
      const earlier = runEnd - restTicks;
      end = earlier >= soonest && earlier < end ? earlier : runEnd;
      k = walk.blockAt(end, block);
      if (end === runEnd) k = last;
      else if (k > block && end === walk.endTick(k - 1)) k--;
    }
    if (end < runEnd) {
      while (k > block && walk.endTick(k - 1) >= end) k--;
    }
    this.cutTick = end;
    this.cutBlock = k;
    this.cutIsRunEnd = end >= runEnd;
  }

  /** Where to cut a block that is long enough for a command but may be too long for one. */
  private withinBlock(tick: number, block: number, soonest: number, blockEnd: number): number {
    const { walk, writer } = this;
    const jerkTicks = walk.hasJerk(block) ? writer.maxTicksForJerk(walk.jerk(block)) : Infinity;
    const longest = Math.max(Math.min(writer.maxTicks, jerkTicks), soonest - tick);
    const pieces = Math.ceil((blockEnd - tick) / longest);
    const end = pieces > 1 ? Math.max(soonest, tick + Math.round((blockEnd - tick) / pieces)) : blockEnd;
    return end;
  }

  /** The first tick at which a motor reverses within a leg; Infinity if none does. */
  private firstTurn(tick: number, from: number, to: number, soonest: number, end: number): number {
    const { walk, writer } = this;
    const earliest = Math.max(tick + this.turnTicks, soonest - writer.minTicks);
    const latest = end - this.turnTicks;
    for (let k = from; k <= to; k++) {
      const after = k === from ? earliest : Math.max(earliest, walk.endTick(k - 1));
      const turn = walk.turnTick(k, after, k === to ? latest : Math.min(latest, walk.endTick(k)));
      if (turn !== Infinity) return turn;
    }
    return Infinity;
  }

  /**
   * The tick near the cut at which a motor of a shaped motion reverses; Infinity if none does. The cut then moves there.
   * Shaped motion has short blocks of high acceleration: a separate command would be too short for the board, and
   * without any cut the motor would jump.
   */
  private turnNear(end: number, block: number, soonest: number, runEnd: number): number {
    const { walk, writer } = this;
    if (!this.trajectory.planned) return Infinity;
    const from = Math.max(soonest - 1, end - this.turnTicks);
    const to = Math.min(end + writer.minTicks, runEnd - writer.minTicks);
    for (let k = walk.blockAt(from, block); k < walk.end; k++) {
      const since = k > block ? Math.max(from, walk.endTick(k - 1)) : from;
      if (since >= to) break;
      const turn = walk.turnTick(k, since, Math.min(to, walk.endTick(k)));
      if (turn !== Infinity) return turn;
    }
    return Infinity;
  }

  /**
   * A motor that reverses too near to a leg's end for a separate leg is driven without reversing. On a long leg that
   * moves it off the line by a quarter of its reverse speed times the leg's duration. If that is too far, the reversal
   * gets the shortest possible leg. Returns true if the cut was moved.
   */
  private shortenForTurn({ ticks, m1, m2 }: Leg, tick: number, block: number, notBefore: number): boolean {
    const { walk, writer } = this;
    const motor = backwards(m1) > backwards(m2) ? m1 : m2;
    if (backwards(motor) * ticks <= 4 * MAX_DEVIATION_RATE || ticks < 2 * writer.minTicks) return false;
    const soonest = Math.max(tick + writer.minTicks, notBefore);
    const isAtStart = Math.abs(motor.v0) < Math.abs(motor.v1);
    const end = isAtStart ? soonest : Math.max(soonest, this.cutTick - writer.minTicks);
    if (end >= this.cutTick) return false;
    let k = walk.blockAt(end, block);
    while (k > block && walk.endTick(k - 1) >= end) k--;
    this.cutTick = end;
    this.cutBlock = k;
    this.cutIsRunEnd = false;
    return true;
  }

  private setLeg(leg: Leg, tick: number, block: number): void {
    const { walk } = this;
    walk.startLegs(tick, block, leg.m1, leg.m2);
    walk.endLegs(this.cutTick, this.cutBlock, this.cutIsRunEnd, leg.m1, leg.m2);
    leg.ticks = this.cutTick - tick;
    leg.isParabola = block === this.cutBlock && !walk.hasJerk(block);
    leg.isLast = this.cutIsRunEnd && this.runIndex === this.trajectory.runs.count - 1;
    this.slowDown(leg);
  }

  /**
   * Extends the leg's time if a motor would have to step too fast, or if the run's end is too
   * short for a command.
   */
  private slowDown(leg: Leg): void {
    const peak = Math.max(peakRate(leg.m1, leg.ticks), peakRate(leg.m2, leg.ticks));
    // Higher speed makes up for an idle tick. If that increase could be visible, the leg takes longer instead.
    const idle = peak > MAX_MAKE_UP_RATE * leg.ticks ? this.writer.idleTicks : 0;
    const ticks = Math.max(
      leg.ticks + idle,
      Math.ceil((leg.ticks * peak) / HIGHEST_PLANNED_RATE),
      this.cutIsRunEnd ? SHORTEST_TICKS : 1,
    );
    if (ticks <= leg.ticks) return;
    if (peak > HIGHEST_PLANNED_RATE) this.columns.warnOnce(TOO_FAST);
    const part = leg.ticks / ticks;
    for (const motor of [leg.m1, leg.m2]) {
      motor.v0 *= part;
      motor.v1 *= part;
    }
    this.walk.origin += ticks - leg.ticks;
    leg.ticks = ticks;
  }

  /**
   * Writes a leg as one command, or as two if one acceleration cannot join the speeds.
   * Returns false if nothing was written, because no step is due.
   */
  private writeLeg(leg: Leg): boolean {
    if (this.writer.joinsAnySpeeds || leg.isParabola || leg.ticks < 2 * this.writer.turnTicks)
      return this.writeCommand(leg);
    if (!isBent(leg.m1, leg.ticks) && !isBent(leg.m2, leg.ticks)) return this.writeCommand(leg);
    const { half } = this;
    half.ticks = leg.ticks >> 1;
    half.isParabola = true;
    half.isLast = false;
    halve(leg.m1, leg.ticks, half.ticks, half.m1);
    halve(leg.m2, leg.ticks, half.ticks, half.m2);
    if (!this.writeCommand(half)) return this.writeCommand(leg);
    leg.ticks -= half.ticks;
    for (const [motor, first] of [
      [leg.m1, half.m1],
      [leg.m2, half.m2],
    ] as const) {
      motor.p0 = first.p1;
      motor.v0 = first.v1;
    }
    this.writeCommand(leg);
    return true;
  }

  private writeCommand(leg: Leg): boolean {
    const { columns, m1, m2 } = this;
    const planS = this.walk.planS(columns.boardTicks);
    const ticks = this.writer.write(leg, m1, m2);
    if (ticks === 0) return false;
    columns.add(ticks, planS, this.runIndex, m1.steps, m2.steps, m1.acc, m2.acc);
    return true;
  }
}

const peakRate = (motor: MotorLeg, ticks: number): number =>
  Math.max(Math.abs(motor.v0), Math.abs(motor.v1), meanRate(motor, ticks));

const meanRate = (motor: MotorLeg, ticks: number): number =>
  Math.abs(rateFromStepsPerS(((motor.p1 - motor.p0) / ticks) * TICKS_PER_S));

/** The smaller of the end speeds if they have opposite signs, otherwise 0. */
const backwards = ({ v0, v1 }: MotorLeg): number => (v0 * v1 < 0 ? Math.min(Math.abs(v0), Math.abs(v1)) : 0);

/** True if one acceleration from v0 to v1 would miss the leg's distance. */
function isBent(motor: MotorLeg, ticks: number): boolean {
  const mean = rateFromStepsPerS(((motor.p1 - motor.p0) / ticks) * TICKS_PER_S);
  return Math.abs((motor.v0 + motor.v1) / 2 - mean) > JOIN_RATE;
}

/**
 * The first of two accelerations, each over half of the time T, that lead from p0, v0 to p1, v1:
 * a₁ + a₂ = 2 Δv/T and 3 a₁ + a₂ = 8 (Δp − v₀ T)/T².
 */
function halve(motor: MotorLeg, ticks: number, half: number, out: MotorLeg): void {
  const toSteps = 1 / rateFromStepsPerS(TICKS_PER_S);
  const v0 = motor.v0 * toSteps;
  const v1 = motor.v1 * toSteps;
  const mean = (motor.p1 - motor.p0 - v0 * ticks) / (ticks * ticks);
  const accel = 4 * mean - (v1 - v0) / ticks;
  out.p0 = motor.p0;
  out.v0 = motor.v0;
  out.p1 = motor.p0 + v0 * half + (accel * half * half) / 2;
  out.v1 = (v0 + accel * half) / toSteps;
}
