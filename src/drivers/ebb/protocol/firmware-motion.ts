/** Limits of the firmware on the plan itself. */
import type { LayerMotion, MotionSettings } from "../../../settings/motion.js";
import type { FirmwareRules } from "../../machine-job.js";
import { firmwareFeatures, newerFirmwareNote, queueDepthOf } from "./firmware.js";

/**
 * mm/s². Slices of constant speed last about 10 ms, so the speed changes in jumps of A · 10 ms: 5 mm/s at
 * this acceleration. Rounding to whole steps adds up to 2 mm/s.
 */
const SLICED_ACCEL_MM_PER_S2 = 500;

/**
 * True if `motionForFirmware` limits this firmware. Null: unknown. Throws `bad-setting`
 * for an invalid version.
 */
const limitsMotion = (firmware: string | null): boolean =>
  firmware !== null && firmwareFeatures(firmware).motion === "slices";

/**
 * Whether pens are lowered only at the stroke. A board with a queue of one reads only two commands ahead. If it is
 * unplugged, it may have read a drop, but not the rest of the travel to the stroke. Null: unknown, so it may be such a
 * board. Throws `bad-setting` for an invalid version.
 */
export const dropsAtStroke = (firmware: string | null): boolean =>
  firmware === null || queueDepthOf(firmwareFeatures(firmware)) === 1;

const SUPPLY_ADVICE =
  "Before firmware 3.0.0, this board can miss a motor supply failure of less than 0.3 s, and would then draw the rest beside its place: check the plug of the power supply, or update the firmware.";

/** A version of an EBB is a bare number; those of other controllers begin with their name. */
export const ebbFirmware: FirmwareRules = {
  isOwn: (firmware) => /^v?\d/.test(firmware),
  isPlannedAlike: ({ overlap }, a, b) =>
    limitsMotion(a) === limitsMotion(b) && (overlap !== "fast" || dropsAtStroke(a) === dropsAtStroke(b)),
  advice: (firmware) =>
    newerFirmwareNote(firmware) ?? (firmwareFeatures(firmware).hasSupplyLatch ? null : SUPPLY_ADVICE),
};

/**
 * Limits the settings to what this firmware can execute smoothly. Firmware before 2.5.3 has only constant speeds, so
 * accelerations are limited to 500 mm/s² and nothing is shaped. For newer or unknown (null) firmware the settings are
 * unchanged. Idempotent.
 *
 * Throws `bad-setting` for an invalid version.
 */
export function motionForFirmware(motion: MotionSettings, firmware: string | null): MotionSettings {
  if (!limitsMotion(firmware)) return motion;
  const { draw, travel } = motion;
  const layers = Object.entries(motion.layers ?? {}).map(([id, limits]) => [id, gentler(limits)] as const);
  return {
    ...motion,
    shaper: "none",
    draw: gentler(draw),
    travel: gentler(travel),
    ...(motion.layers && { layers: Object.fromEntries(layers) }),
  };
}

function gentler<T extends LayerMotion>(limits: T): T {
  const { accelMmPerS2 } = limits;
  if (accelMmPerS2 === undefined) return limits;
  return { ...limits, accelMmPerS2: Math.min(accelMmPerS2, SLICED_ACCEL_MM_PER_S2) };
}
