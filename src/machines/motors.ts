/**
 * Converts carriage positions to motor steps and back. Frames: machine mm, motor steps.
 *
 *   wiring                  u = ±x, v = ±y (flipX, flipY), exchanged if swapAxes
 *   mixed (H-bot, CoreXY)   m1 = k (u + v)   m2 = k (u − v)      u = (m1 + m2)/2k   v = (m1 − m2)/2k
 *   direct                  m1 = k u         m2 = k v
 *
 * The map is linear, so it converts velocities and accelerations as well as positions.
 */
import type { MachineProfile } from "./profile.js";

const wiredX = (machine: MachineProfile, x: number): number => (machine.flipX ? -x : x);
const wiredY = (machine: MachineProfile, y: number): number => (machine.flipY ? -y : y);

/** u of a position or move, mm. */
export const uFromXy = (machine: MachineProfile, x: number, y: number): number =>
  machine.swapAxes ? wiredY(machine, y) : wiredX(machine, x);

/** v of a position or move, mm. */
export const vFromXy = (machine: MachineProfile, x: number, y: number): number =>
  machine.swapAxes ? wiredX(machine, x) : wiredY(machine, y);

export function motor1FromXy(machine: MachineProfile, x: number, y: number): number {
  const u = uFromXy(machine, x, y);
  return (machine.motors === "mixed" ? u + vFromXy(machine, x, y) : u) * machine.stepsPerMm;
}

export function motor2FromXy(machine: MachineProfile, x: number, y: number): number {
  const v = vFromXy(machine, x, y);
  return (machine.motors === "mixed" ? uFromXy(machine, x, y) - v : v) * machine.stepsPerMm;
}

/** mm from home; the motor steps may be fractional. */
export const xFromMotors = (machine: MachineProfile, steps1: number, steps2: number): number =>
  wiredX(
    machine,
    machine.swapAxes ? vFromMotors(machine, steps1, steps2) : uFromMotors(machine, steps1, steps2),
  );

export const yFromMotors = (machine: MachineProfile, steps1: number, steps2: number): number =>
  wiredY(
    machine,
    machine.swapAxes ? uFromMotors(machine, steps1, steps2) : vFromMotors(machine, steps1, steps2),
  );

const uFromMotors = (machine: MachineProfile, steps1: number, steps2: number): number =>
  (machine.motors === "mixed" ? (steps1 + steps2) / 2 : steps1) / machine.stepsPerMm;

const vFromMotors = (machine: MachineProfile, steps1: number, steps2: number): number =>
  (machine.motors === "mixed" ? (steps1 - steps2) / 2 : steps2) / machine.stepsPerMm;

/** Position in mm from home; the motor steps may be fractional. */
export const positionFromMotors = (
  machine: MachineProfile,
  steps1: number,
  steps2: number,
): { x: number; y: number } => ({
  x: xFromMotors(machine, steps1, steps2),
  y: yFromMotors(machine, steps1, steps2),
});
