/**
 * How long the servo of a pen lift takes for a distance, in percent of its range:
 *
 *   time = ((minimum + slope · distance)⁴ + (distance / rate)⁴)^¼
 *
 * The first term is the servo itself, the second the board, which moves the servo's signal at a rate. The slower of the
 * two counts, with a smooth change between them. The form, and the figures for AxiDraw and NextDraw, are those of their
 * maker's software.
 */
import type { Controller, MachineProfile, PenServo } from "./profile.js";

/** AxiDraw's servo, in percent of its maker's range: 131 ms up and 146 ms down for 30 %. */
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

/**
 * The ranges whose percents the maker's software counts, units of 1/12 µs: 9 855 … 27 831 and 5 400 … 12 600. A servo turns
 * by the same angle for the same units, so one percent of a wider range takes it longer.
 */
const MAKERS_RANGE = { standard: 17_976, brushless: 7_200 };
/** Of a profile that states none. */
const USUAL: Omit<Controller, "kind"> = { servoPosAt0Pct: 7_500, servoPosAt100Pct: 28_000 };

export const hasBrushlessLift = (machine: MachineProfile | null | undefined): boolean =>
  machine?.controller.servoPin === BRUSHLESS_OUTPUT;

/**
 * The servo of a machine. Profiles that do not describe it have one of AxiDraw's or NextDraw's, by its output. The rates
 * are those of the board's signal in the profile's own percent; only the servo's slope depends on the range.
 */
export function penServoOf(machine: MachineProfile | null | undefined): PenServo {
  if (machine?.penServo) return machine.penServo;
  const { servoPosAt0Pct, servoPosAt100Pct } = { ...USUAL, ...machine?.controller };
  const isBrushless = hasBrushlessLift(machine);
  const servo = isBrushless ? BRUSHLESS_LIFT : STANDARD_SERVO;
  const makersRange = isBrushless ? MAKERS_RANGE.brushless : MAKERS_RANGE.standard;
  const range = Math.abs(Number(servoPosAt100Pct) - Number(servoPosAt0Pct));
  return { ...servo, slopeMsPerPct: (servo.slopeMsPerPct * range) / makersRange };
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
