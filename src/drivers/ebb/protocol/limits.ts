/** The board's speed limits, and the warnings of the compiler. */
import { ACCUMULATOR_RANGE } from "../../../units.js";

/** Max rate in a command. The board's own limit is one step per tick. */
export const HIGHEST_RATE = Math.floor(0.999 * ACCUMULATOR_RANGE);
/** Plans are slowed down to this rate, to leave room for corrections of fractions of a step. */
export const HIGHEST_PLANNED_RATE = Math.floor(0.985 * ACCUMULATOR_RANGE);
/** Min rate of a step-limited motor, as a part of the leg's mean rate. */
export const SLOWEST_PART_OF_MEAN = 0.01;
/** Max planned rate of slices: lower, because a slice has whole milliseconds, whole steps and an idle tick. */
export const HIGHEST_SLICE_RATE = Math.floor(0.95 * ACCUMULATOR_RANGE);

export const TOO_FAST =
  "Parts of the plot are faster than the motors can step (25 000 steps per second). They are plotted at the board's maximum speed.";

export const OLD_FIRMWARE =
  "This board's firmware is older than 2.5.3 and cannot accelerate within a command, so lines may be slightly uneven. Update the firmware.";
