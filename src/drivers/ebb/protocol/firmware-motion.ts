/** What a firmware asks of the plan itself, before there are commands. */
import type { LayerMotion, MotionLimits, MotionSettings } from "../../../settings/motion.js";
import { firmwareFeatures } from "./firmware.js";

/**
 * mm/s². A slice of constant speed is at least 5 ms long, so that speed comes in stairs of A · 5 ms, to which whole
 * steps add up to 2 mm/s: from here on stairs of over 5 mm/s can't be helped.
 */
const SLICED_ACCEL_MM_PER_S2 = 500;

/** True for firmware that `motionForFirmware` slows; null: not known. Throws `bad-setting` for what is no version. */
export const firmwareLimitsMotion = (firmware: string | null): boolean =>
  firmware !== null && firmwareFeatures(firmware).motion === "slices";

/**
 * The settings as this firmware can follow them smoothly: before 2.5.3, which knows constant speeds only, no
 * acceleration is over 500 mm/s². Doing it twice changes nothing; newer firmware, and one that is not known (null), gets the
 * settings as they are.
 *
 * Throws `bad-setting` for what is no version.
 */
export function motionForFirmware(motion: MotionSettings, firmware: string | null): MotionSettings {
  if (!firmwareLimitsMotion(firmware)) return motion;
  const { draw, travel, layers } = motion;
  return {
    ...motion,
    draw: gentler(draw),
    travel: gentler(travel),
    ...(layers === undefined ? {} : { layers: gentlerLayers(layers) }),
  };
}

const gentler = (limits: MotionLimits): MotionLimits => ({
  ...limits,
  accelMmPerS2: Math.min(limits.accelMmPerS2, SLICED_ACCEL_MM_PER_S2),
});

const gentlerLayers = (layers: Readonly<Record<string, LayerMotion>>): Record<string, LayerMotion> =>
  Object.fromEntries(
    Object.entries(layers).map(([id, { accelMmPerS2, ...others }]) => [
      id,
      accelMmPerS2 === undefined
        ? others
        : { ...others, accelMmPerS2: Math.min(accelMmPerS2, SLICED_ACCEL_MM_PER_S2) },
    ]),
  );
