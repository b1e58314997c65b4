/** Refuses motion and pen settings from which no sensible plan can be made. */
import { PlotwrightError } from "../errors.js";
import { MOTION_MODES, type MotionLimits, type MotionSettings, type PenSettings } from "./settings.js";

/** @throws PlotwrightError "bad-setting", naming the setting, its value and what is allowed */
export function checkSettings(motion: MotionSettings, pen: PenSettings): void {
  if (!MOTION_MODES.includes(motion.mode)) {
    throw bad(`motion mode is "${String(motion.mode)}": choose one of ${MOTION_MODES.join(", ")}`);
  }
  checkLimits("draw", motion.draw);
  checkLimits("travel", motion.travel);
  checkPen(pen);
}

function checkLimits(name: string, limits: MotionLimits): void {
  positive(`${name} speed`, limits.speedMmPerS, "mm/s");
  positive(`${name} acceleration`, limits.accelMmPerS2, "mm/s²");
  positive(`${name} corner deviation`, limits.cornerMm, "mm");
  positive(`${name} jerk`, limits.jerkMmPerS3, "mm/s³");
}

function checkPen(pen: PenSettings): void {
  within("pen up height", pen.upPct, 100, "%");
  within("pen down height", pen.downPct, 100, "%");
  within("pen lift time", pen.liftMs, 60_000, "ms");
  within("pen drop time", pen.dropMs, 60_000, "ms");
  if (pen.upPct <= pen.downPct) {
    throw bad(
      `pen up height ${pen.upPct} % is not above pen down height ${pen.downPct} %: ` +
        "the pen would never leave the paper; raise the one or lower the other",
    );
  }
}

function positive(name: string, value: number, unit: string): void {
  if (!(value > 0 && value < Infinity)) throw bad(`${name} is ${value} ${unit}: it must be above 0`);
}

function within(name: string, value: number, max: number, unit: string): void {
  if (!(value >= 0 && value <= max)) throw bad(`${name} is ${value} ${unit}: it must be 0 to ${max}`);
}

function bad(message: string): PlotwrightError {
  return new PlotwrightError("bad-setting", message);
}
