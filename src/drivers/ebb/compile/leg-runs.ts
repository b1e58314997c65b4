/**
 * Writes runs for firmware with ramps (2.5.3 and newer): cuts each run into legs, in order of time, and writes each
 * leg as one command, of a kind that the firmware knows.
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
import { ACCUMULATOR_RANGE, rateFromStepsPerS, TICKS_PER_MS } from "../../../units.js";
import {
  MAX_TICKS,
  TOO_FAST,
  type Leg,
  type LegWriter,
  type PenEvent,
  type MotorLeg,
  type RunCommandWriter,
} from "./leg.js";
import type { MotorPoint, RunWalk } from "./run-walk.js";
import type { StreamColumns } from "./stream-columns.js";

/** If one acceleration misses a leg's end speeds by more than this, the leg gets two (0.2 mm/s at 80 steps/mm). */
const JOIN_RATE = rateFromStepsPerS(0.2 * 80);

/** Plans are slowed down to this rate, to leave room for corrections of fractions of a step. */
const HIGHEST_PLANNED_RATE = Math.floor(0.985 * ACCUMULATOR_RANGE);

/** Max deviation from the line: half a step, as a rate during one tick. */
const MAX_DEVIATION_RATE = ACCUMULATOR_RANGE / 2;

/** Max extra speed to make up for idle ticks: 32 steps/s, 0.4 mm/s at 80 steps/mm. */
const MAX_MAKE_UP_RATE = rateFromStepsPerS(32);

/** `turnTicks` for shaped motion: fewer, because its acceleration is higher, so the motor moves farther in that time. */
const SHAPED_TURN_TICKS = 12;

/** Min ticks of the command that ends a run, about 1 ms. The idle tick must fit too. */
const SHORTEST_TICKS = 26;

/** The end of a leg. */
interface Cut {
  readonly tick: number;
  /** The block that ends at that tick or contains it. */
  readonly block: number;
  readonly isRunEnd: boolean;
}

export class LegRuns implements RunCommandWriter {
  private runIndex = 0;
  /** Pen moves still to be written during the run, in order of time. */
  private midway: readonly PenEvent[] = [];

  constructor(
    private readonly trajectory: Trajectory,
    private readonly walk: RunWalk,
    private readonly writer: LegWriter,
    private readonly columns: StreamColumns,
  ) {}

  /** A reversal within this many ticks of a cut needs no separate cut. */
  private get turnTicks(): number {
    return this.trajectory.planned ? SHAPED_TURN_TICKS : this.writer.turnTicks;
  }

  write(run: number, fromS: number | undefined, midway: readonly PenEvent[]): void {
    const { walk, columns } = this;
    walk.begin(run, columns.boardTicks, fromS);
    if (walk.first === walk.end) return;
    this.runIndex = run;
    this.midway = midway;
    if (fromS !== undefined) this.writeMidway(columns.boardTicks);
    let block = walk.first;
    let notBefore = 0;
    for (let isRunEnd = false; !isRunEnd;) {
      const tick = columns.boardTicks;
      let cut = this.nextCut(tick, block, notBefore);
      let leg = this.legTo(cut, tick, block);
      const beforeTurn = this.cutForTurn(leg, cut, tick, block, notBefore);
      if (beforeTurn) {
        cut = beforeTurn;
        leg = this.legTo(cut, tick, block);
      }
      if (this.writeLeg(this.slowedDown(leg, cut.isRunEnd))) {
        notBefore = 0;
        block = walk.blockAt(columns.boardTicks, Math.max(block, cut.block));
      } else {
        notBefore = cut.tick + this.writer.minTicks;
      }
      isRunEnd = cut.isRunEnd;
      this.writeMidway(isRunEnd ? Infinity : columns.boardTicks);
    }
    this.waitForRunEnd(run);
  }

  /** Writes the pen moves due by `tick`. */
  private writeMidway(tick: number): void {
    while (this.midwayTick() <= tick) {
      const [next, ...later] = this.midway;
      if (!next) return;
      this.midway = later;
      next.write(this.walk.planS(this.columns.boardTicks));
    }
  }

  private midwayTick(): number {
    const next = this.midway[0];
    return next ? this.walk.tickOf(next.atS) : Infinity;
  }

  /** Waits if a run's last step comes before its planned end. So a run takes the planned time on every firmware. */
  private waitForRunEnd(run: number): void {
    const { walk, columns } = this;
    const ms = Math.round((walk.endTick(walk.end - 1) - columns.boardTicks) / TICKS_PER_MS);
    if (ms < 1) return;
    columns.add(`SM,${ms},0,0`, ms * TICKS_PER_MS, walk.planS(columns.boardTicks), run);
  }

  /** The next cut after `tick`, which is in `block`. The cut is not before `notBefore`. */
  private nextCut(tick: number, block: number, notBefore: number): Cut {
    const { walk, writer } = this;
    const last = walk.end - 1;
    const runEnd = Math.max(walk.endTick(last), tick + 1);
    const shortest = Math.max(tick + writer.minTicks, notBefore);
    let soonest = shortest;
    let k = walk.blockTo(soonest, block);
    if (k !== block && this.trajectory.planned) {
      // Room for two commands: short blocks of a shaped motion seldom fit one acceleration.
      soonest = Math.max(shortest, tick + 2 * writer.minTicks);
      k = walk.blockTo(soonest, k);
    }
    let end = k === last ? runEnd : walk.endTick(k);
    if (k === block) {
      end = this.withinBlock(tick, block, soonest, end);
    } else if (end - soonest >= writer.minTicks) {
      // Short blocks are combined. Take no more of a following long block than needed.
      end = soonest;
    }
    const midwayTick = this.midwayTick();
    if (midwayTick < end) end = Math.max(soonest, midwayTick);
    if (writer.turnTicks > 0) {
      const earliest = Math.max(tick + this.turnTicks, shortest - writer.minTicks);
      let turn = this.turnBetween(earliest, end - this.turnTicks, block);
      if (turn === Infinity) turn = this.turnNear(end, block, soonest, runEnd);
      if (turn !== Infinity) end = turn;
    }
    // The rest of the run must be long enough for a command, plus a tick for each pen move.
    const restTicks = writer.minTicks + this.midway.length;
    if (end < runEnd && runEnd - end < restTicks) {
      const earlier = runEnd - restTicks;
      end = earlier >= soonest ? earlier : runEnd;
    }
    const isRunEnd = end >= runEnd;
    return { tick: end, block: isRunEnd ? last : walk.blockTo(end, block), isRunEnd };
  }

  /** Where to cut a block that is long enough for a command but may be too long for one. */
  private withinBlock(tick: number, block: number, soonest: number, blockEnd: number): number {
    const { walk, writer } = this;
    // A constant acceleration misses the end speeds of T ticks of jerk J by J T²/12.
    const jerkTicks = Math.floor(Math.sqrt((12 * writer.jerkErrorRate) / walk.jerk(block)));
    const longest = Math.max(Math.min(MAX_TICKS, Math.max(writer.minTicks, jerkTicks)), soonest - tick);
    const pieces = Math.ceil((blockEnd - tick) / longest);
    return pieces > 1 ? Math.max(soonest, tick + Math.round((blockEnd - tick) / pieces)) : blockEnd;
  }

  /**
   * The tick near the cut at which a motor of a shaped motion reverses; Infinity if none does. The cut then moves there.
   * Shaped motion has short blocks of high acceleration: a separate command would be too short for the board, and
   * without any cut the motor would jump.
   */
  private turnNear(end: number, block: number, soonest: number, runEnd: number): number {
    const { minTicks } = this.writer;
    if (!this.trajectory.planned) return Infinity;
    const from = Math.max(soonest - 1, end - this.turnTicks);
    const turn = this.turnBetween(from, Math.min(end + minTicks, runEnd - minTicks), block);
    // A long leg that takes in the beginning of the next block leaves the line. So a short leg leads to the turn.
    return turn > end && turn - soonest >= 5 * minTicks ? turn - minTicks : turn;
  }

  /** The first tick in (from, to] at which a motor reverses; Infinity if none does. Searched from `block` on. */
  private turnBetween(from: number, to: number, block: number): number {
    const { walk } = this;
    let since = from;
    for (let k = walk.blockAt(from, block); k < walk.end && since < to; k++) {
      const until = Math.min(to, walk.endTick(k));
      const turn = walk.turnTick(k, since, until);
      if (turn !== Infinity) return turn;
      since = until;
    }
    return Infinity;
  }

  /**
   * If a motor reverses too close to a leg's end for a separate leg, it is driven without reversing. On a long leg that
   * takes it off the line by a quarter of its reverse speed times the leg's duration. If that is too far, the reversal
   * gets the shortest possible leg. Returns the earlier cut, or null if `cut` is good.
   */
  private cutForTurn(leg: Leg, cut: Cut, tick: number, block: number, notBefore: number): Cut | null {
    const { walk, writer } = this;
    if (writer.turnTicks === 0) return null;
    const { ticks, m1, m2 } = leg;
    const motor = reverseTravel(m1) > reverseTravel(m2) ? m1 : m2;
    if (reverseTravel(motor) * ticks <= 4 * MAX_DEVIATION_RATE || ticks < 2 * writer.minTicks) return null;
    const soonest = Math.max(tick + writer.minTicks, notBefore);
    const isAtStart = Math.abs(motor.v0) < Math.abs(motor.v1);
    const end = isAtStart ? soonest : Math.max(soonest, cut.tick - writer.minTicks);
    if (end >= cut.tick) return null;
    return { tick: end, block: walk.blockTo(end, block), isRunEnd: false };
  }

  /** The leg from `tick`, which is in `block`, to a cut, as planned. */
  private legTo(cut: Cut, tick: number, block: number): Leg {
    const { walk } = this;
    const start = walk.pointAt(tick, block);
    const end = cut.isRunEnd ? walk.endOf(cut.block) : walk.pointAt(cut.tick, cut.block);
    return {
      ticks: cut.tick - tick,
      m1: legBetween(start.m1, end.m1),
      m2: legBetween(start.m2, end.m2),
      isParabola: block === cut.block && walk.jerk(block) === 0,
      isLast: cut.isRunEnd && this.runIndex === this.trajectory.runs.count - 1,
    };
  }

  /**
   * Gives the leg more time if a motor would have to step too fast, or if the end of the run is too short for a command.
   * Delays the rest of the plan by that time.
   */
  private slowedDown(leg: Leg, isRunEnd: boolean): Leg {
    const peak = Math.max(peakRate(leg.m1, leg.ticks), peakRate(leg.m2, leg.ticks));
    // Higher speed makes up for an idle tick. If that increase could be visible, the leg takes longer instead.
    const idle = peak > MAX_MAKE_UP_RATE * leg.ticks ? this.writer.idleTicks : 0;
    const ticks = Math.max(
      leg.ticks + idle,
      Math.ceil((leg.ticks * peak) / HIGHEST_PLANNED_RATE),
      isRunEnd ? SHORTEST_TICKS : 1,
    );
    if (ticks <= leg.ticks) return leg;
    if (peak > HIGHEST_PLANNED_RATE) this.columns.warnOnce(TOO_FAST);
    this.walk.origin += ticks - leg.ticks;
    const part = leg.ticks / ticks;
    const slower = (motor: MotorLeg): MotorLeg => ({ ...motor, v0: motor.v0 * part, v1: motor.v1 * part });
    return { ...leg, ticks, m1: slower(leg.m1), m2: slower(leg.m2) };
  }

  /**
   * Writes a leg as one command, or as two if one acceleration cannot join the speeds.
   * Returns false if nothing was written, because no step is due.
   */
  private writeLeg(leg: Leg): boolean {
    const { jerkErrorRate, turnTicks } = this.writer;
    const isOneCommand = jerkErrorRate === Infinity || leg.isParabola || leg.ticks < 2 * turnTicks;
    if (isOneCommand || !(isBent(leg.m1, leg.ticks) || isBent(leg.m2, leg.ticks))) {
      return this.writeCommand(leg);
    }
    const ticks = Math.floor(leg.ticks / 2);
    const m1 = firstHalf(leg.m1, leg.ticks, ticks);
    const m2 = firstHalf(leg.m2, leg.ticks, ticks);
    if (!this.writeCommand({ ticks, m1, m2, isParabola: true, isLast: false })) return this.writeCommand(leg);
    this.writeCommand({
      ...leg,
      ticks: leg.ticks - ticks,
      m1: { ...leg.m1, p0: m1.p1, v0: m1.v1 },
      m2: { ...leg.m2, p0: m2.p1, v0: m2.v1 },
    });
    return true;
  }

  private writeCommand(leg: Leg): boolean {
    const { columns } = this;
    const command = this.writer.commandFor(leg, columns.m1, columns.m2);
    if (!command) return false;
    columns.add(command.line, command.ticks, this.walk.planS(columns.boardTicks), this.runIndex);
    return true;
  }
}

const legBetween = (start: MotorPoint, end: MotorPoint): MotorLeg => ({
  p0: start.p,
  p1: end.p,
  v0: start.v,
  v1: end.v,
});

const peakRate = (motor: MotorLeg, ticks: number): number =>
  Math.max(Math.abs(motor.v0), Math.abs(motor.v1), Math.abs(meanRate(motor, ticks)));

const meanRate = ({ p0, p1 }: MotorLeg, ticks: number): number => ((p1 - p0) / ticks) * ACCUMULATOR_RANGE;

/** The smaller of the end speeds if they have opposite signs, otherwise 0. */
const reverseTravel = ({ v0, v1 }: MotorLeg): number =>
  v0 * v1 < 0 ? Math.min(Math.abs(v0), Math.abs(v1)) : 0;

/** True if one acceleration from v0 to v1 would miss the leg's distance. */
const isBent = (motor: MotorLeg, ticks: number): boolean =>
  Math.abs((motor.v0 + motor.v1) / 2 - meanRate(motor, ticks)) > JOIN_RATE;

/**
 * The first of two accelerations, each over half of the time T, that lead from p0, v0 to p1, v1:
 * a₁ + a₂ = 2 Δv/T and 3 a₁ + a₂ = 8 (Δp − v₀ T)/T².
 */
function firstHalf(motor: MotorLeg, ticks: number, half: number): MotorLeg {
  const v0 = motor.v0 / ACCUMULATOR_RANGE;
  const v1 = motor.v1 / ACCUMULATOR_RANGE;
  const mean = (motor.p1 - motor.p0 - v0 * ticks) / (ticks * ticks);
  const accel = 4 * mean - (v1 - v0) / ticks;
  return {
    p0: motor.p0,
    p1: motor.p0 + v0 * half + (accel * half * half) / 2,
    v0: motor.v0,
    v1: (v0 + accel * half) * ACCUMULATOR_RANGE,
  };
}
