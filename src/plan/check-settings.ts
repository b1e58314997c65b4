/** Refuses motion and pen settings from which no sensible plan can be made. */
import { PlotwrightError } from "../errors.js";
import { drawLimitsOf } from "./limits.js";
import { penOfLayer } from "./pen-times.js";
import {
  MOTION_MODES,
  type HopSettings,
  type MotionLimits,
  type MotionSettings,
  type PenSettings,
} from "./settings.js";

/** @throws PlotwrightError "bad-setting", naming the setting, its value and what is allowed */
export function checkSettings(motion: MotionSettings, pen: PenSettings): void {
  if (!MOTION_MODES.includes(motion.mode)) {
    throw bad(`motion mode is "${String(motion.mode)}": choose one of ${MOTION_MODES.join(", ")}`);
  }
  checkLimits("draw", motion.draw);
  checkLimits("travel", motion.travel);
  for (const layer of Object.keys(motion.layers ?? {})) {
    checkLimits(`layer "${layer}" draw`, drawLimitsOf(motion, layer));
  }
  if (motion.fit) {
    positive("fit tolerance", motion.fit.toleranceMm, "mm");
    within("fit floor", motion.fit.floorMs, 200, "ms");
  }
  if (motion.ease) {
    positive("slow-in length", motion.ease.lengthMm, "mm");
    positive("slow-in speed", motion.ease.speedMmPerS, "mm/s");
  }
  if (motion.motorAccelStepsPerS2 !== undefined && motion.motorAccelStepsPerS2 !== null) {
    positive("motor acceleration", motion.motorAccelStepsPerS2, "steps/s²");
  }
  checkPen("pen", pen);
  for (const [layer, { beforeMs }] of Object.entries(pen.layers ?? {})) {
    checkPen(`layer "${layer}" pen`, penOfLayer(pen, layer));
    if (beforeMs !== undefined) within(`layer "${layer}" wait before it`, beforeMs, 60_000, "ms");
  }
}

function checkLimits(name: string, limits: MotionLimits): void {
  positive(`${name} speed`, limits.speedMmPerS, "mm/s");
  positive(`${name} acceleration`, limits.accelMmPerS2, "mm/s²");
  positive(`${name} corner deviation`, limits.cornerMm, "mm");
  positive(`${name} jerk`, limits.jerkMmPerS3, "mm/s³");
}

function checkPen(name: string, pen: PenSettings): void {
  within(`${name} up height`, pen.upPct, 100, "%");
  within(`${name} down height`, pen.downPct, 100, "%");
  within(`${name} lift time`, pen.liftMs, 60_000, "ms");
  within(`${name} drop time`, pen.dropMs, 60_000, "ms");
  if (pen.upPct <= pen.downPct) {
    throw bad(
      `${name} up height ${pen.upPct} % is not above its down height ${pen.downPct} %: ` +
        "the pen would never leave the paper; raise the one or lower the other",
    );
  }
  if (pen.liftPctPerS !== undefined && pen.liftPctPerS !== null) {
    positive(`${name} lift rate`, pen.liftPctPerS, "%/s");
  }
  if (pen.dropPctPerS !== undefined && pen.dropPctPerS !== null) {
    positive(`${name} drop rate`, pen.dropPctPerS, "%/s");
  }
  if (pen.clearPct !== undefined) within(`${name} clear share`, pen.clearPct, 100, "%");
  if (pen.hop) checkHop(name, pen.hop, pen.downPct);
}

function checkHop(name: string, hop: HopSettings, downPct: number): void {
  positive(`${name} hop length`, hop.longestMm, "mm");
  within(`${name} hop height`, hop.upPct, 100, "%");
  if (hop.upPct <= downPct) {
    throw bad(`${name} hop height ${hop.upPct} % is not above its down height ${downPct} %: raise it`);
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
