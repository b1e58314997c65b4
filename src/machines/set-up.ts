/**
 * Corrects a machine profile by what the user observed: which direction the carriage moved, and
 * how large it drew.
 *
 * The wiring turns motor motion into carriage motion by an unknown signed permutation of the axes, P. With the profile's
 * map T, the motors get T (x, y), so the user observes M = P T. To make M the identity, replace T by T M⁻¹. M is a signed
 * permutation too, so its inverse is its transpose.
 */
import { PlotwrightError } from "../errors.js";
import { uFromXy, vFromXy } from "./motors.js";
import type { MachineProfile } from "./profile.js";

export const DIRECTIONS = ["right", "left", "down", "up"] as const;
/** On the page: x grows to the right, y grows down, towards the user. */
export type Direction = (typeof DIRECTIONS)[number];

const VECTORS: Readonly<Record<Direction, readonly [x: number, y: number]>> = {
  right: [1, 0],
  left: [-1, 0],
  down: [0, 1],
  up: [0, -1],
};

/**
 * Corrects the profile so that the carriage moves right for +x and down for +y.
 *
 * @param xWent where the carriage went when it was sent right with the current profile
 * @param yWent the same for down
 * @throws PlotwrightError "bad-setting" if both directions are on one line, because one motor does not turn
 */
export function machineTurned(machine: MachineProfile, xWent: Direction, yWent: Direction): MachineProfile {
  const [xx, xy] = VECTORS[xWent];
  const [yx, yy] = VECTORS[yWent];
  if (xx * yx + xy * yy !== 0) {
    throw new PlotwrightError(
      "bad-setting",
      `The carriage went ${xWent} and then ${yWent}, along one line: one motor does not turn. Check that both motor cables are plugged in.`,
    );
  }
  // The corrected map T M⁻¹ takes (1, 0) to T (xx, yx), and (0, 1) to T (xy, yy).
  const [xu, xv] = [uFromXy(machine, xx, yx), vFromXy(machine, xx, yx)];
  const [yu, yv] = [uFromXy(machine, xy, yy), vFromXy(machine, xy, yy)];
  return { ...machine, swapAxes: xu === 0, flipX: xu + xv < 0, flipY: yu + yv < 0 };
}

/** A measurement that is wrong by more than this factor is a mistake or a wrong microstep mode, not a scale error. */
const MAX_SCALE = 20;

/**
 * The steps per mm with which a square has its true size.
 *
 * @param drawnMm the intended side of the square
 * @param measuredXMm, measuredYMm the measured sides; the mean is used, because both axes share one figure
 * @throws PlotwrightError "bad-setting" for impossible measurements
 */
export function stepsPerMmMeasured(
  machine: MachineProfile,
  drawnMm: number,
  measuredXMm: number,
  measuredYMm: number = measuredXMm,
): number {
  checkMeasured(drawnMm, measuredXMm, measuredYMm);
  return (machine.stepsPerMm * drawnMm) / meanOf(measuredXMm, measuredYMm);
}

/**
 * How many times as far each of the machine's own axes has to go, so that a square has its true size. For machines whose
 * controller counts steps by itself.
 *
 * @throws PlotwrightError "bad-setting" for impossible measurements
 */
export function scaleMeasured(
  machine: MachineProfile,
  drawnMm: number,
  measuredXMm: number,
  measuredYMm: number,
): readonly [first: number, second: number] {
  checkMeasured(drawnMm, measuredXMm, measuredYMm);
  const [x, y] = [drawnMm / measuredXMm, drawnMm / measuredYMm];
  return machine.swapAxes ? [y, x] : [x, y];
}

const meanOf = (a: number, b: number): number => (a + b) / 2;

function checkMeasured(drawnMm: number, measuredXMm: number, measuredYMm: number): void {
  const measuredMm = meanOf(measuredXMm, measuredYMm);
  const scale = drawnMm / measuredMm;
  const isOneSize = Math.abs(measuredXMm - measuredYMm) <= 0.2 * measuredMm;
  if (!(measuredXMm > 0 && measuredYMm > 0 && scale < MAX_SCALE && scale > 1 / MAX_SCALE && isOneSize)) {
    throw new PlotwrightError(
      "bad-setting",
      `A ${drawnMm} mm square cannot have come out as ${measuredXMm} × ${measuredYMm} mm: measure it again, in mm.`,
    );
  }
}
