/**
 * Durations of whole pen moves. pen-flight.ts has the part for which the carriage need not wait.
 *
 *   lift time = delay + distance / rate     distance: between the down and up heights, % of the servo's range
 */
import type { PenSettings } from "../../settings/pen.js";

/** The pen settings of one layer. */
export function penOfLayer(pen: PenSettings, layerId: string): PenSettings {
  const own = pen.layers?.[layerId];
  if (own === undefined) return pen;
  return {
    ...pen,
    upPct: own.upPct ?? pen.upPct,
    downPct: own.downPct ?? pen.downPct,
    liftMs: own.liftMs ?? pen.liftMs,
    dropMs: own.dropMs ?? pen.dropMs,
  };
}

/** Time of a lift to `heightPct`, s. */
export const liftTime = (pen: PenSettings, heightPct: number): number =>
  moveTime(pen, heightPct, pen.liftMs, pen.liftPctPerS);

/** Time of a drop from `fromPct`, s. */
export const dropTime = (pen: PenSettings, fromPct: number): number =>
  moveTime(pen, fromPct, pen.dropMs, pen.dropPctPerS);

/** The servo's last pulse interval, plus settling. */
const RESEAT_S = 0.06;

/** The wait for a pen that is already down to change its height by `byPct`, at the drop rate of `pen`. */
export function reseatWaitS(pen: PenSettings, byPct: number): number {
  if (pen.dropPctPerS) return RESEAT_S + byPct / pen.dropPctPerS;
  const rangePct = pen.upPct - pen.downPct;
  return RESEAT_S + (rangePct > 0 ? ((pen.dropMs / 1000) * byPct) / rangePct : 0);
}

function moveTime(pen: PenSettings, upPct: number, delayMs: number, ratePctPerS?: number | null): number {
  const distancePct = upPct - pen.downPct;
  if (ratePctPerS) return delayMs / 1000 + distancePct / ratePctPerS;
  return ((delayMs / 1000) * distancePct) / (pen.upPct - pen.downPct);
}
