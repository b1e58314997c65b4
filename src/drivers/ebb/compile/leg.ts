/**
 * A leg: the part of a run that one command executes, in motor units.
 *
 * Positions in steps (fractional), speeds in accumulator counts per tick. The board may be a fraction of a
 * step off at the start of a leg. The command leads from the actual position to the planned one.
 */
import { ACCUMULATOR_RANGE, TICKS_PER_S } from "../../../units.js";

export interface MotorLeg {
  /** The plan's position at the start and the end. */
  readonly p0: number;
  readonly p1: number;
  /** The plan's speed at the start and the end, measured inside the leg. */
  readonly v0: number;
  readonly v1: number;
}

export interface Leg {
  /** Board ticks from this command's start to the next one's. */
  readonly ticks: number;
  readonly m1: MotorLeg;
  readonly m2: MotorLeg;
  /** The plan's acceleration is constant over the leg. */
  readonly isParabola: boolean;
  /** The trajectory ends with this leg: any remaining error must be corrected now. */
  readonly isLast: boolean;
}

/** Max ticks of a command: 150 ms. */
export const MAX_TICKS = 3_750;

/** Max rate in a command. The board's own limit is one step per tick. */
export const HIGHEST_RATE = Math.floor(0.999 * ACCUMULATOR_RANGE);

export const TOO_FAST =
  "Parts of the plot are faster than the motors can step (25 000 steps per second). They are plotted at the board's maximum speed.";

/** Predicted state of one motor. */
export interface MotorState {
  steps: number;
  acc: number;
}

/** A pen move to be written during a run. */
export interface PenEvent {
  /** Trajectory seconds. */
  readonly atS: number;
  /** `planS`: the plan time at which it is written, at most a few ms after `atS`. */
  write(planS: number): void;
}

/**
 * Writes the commands for one run of the trajectory, from the motors' current positions to its end. `fromS`: the motors
 * have moved up to this time of the trajectory, which may be within the run; undefined: the whole run is written. Each pen move in
 * `midway` is written at the first end of a command at or after its time.
 */
export interface RunCommandWriter {
  write(run: number, fromS: number | undefined, midway: readonly PenEvent[]): void;
}

/** A command, and the board ticks from its start to the next one's. */
export interface LegCommand {
  readonly line: string;
  readonly ticks: number;
}

/** Makes the command for a leg, and updates the motors' predicted states exactly. */
export interface LegWriter {
  /** Min ticks of a command. */
  readonly minTicks: number;
  /**
   * A motor must not reverse within a leg. A reversal within this many ticks of the leg's start or end is tolerated,
   * because the motor moves only a few µm in that time. 0: motors may reverse anywhere.
   */
  readonly turnTicks: number;
  /** Idle ticks of every command, in which the motors rest. The other ticks run faster to make up for them. */
  readonly idleTicks: number;
  /**
   * Max speed error at a leg's ends from replacing a jerk by a constant acceleration, counts per tick. Infinity: the
   * command has a jerk, so it can join any two speeds.
   */
  readonly jerkErrorRate: number;
  /** Returns null if no motor has to move yet. */
  commandFor(leg: Leg, m1: MotorState, m2: MotorState): LegCommand | null;
}

/** How much of the position error to correct in one command of `ticks` ticks, in steps. */
export function correction(errorSteps: number, ticks: number, isLast: boolean): number {
  if (isLast) return errorSteps;
  const limit = MAX_CORRECTION_STEPS_PER_TICK * ticks;
  return Math.max(-limit, Math.min(limit, errorSteps));
}

/** 12 steps/s: 0.15 mm/s at 80 steps/mm, too little to affect the line visibly. */
const MAX_CORRECTION_STEPS_PER_TICK = 12 / TICKS_PER_S;
