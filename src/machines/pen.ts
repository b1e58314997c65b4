/** Pen height (percent, 100 = highest) to servo position (1/12 µs) and back. */
import type { MachineProfile } from "./profile.js";

/** Whole servo units, kept within the machine's range. Throws RangeError for what is no number. */
export function servoPosFromPct(machine: MachineProfile, heightPct: number): number {
  if (!Number.isFinite(heightPct)) throw new RangeError(`pen height is ${heightPct}: expected 0 to 100 %`);
  const part = Math.min(100, Math.max(0, heightPct)) / 100;
  return Math.round(machine.servoPosAt0Pct + part * (machine.servoPosAt100Pct - machine.servoPosAt0Pct));
}

export const pctFromServoPos = (machine: MachineProfile, servoPos: number): number =>
  (100 * (servoPos - machine.servoPosAt0Pct)) / (machine.servoPosAt100Pct - machine.servoPosAt0Pct);
