/**
 * The quality setting: it sets speed, acceleration and corner rounding together, from the machine's measured swing.
 *
 * A shaped carriage leaves the line by up to A/32f². If the measured frequency is slightly wrong, a share of that
 * appears on paper. So on machines below 10 Hz A is reduced in proportion to f². Above 10 Hz the motors limit A.
 */
import { PlotwrightError } from "../errors.js";
import {
  DEFAULT_MOTION,
  DRAW_TABLE,
  type MotionSettings,
  QUALITIES,
  type Quality,
} from "../settings/motion.js";
import type { Springs } from "../machines/profile.js";
import { defaultsOf } from "../settings/setting.js";

/** Speeds in mm/s, accelerations of machines of 10 Hz and more in mm/s², corner deviation in mm. */
const STEPS = {
  fine: { speed: 60, accel: 1_000, corner: 0.007, travelSpeed: 180, travelAccel: 2_000 },
  normal: { speed: 70, accel: 1_300, corner: 0.016, travelSpeed: 200, travelAccel: 2_200 },
  fast: { speed: 85, accel: 1_750, corner: 0.022, travelSpeed: 220, travelAccel: 2_500 },
} as const satisfies Record<Quality, object>;

/** From this frequency on the full acceleration is used, Hz. */
const STIFF_HZ = 10;

/** The settings that a quality sets. */
export type QualityMotion = Pick<MotionSettings, "shaper" | "draw" | "travel">;

/** @throws PlotwrightError "bad-setting" for fine or fast on a machine that was not measured */
export function motionOfQuality(quality: Quality, springs: Springs | null): QualityMotion {
  if (springs === null) {
    if (quality === "normal")
      return { shaper: "none", draw: DEFAULT_MOTION.draw, travel: DEFAULT_MOTION.travel };
    throw new PlotwrightError(
      "bad-setting",
      `Quality ${quality} needs the measured swing of the machine: plot the ringing sheet and count its ripples, which takes a few minutes.`,
    );
  }
  const { speed, accel, corner, travelSpeed, travelAccel } = STEPS[quality];
  const share = Math.min(1, Math.min(springs.xHz, springs.yHz) / STIFF_HZ) ** 2;
  return {
    shaper: "zv",
    draw: {
      ...defaultsOf(DRAW_TABLE),
      speedMmPerS: speed,
      accelMmPerS2: Math.round(accel * share),
      cornerMm: corner,
    },
    travel: {
      ...DEFAULT_MOTION.travel,
      speedMmPerS: travelSpeed,
      accelMmPerS2: Math.round(travelAccel * share),
    },
  };
}

/** The quality that gives these settings; null if the user changed them. */
export function qualityOf({ shaper, draw, travel }: MotionSettings, springs: Springs | null): Quality | null {
  const isSame = (quality: Quality): boolean => {
    if (springs === null && quality !== "normal") return false;
    const step = motionOfQuality(quality, springs);
    return (
      step.shaper === (shaper ?? "none") &&
      step.draw.speedMmPerS === draw.speedMmPerS &&
      step.draw.accelMmPerS2 === draw.accelMmPerS2 &&
      step.draw.cornerMm === draw.cornerMm &&
      step.travel.speedMmPerS === travel.speedMmPerS &&
      step.travel.accelMmPerS2 === travel.accelMmPerS2
    );
  };
  return QUALITIES.find(isSame) ?? null;
}

/**
 * The motion with a quality's settings.
 *
 * @throws PlotwrightError "bad-setting" for fine or fast on a machine that was not measured
 */
export const withQuality = (
  motion: MotionSettings,
  quality: Quality,
  springs: Springs | null,
): MotionSettings => {
  const step = motionOfQuality(quality, springs);
  // A motion has only one filter: the shaper excludes scurve.
  const mode = step.shaper !== "none" && motion.mode === "scurve" ? "blend" : motion.mode;
  return { ...motion, ...step, mode };
};

/** The same quality for another machine, or for one that was measured since. Custom numbers stay. */
export const motionForSprings = (
  motion: MotionSettings,
  before: Springs | null,
  now: Springs | null,
): MotionSettings => {
  if (isSame(before, now)) return withoutShaperIfUnmeasured(motion, now);
  const quality = qualityOf(motion, before);
  if (quality === null) return withoutShaperIfUnmeasured(motion, now);
  return withQuality(motion, now === null ? "normal" : quality, now);
};

/** Shaping needs a measured machine. */
export const withoutShaperIfUnmeasured = (motion: MotionSettings, springs: Springs | null): MotionSettings =>
  springs === null && (motion.shaper ?? "none") !== "none" ? { ...motion, shaper: "none" } : motion;

const isSame = (a: Springs | null, b: Springs | null): boolean =>
  a?.xHz === b?.xHz && a?.yHz === b?.yHz && a?.damping === b?.damping;
