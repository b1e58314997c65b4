/** The pen of a Grbl that has just been connected: how an earlier connection, or another program, has left it. */
import type { PenSettings } from "../../../settings/pen.js";
import type { PenBefore } from "../../driver.js";
import type { PenLift } from "../model/pen-lift.js";
import { servoSignalOf } from "../protocol.js";
import type { GrblMemory } from "./kept-home.js";

/** Share of the pen's travel below its lowest height up to which a height counts as one of the pen's. */
const BELOW = 0.25;
/** A share of the pen's travel from which the pen counts as up. */
const UP = 0.99;

export interface LeftPen {
  readonly isUp: boolean;
  /** It may rest on the paper. */
  readonly mustLift: boolean;
}

/**
 * Whether nothing tells from which height a Z axis counts. `isKept`: the Grbl has not been reset since an earlier connection
 * or process.
 */
export function isHeightLost(lift: PenLift, before: PenBefore | null, isKept: boolean): boolean {
  const wasUnsure = (before?.memory as GrblMemory | null | undefined)?.isHeightUnsure === true;
  const isKnown = isKept || (before !== null && before.penUp !== null);
  return lift.kind === "z" && (wasUnsure || !isKnown);
}

/**
 * `zMm`: the work position of Z. `modes`: the report of the parser's modes. `before`: null at the first connection, where
 * nothing moves if the height is unknown, because the pen is probably up.
 */
export function leftPen(
  lift: PenLift,
  zMm: number,
  modes: string,
  { upPct, downPct }: PenSettings,
  before: PenBefore | null,
): LeftPen {
  const pct = keptHeightPct(lift, zMm, modes);
  if (pct === null) return { isUp: before?.penUp === true, mustLift: before !== null };
  const share = (pct - downPct) / (upPct - downPct);
  const isPlausible = lift.kind === "servo" || share > -BELOW;
  return { isUp: share > UP, mustLift: share <= UP && (before !== null || isPlausible) };
}

/** Null: the Grbl has none. */
function keptHeightPct(lift: PenLift, zMm: number, modes: string): number | null {
  if (lift.kind === "z") return lift.pctOf(zMm);
  const signal = lift.kind === "servo" ? servoSignalOf(modes) : null;
  return signal === null ? null : lift.pctOf(signal);
}
