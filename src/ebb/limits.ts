/** What the board can do at most, and how closely the compiler holds to the plan. */
import { ACCUMULATOR_RANGE } from "../units.js";

/** One step a tick is the hard limit; the plan is slowed to this part of it. */
export const HIGHEST_RATE = Math.floor(0.998 * ACCUMULATOR_RANGE);
/** Counts a tick that a step-limited or slow motor is kept from falling below: 1 % of a leg's mean. */
export const SLOWEST_PART_OF_MEAN = 0.01;
