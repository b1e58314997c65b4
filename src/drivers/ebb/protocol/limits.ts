/** What the board can do at most, and how closely the compiler holds to the plan. */
import { ACCUMULATOR_RANGE } from "../../../units.js";

/** One step a tick is the board's limit: no rate is written above this. */
export const HIGHEST_RATE = Math.floor(0.999 * ACCUMULATOR_RANGE);
/** A plan is slowed to this, which leaves room to make good a fraction of a step on the way. */
export const HIGHEST_PLANNED_RATE = Math.floor(0.985 * ACCUMULATOR_RANGE);
/** Counts a tick that a step-limited or slow motor is kept from falling below: 1 % of a leg's mean. */
export const SLOWEST_PART_OF_MEAN = 0.01;
/** The same in slices of whole milliseconds, of which every one has an idle tick and counts whole steps. */
export const HIGHEST_SLICE_RATE = Math.floor(0.95 * ACCUMULATOR_RANGE);

export const TOO_FAST =
  "The plan is faster than the motors can step (25 000 steps a second): those parts are plotted as fast as the board can.";

export const OLD_FIRMWARE =
  "This board's firmware is older than 2.5.3 and cannot speed up within a command: lines come out a little uneven. Update the firmware.";
