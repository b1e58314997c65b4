/**
 * Durations of whole pen moves. pen-flight.ts has the part for which the carriage need not wait.
 *
 *   lift time = delay + distance / rate     distance: between the down and up heights, % of the servo's range
 */
import type { PenSettings } from "../settings/pen.js";

export interface PenTiming {
  readonly heightPct: number;
  readonly waitS: number;
}

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

export function liftTiming(pen: PenSettings, heightPct: number): PenTiming {
  return { heightPct, waitS: moveTime(pen, heightPct, pen.liftMs, pen.liftPctPerS) };
}

/** @param fromPct the height before the drop */
export function dropTiming(pen: PenSettings, fromPct: number): PenTiming {
  return { heightPct: pen.downPct, waitS: moveTime(pen, fromPct, pen.dropMs, pen.dropPctPerS) };
}

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
