/**
 * How long the servo of a pen lift takes for a distance, in percent of its range:
 *
 *   time = ((minimum + slope · distance)⁴ + (distance / rate)⁴)^¼
 *
 * The first term is the servo itself, the second the board, which moves the servo's signal at a rate. The slower of the
 * two counts, with a smooth change between them. The form, and the figures for AxiDraw and NextDraw, are those of their
 * maker's software.
 */
import type { MachineProfile, PenServo } from "./profile.js";

/** AxiDraw: 131 ms up and 146 ms down for 30 %. */
export const STANDARD_SERVO: PenServo = {
  minMs: 45,
  slopeMsPerPct: 2.69,
  liftPctPerS: 375,
  dropPctPerS: 250,
  frameMs: 24,
};
/** NextDraw, and AxiDraw with the brushless upgrade: 46 ms up and 47 ms down for 20 %. */
export const BRUSHLESS_LIFT: PenServo = {
  minMs: 20,
  slopeMsPerPct: 1.28,
  liftPctPerS: 1_071,
  dropPctPerS: 714,
  frameMs: 3,
};
/** A hobby servo with an arm, whose maker states no times: 250 ms up and 300 ms down for 30 %. */
export const HOBBY_SERVO: PenServo = { ...STANDARD_SERVO, liftPctPerS: 122, dropPctPerS: 101 };

/** The servo output of the brushless lift; all others are on output 4. */
const BRUSHLESS_OUTPUT = 5;

/** The servo of a machine. Profiles that do not describe it have one of AxiDraw's or NextDraw's, by its output. */
export function penServoOf(machine: MachineProfile | null | undefined): PenServo {
  const isBrushless = machine?.controller.servoPin === BRUSHLESS_OUTPUT;
  return machine?.penServo ?? (isBrushless ? BRUSHLESS_LIFT : STANDARD_SERVO);
}

/** Time of a move, s. */
export function servoTime(
  { minMs, slopeMsPerPct }: PenServo,
  distancePct: number,
  ratePctPerS: number,
): number {
  if (distancePct === 0) return 0;
  const servoS = (minMs + slopeMsPerPct * distancePct) / 1_000;
  const signalS = distancePct / ratePctPerS;
  return (servoS ** 4 + signalS ** 4) ** 0.25;
}
