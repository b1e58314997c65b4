/**
 * The pen as a motion: how high it goes, and how long the carriage waits for it.
 *
 *   lift time = delay + way / rate        way: between the down and up heights, % of the servo's range
 *
 * The carriage starts when `clearPct` of the lift is over. A hop lifts by a part of the full way only, and takes
 * that part of the full time.
 */
import type { PenSettings } from "../settings/pen.js";

export interface PenTiming {
  readonly heightPct: number;
  readonly waitS: number;
}

/** The settings that hold for one layer. */
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

/** The height between strokes for a way of `travelMm`. */
export function upHeight(pen: PenSettings, travelMm: number): number {
  const { hop } = pen;
  return hop && travelMm <= hop.longestMm ? Math.min(pen.upPct, hop.upPct) : pen.upPct;
}

export function liftTiming(pen: PenSettings, heightPct: number): PenTiming {
  const wholeS = moveTime(pen, heightPct, pen.liftMs, pen.liftPctPerS);
  return { heightPct, waitS: (wholeS * (pen.clearPct ?? 100)) / 100 };
}

/** @param fromPct the height from which the pen is dropped */
export function dropTiming(pen: PenSettings, fromPct: number): PenTiming {
  return { heightPct: pen.downPct, waitS: moveTime(pen, fromPct, pen.dropMs, pen.dropPctPerS) };
}

/** The servo's last frame, and its rest. */
const RESEAT_S = 0.06;

/** A pen that is down goes to another height, `byPct` away, at the rate at which `pen` is dropped. */
export function reseatWaitS(pen: PenSettings, byPct: number): number {
  if (pen.dropPctPerS) return RESEAT_S + byPct / pen.dropPctPerS;
  const wayPct = pen.upPct - pen.downPct;
  return RESEAT_S + (wayPct > 0 ? ((pen.dropMs / 1000) * byPct) / wayPct : 0);
}

function moveTime(pen: PenSettings, upPct: number, delayMs: number, ratePctPerS?: number | null): number {
  const way = upPct - pen.downPct;
  if (ratePctPerS) return delayMs / 1000 + way / ratePctPerS;
  return ((delayMs / 1000) * way) / (pen.upPct - pen.downPct);
}
