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
export const liftMoveTime = ({ servo, liftPctPerS }: TimedPen, distancePct: number): number =>
  servoTime(servo, Math.abs(distancePct), liftPctPerS ?? servo.liftPctPerS);

/** How long the servo moves for a drop by `distancePct`, s. */
export const dropMoveTime = ({ servo, dropPctPerS }: TimedPen, distancePct: number): number =>
  servoTime(servo, Math.abs(distancePct), dropPctPerS ?? servo.dropPctPerS);

/** How long the carriage waits for a lift to `heightPct`, s. */
export const liftTime = (pen: TimedPen, heightPct: number): number =>
  waitOf(liftMoveTime(pen, heightPct - pen.downPct), pen.extraLiftMs);

/** How long the carriage waits for a drop from `fromPct`, s. */
export const dropTime = (pen: TimedPen, fromPct: number): number =>
  waitOf(dropMoveTime(pen, fromPct - pen.downPct), pen.extraDropMs);

/** The wait for a pen that is already down to change its height by `byPct`. */
export const reseatWaitS = (pen: TimedPen, byPct: number): number =>
  waitOf(pen.servo.frameMs / 1_000 + dropMoveTime(pen, byPct), pen.extraDropMs);

/** The time of a move and the user's extra wait, which may be negative. */
export const waitOf = (moveS: number, extraMs: number): number => Math.max(0, moveS + extraMs / 1_000);
