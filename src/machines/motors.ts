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

export function motor1FromXy(machine: MachineProfile, x: number, y: number): number {
  const sx = wiredX(machine, x);
  const sy = wiredY(machine, y);
  // The sum does not depend on swapAxes.
  if (machine.motors === "mixed") return (sx + sy) * machine.stepsPerMm;
  return (machine.swapAxes ? sy : sx) * machine.stepsPerMm;
}

export function motor2FromXy(machine: MachineProfile, x: number, y: number): number {
  const sx = wiredX(machine, x);
  const sy = wiredY(machine, y);
  const u = machine.swapAxes ? sy : sx;
  const v = machine.swapAxes ? sx : sy;
  return (machine.motors === "mixed" ? u - v : v) * machine.stepsPerMm;
}

/** mm from home; the motor steps may be fractional. */
export const xFromMotors = (machine: MachineProfile, steps1: number, steps2: number): number =>
  wiredX(
    machine,
    machine.swapAxes ? secondAxis(machine, steps1, steps2) : firstAxis(machine, steps1, steps2),
  );

export const yFromMotors = (machine: MachineProfile, steps1: number, steps2: number): number =>
  wiredY(
    machine,
    machine.swapAxes ? firstAxis(machine, steps1, steps2) : secondAxis(machine, steps1, steps2),
  );

const firstAxis = (machine: MachineProfile, steps1: number, steps2: number): number =>
  (machine.motors === "mixed" ? (steps1 + steps2) / 2 : steps1) / machine.stepsPerMm;

const secondAxis = (machine: MachineProfile, steps1: number, steps2: number): number =>
  (machine.motors === "mixed" ? (steps1 - steps2) / 2 : steps2) / machine.stepsPerMm;

/** Position in mm from home; the motor steps may be fractional. */
export const placeFromMotors = (
  machine: MachineProfile,
  steps1: number,
  steps2: number,
): { x: number; y: number } => ({
  x: xFromMotors(machine, steps1, steps2),
  y: yFromMotors(machine, steps1, steps2),
});
