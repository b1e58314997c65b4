/** Converts pen height (percent, 100 = highest) to servo position (1/12 µs) and back. */
import type { MachineProfile } from "../../../machines/profile.js";
import { ebbOf } from "./ebb-controller.js";

/** Whole servo units, clamped to the machine's range. Throws RangeError if the height is not finite. */
export function servoPosFromPct(machine: MachineProfile, heightPct: number): number {
  if (!Number.isFinite(heightPct)) throw new RangeError(`pen height is ${heightPct}: expected 0 to 100 %`);
  const { servoPosAt0Pct, servoPosAt100Pct } = ebbOf(machine);
  const part = Math.min(100, Math.max(0, heightPct)) / 100;
  return Math.round(servoPosAt0Pct + part * (servoPosAt100Pct - servoPosAt0Pct));
}

export function pctFromServoPos(machine: MachineProfile, servoPos: number): number {
  const { servoPosAt0Pct, servoPosAt100Pct } = ebbOf(machine);
  return (100 * (servoPos - servoPosAt0Pct)) / (servoPosAt100Pct - servoPosAt0Pct);
}
