/**
 * Carriage to motors and back. Frames: machine mm, motor steps.
 *
 *   mixed (H-bot, CoreXY)   m1 = k (x + y)   m2 = k (x − y)      x = (m1 + m2)/2k   y = (m1 − m2)/2k
 *   direct                  m1 = k x         m2 = k y
 *
 * The map is linear, so velocities and accelerations go through it as places do.
 */
import type { MachineProfile } from "./profile.js";

export const motor1FromXy = (machine: MachineProfile, x: number, y: number): number =>
  machine.motors === "mixed" ? (x + y) * machine.stepsPerMm : x * machine.stepsPerMm;

export const motor2FromXy = (machine: MachineProfile, x: number, y: number): number =>
  machine.motors === "mixed" ? (x - y) * machine.stepsPerMm : y * machine.stepsPerMm;

/** mm from home of motor steps (whole or not). */
export const xFromMotors = (machine: MachineProfile, steps1: number, steps2: number): number =>
  (machine.motors === "mixed" ? (steps1 + steps2) / 2 : steps1) / machine.stepsPerMm;

export const yFromMotors = (machine: MachineProfile, steps1: number, steps2: number): number =>
  (machine.motors === "mixed" ? (steps1 - steps2) / 2 : steps2) / machine.stepsPerMm;
