/** The queries polled during a stream. Reads the motors' supply and the button from the board's replies. */
import type { FirmwareFeatures } from "../protocol/firmware.js";

/**
 * The second value of `QC` is the motor supply through a divider: about 300 for 9 V. Below this the supply is
 * absent or failing (the threshold that host programs use).
 */
const LOW_SUPPLY = 250;
const BUTTON_BIT = 1 << 5;

export function isPowerLow(line: string, reply: string): boolean {
  const reading = line === "QC" ? Number(reply.split(",")[1]) : Infinity;
  return reading < LOW_SUPPLY;
}

export function isButtonPressed(line: string, reply: string): boolean {
  if (line === "QG") return (Number.parseInt(reply, 16) & BUTTON_BIT) !== 0;
  return line === "QB" && Number(reply) === 1;
}

/**
 * The queries polled during a stream: for the board's time, its button, its position, the motors' supply, and whether it
 * has restarted. The supply is measured twice, because only two low readings in a row count: so one poll is enough to
 * detect a supply that fails for a moment, and the motors lose steps at once.
 */
export function pollLines(features: FirmwareFeatures, markQuery: string): readonly string[] {
  const supply = ["QC", "QC"];
  if (!features.hasStepQuery) return ["QM", "QB", ...supply];
  if (!features.hasGeneralQuery) return ["QM", "QB", "QS", ...supply];
  if (!features.hasClear) return ["QG", "QS", ...supply];
  return [...(features.hasImmediateLift ? ["QU,6"] : []), "QG", "QS", ...supply, markQuery];
}
