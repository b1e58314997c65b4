/**
 * A leg: the piece of a run that one command shall carry, in motor terms.
 *
 * Places in steps (not whole), speeds in accumulator counts a tick. The board is free to be a fraction of a step
 * off at the start of a leg; the command is aimed from where it truly is at where it should be.
 */
export interface MotorLeg {
  /** Where the plan is at the start and the end. */
  p0: number;
  p1: number;
  /** The plan's speed there, seen from inside the leg. */
  v0: number;
  v1: number;
}

export interface Leg {
  /** Board ticks from this command's start to the next one's. */
  ticks: number;
  readonly m1: MotorLeg;
  readonly m2: MotorLeg;
  /** The plan's acceleration is constant from end to end. */
  isParabola: boolean;
  /** The trajectory ends with it: what is off has to be made good now. */
  isLast: boolean;
}

/** One motor as the host knows it. */
export interface MotorPlace {
  steps: number;
  acc: number;
}

/** Writes the commands for one run of the trajectory, from where the motors stand to its end. */
export interface RunWriter {
  write(run: number): void;
}

/** Writes the command for a leg, and moves `motors` on bit for bit. */
export interface LegWriter {
  /** Ticks that a command needs at least. */
  readonly minTicks: number;
  readonly maxTicks: number;
  /**
   * A motor must not turn back within a leg; but a turning point so near to one end of it, where the motor
   * moves a few µm, is not worth a command. 0: motors may turn as they like.
   */
  readonly turnTicks: number;
  /** Ticks of every command in which the motors stand, and for which the rest of it runs faster. */
  readonly idleTicks: number;
  /** One command can join any two speeds (it has a jerk). */
  readonly joinsAnySpeeds: boolean;
  /** Longest leg of a plan with this jerk (counts a tick³ of the faster motor); Infinity for none. */
  maxTicksForJerk(jerk: number): number;
  /** Ticks that it takes (normally `leg.ticks`); 0 when no motor has anything to do yet and nothing was written. */
  write(leg: Leg, m1: MotorPlace, m2: MotorPlace): number;
}

export const newLeg = (): Leg => ({
  ticks: 0,
  m1: { p0: 0, p1: 0, v0: 0, v1: 0 },
  m2: { p0: 0, p1: 0, v0: 0, v1: 0 },
  isParabola: true,
  isLast: false,
});

/** How far (in steps) the board may be led back towards the plan in one command of so many ticks. */
export function correction(errorSteps: number, ticks: number, isLast: boolean): number {
  if (isLast) return errorSteps;
  const limit = MAX_CORRECTION_STEPS_PER_TICK * ticks;
  return Math.max(-limit, Math.min(limit, errorSteps));
}

/** 12 steps/s: 0.15 mm/s at 80 steps/mm, too little to be seen in the line's speed. */
const MAX_CORRECTION_STEPS_PER_TICK = 12 / 25_000;
