/** Labels of the settings that Grbl ignores, by path: Grbl plans its motion by itself, and moves the pen only at rest. */
import {
  AXIS_TABLE,
  DRAW_TABLE,
  FIT_TABLE,
  MOTION_TABLE,
  MOTOR_ACCEL,
  TRAVEL_TABLE,
} from "../../settings/motion.js";
import { STREAM_TABLE } from "../../settings/machine.js";
import { DROP_RATE, LIFT_RATE, OVERLAP_TABLE } from "../../settings/pen.js";

export const UNUSED_SETTINGS: Readonly<Record<string, string>> = {
  "motion.mode": MOTION_TABLE.mode.label,
  "motion.shaper": MOTION_TABLE.shaper.label,
  "motion.draw.accelMmPerS2": `${DRAW_TABLE.accelMmPerS2.label} (pen down)`,
  "motion.draw.cornerMm": `${DRAW_TABLE.cornerMm.label} (pen down)`,
  "motion.draw.jerkMmPerS3": `${DRAW_TABLE.jerkMmPerS3.label} (pen down)`,
  "motion.travel.accelMmPerS2": `${TRAVEL_TABLE.accelMmPerS2.label} (pen up)`,
  "motion.travel.cornerMm": `${TRAVEL_TABLE.cornerMm.label} (pen up)`,
  "motion.travel.jerkMmPerS3": `${TRAVEL_TABLE.jerkMmPerS3.label} (pen up)`,
  "motion.layers.*.accelMmPerS2": `${DRAW_TABLE.accelMmPerS2.label} of a layer`,
  "motion.layers.*.cornerMm": `${DRAW_TABLE.cornerMm.label} of a layer`,
  "motion.layers.*.jerkMmPerS3": `${DRAW_TABLE.jerkMmPerS3.label} of a layer`,
  "motion.fit.toleranceMm": `${FIT_TABLE.toleranceMm.label} of merged commands`,
  "motion.accelXMmPerS2": AXIS_TABLE.accelXMmPerS2.label,
  "motion.accelYMmPerS2": AXIS_TABLE.accelYMmPerS2.label,
  "motion.motorAccelStepsPerS2": MOTOR_ACCEL.label,
  "pen.liftPctPerS": LIFT_RATE.label,
  "pen.dropPctPerS": DROP_RATE.label,
  "pen.overlap": OVERLAP_TABLE.overlap.label,
  "pen.contactPct": OVERLAP_TABLE.contactPct.label,
  "pen.fullHeightMm": OVERLAP_TABLE.fullHeightMm.label,
  sendAheadMs: STREAM_TABLE.sendAheadMs.label,
};
