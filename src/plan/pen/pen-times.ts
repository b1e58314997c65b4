/** Durations of whole pen moves. pen-flight.ts has the part for which the carriage need not wait. */
import { penServoOf, servoTime } from "../../machines/pen-servo.js";
import type { MachineProfile, PenServo } from "../../machines/profile.js";
import type { PenSettings } from "../../settings/pen.js";

/** Pen settings, and the servo that moves the pen. */
export interface TimedPen extends PenSettings {
  readonly servo: PenServo;
}

export const timedPen = (pen: PenSettings, machine: MachineProfile | null | undefined): TimedPen => ({
  ...pen,
  servo: penServoOf(machine),
});

/** The pen settings of one layer. */
export function penOfLayer<Pen extends PenSettings>(pen: Pen, layerId: string): Pen {
  const own = pen.layers?.[layerId];
  if (own === undefined) return pen;
  return {
    ...pen,
    upPct: own.upPct ?? pen.upPct,
    downPct: own.downPct ?? pen.downPct,
    extraLiftMs: own.extraLiftMs ?? pen.extraLiftMs,
    extraDropMs: own.extraDropMs ?? pen.extraDropMs,
  };
}

/** How long the servo moves for a lift by `distancePct`, s. */
export function liftMoveTime(pen: TimedPen, distancePct: number): number {
  const { servo, liftPctPerS, extraLiftMs } = pen;
  const rate = liftPctPerS ?? servo.liftPctPerS;
  return servoTime(servo, Math.abs(distancePct), rate) * shareOfTime(pen, extraLiftMs, rate);
}

/** How long the servo moves for a drop by `distancePct`, s. */
export function dropMoveTime(pen: TimedPen, distancePct: number): number {
  const { servo, dropPctPerS, extraDropMs } = pen;
  const rate = dropPctPerS ?? servo.dropPctPerS;
  return servoTime(servo, Math.abs(distancePct), rate) * shareOfTime(pen, extraDropMs, rate);
}

/** A servo that needs no time at all would have an infinite speed. */
const MIN_SHARE = 0.01;

/** A negative extra wait means a servo that is faster by this factor: between the two heights it saves that much time. */
export function shareOfTime(
  { servo, upPct, downPct }: TimedPen,
  extraMs: number,
  ratePctPerS: number,
): number {
  if (extraMs >= 0) return 1;
  return Math.max(MIN_SHARE, 1 + extraMs / 1_000 / servoTime(servo, upPct - downPct, ratePctPerS));
}

/** How long the carriage waits for a lift to `heightPct`, s. */
export const liftTime = (pen: TimedPen, heightPct: number): number =>
  waitOf(liftMoveTime(pen, heightPct - pen.downPct), pen.extraLiftMs);

/** How long the carriage waits for a drop from `fromPct`, s. */
export const dropTime = (pen: TimedPen, fromPct: number): number =>
  waitOf(dropMoveTime(pen, fromPct - pen.downPct), pen.extraDropMs);

/** The wait for a pen that is already down to change its height by `byPct`. */
export const reseatWaitS = (pen: TimedPen, byPct: number): number =>
  waitOf(pen.servo.frameMs / 1_000 + dropMoveTime(pen, byPct), pen.extraDropMs);

/** The time of a move, which accounts for a negative extra wait, and a positive extra wait. */
export const waitOf = (moveS: number, extraMs: number): number =>
  Math.max(0, moveS) + Math.max(0, extraMs) / 1_000;
