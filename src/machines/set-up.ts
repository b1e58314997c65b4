/**
 * A machine made to fit what the user has seen it do: which way it went, and how large it drew.
 *
 * The motors move the carriage by some signed change of axes P of what they are told, which nobody knows.
 * A profile tells them T (x, y), so a move is seen as M = P T. For M to become the identity, T has to become
 * T M⁻¹; and M is a change of axes with signs, so its inverse is its transpose.
 */
import { PlotwrightError } from "../errors.js";
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
 * The profile with which the carriage goes to the right for x and down for y.
 *
 * @param xWent where it went when it was told to go to the right by the profile as it is
 * @param yWent the same for down
 * @throws PlotwrightError "bad-setting" when both lie on one line: then a motor does not turn
 */
export function machineTurned(machine: MachineProfile, xWent: Direction, yWent: Direction): MachineProfile {
  const [xx, xy] = VECTORS[xWent];
  const [yx, yy] = VECTORS[yWent];
  if (xx * yx + xy * yy !== 0) {
    throw new PlotwrightError(
      "bad-setting",
      `The carriage went ${xWent} and then ${yWent}, along one line: one motor does not turn, or is not plugged in. Look at its cable.`,
    );
  }
  const turned = (x: number, y: number): readonly [number, number] =>
    wired(machine, xx * x + xy * y, yx * x + yy * y);
  const [xu, xv] = turned(1, 0);
  const [yu, yv] = turned(0, 1);
  return { ...machine, swapAxes: xu === 0, flipX: xu + xv < 0, flipY: yu + yv < 0 };
}

/** What the motors are told for a move, see `motors.ts`. */
function wired(machine: MachineProfile, x: number, y: number): readonly [number, number] {
  const u = machine.flipX ? -x : x;
  const v = machine.flipY ? -y : y;
  return machine.swapAxes ? [v, u] : [u, v];
}

/** A measurement further off than this is a slip of the ruler or a wrong microstep mode, not a scale. */
const MOST_SCALE = 20;

/**
 * The steps for one mm that make a square come out at its size.
 *
 * @param drawnMm what the square should have measured
 * @param measuredXMm, measuredYMm what the ruler says; the mean counts, since both axes share one figure
 * @throws PlotwrightError "bad-setting" for sizes that no square can have had
 */
export function stepsPerMmMeasured(
  machine: MachineProfile,
  drawnMm: number,
  measuredXMm: number,
  measuredYMm: number = measuredXMm,
): number {
  const measuredMm = (measuredXMm + measuredYMm) / 2;
  const scale = drawnMm / measuredMm;
  const isOneSize = Math.abs(measuredXMm - measuredYMm) <= 0.2 * measuredMm;
  if (!(measuredXMm > 0 && measuredYMm > 0 && scale < MOST_SCALE && scale > 1 / MOST_SCALE && isOneSize)) {
    throw new PlotwrightError(
      "bad-setting",
      `A square of ${drawnMm} mm can't have come out as ${measuredXMm} × ${measuredYMm} mm: measure it again, in mm.`,
    );
  }
  return machine.stepsPerMm * scale;
}
