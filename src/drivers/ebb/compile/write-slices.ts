/**
 * Writes runs for firmware before 2.5.3, which has no ramps: SM at constant speed, in slices of about 10 ms.
 *
 * SM takes whole milliseconds and whole steps and computes the rate itself, rounded down. Each slice leads to
 * the step nearest to the plan at the slice's end, so rounding never adds up. The exact duration of a slice
 * in ticks is known, and the next slice compensates for it.
 */
import { ACCUMULATOR_RANGE, TICKS_PER_MS } from "../../../units.js";
import { slowRate } from "../model/slow-rate.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { TOO_FAST, type PenEvent, type MotorState, type RunCommandWriter } from "./leg.js";
import type { RunWalk } from "./run-walk.js";
import type { StreamColumns } from "./stream-columns.js";

/**
 * The board reads a command in 4 to 7 ms (firmware before 2.7; EBB command reference, "Performance"). Shorter slices
 * would cause pauses, longer ones larger jumps of speed.
 */
const SLICE_MS = 10;
const SLICE_TICKS = SLICE_MS * TICKS_PER_MS;

/**
 * Max planned rate: lower than that of the other commands, because a slice has whole milliseconds, whole steps and an
 * idle tick.
 */
const HIGHEST_SLICE_RATE = Math.floor(0.95 * ACCUMULATOR_RANGE);
/** Max steps per millisecond of one motor. */
const MAX_STEPS_PER_MS = (HIGHEST_SLICE_RATE / ACCUMULATOR_RANGE) * TICKS_PER_MS;

const OLD_FIRMWARE =
  "This board's firmware is older than 2.5.3 and cannot accelerate within a command, so lines may be slightly uneven. Update the firmware.";

export class SliceRuns implements RunCommandWriter {
  /** Ticks by which the last run ended later than planned. */
  private lateTicks = 0;

  constructor(
    private readonly features: FirmwareFeatures,
    private readonly walk: RunWalk,
    private readonly columns: StreamColumns,
  ) {}

  write(run: number, fromS: number | undefined, midway: readonly PenEvent[]): void {
    const { walk, columns, features } = this;
    walk.begin(run, columns.boardTicks - this.lateTicks, fromS);
    if (walk.first === walk.end) return;
    columns.warnOnce(OLD_FIRMWARE);
    const last = walk.end - 1;
    let block = walk.first;
    let isLast = false;
    let written = 0;
    const writeMidway = (tick: number): void => {
      while (written < midway.length && walk.tickOf(midway[written].atS) <= tick)
        midway[written++].write(walk.planS(columns.boardTicks));
    };
    while (!isLast) {
      writeMidway(columns.boardTicks);
      const leftTicks = walk.endTick(last) - columns.boardTicks;
      isLast = leftTicks < 1.5 * SLICE_TICKS;
      const ms = isLast ? Math.max(0, Math.round((leftTicks - features.idleTicks) / TICKS_PER_MS)) : SLICE_MS;
      // The target is the plan's position at the slice's real end. So rounding to whole milliseconds causes no speed
      // error, except in the last slice.
      const tick = columns.boardTicks + ms * TICKS_PER_MS + features.idleTicks;
      block = isLast ? last : walk.blockAt(tick, block);
      const target = isLast ? walk.endOf(block) : walk.pointAt(tick, block);
      const steps1 = Math.round(target.m1.p) - columns.m1.steps;
      const steps2 = Math.round(target.m2.p) - columns.m2.steps;
      const minMs = Math.ceil(Math.max(Math.abs(steps1), Math.abs(steps2)) / MAX_STEPS_PER_MS);
      if (minMs > ms) walk.origin += (minMs - ms) * TICKS_PER_MS;
      if (minMs > ms + 1) columns.warnOnce(TOO_FAST);
      this.writeSlice(Math.max(minMs, ms), steps1, steps2, run);
    }
    writeMidway(Infinity);
    this.lateTicks = columns.boardTicks - walk.endTick(last);
  }

  private writeSlice(ms: number, steps1: number, steps2: number, run: number): void {
    if (ms === 0) return;
    const { columns, features } = this;
    const stepping = Math.max(this.step(columns.m1, ms, steps1), this.step(columns.m2, ms, steps2));
    // An SM without steps is a plain delay and has no idle tick.
    const ticks = stepping > 0 ? stepping + features.idleTicks : ms * TICKS_PER_MS;
    columns.add(`SM,${ms},${steps1},${steps2}`, ticks, this.walk.planS(columns.boardTicks), run);
  }

  /** Updates one motor's state. Returns the ticks until its last step. */
  private step(motor: MotorState, ms: number, steps: number): number {
    if (steps === 0) return 0;
    const rate = slowRate(this.features.arithmetic, ms, Math.abs(steps));
    const counts = Math.abs(steps) * ACCUMULATOR_RANGE - motor.acc;
    const ticks = Math.ceil(counts / rate);
    motor.steps += steps;
    motor.acc = ticks * rate - counts;
    return ticks;
  }
}
