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
 * nothing moves if the height is unknown, because the pen is probably up. `isInPlot`: an unfinished plot moved the carriage
 * last.
 */
export function leftPen(
  lift: PenLift,
  zMm: number,
  modes: string,
  { upPct, downPct }: PenSettings,
  before: PenBefore | null,
  isInPlot: boolean,
): LeftPen {
  const isUpByLines = lift.kind === "lines" ? upByLines(lift, modes) : null;
  if (isUpByLines !== null) {
    return { isUp: isUpByLines, mustLift: !isUpByLines && (before !== null || isInPlot) };
  }
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

/** Whether own lines have lifted the pen, by what they set of spindle and coolant; null: the modes do not tell. */
function upByLines(lift: PenLift, modes: string): boolean | null {
  const found = outputsIn(modes);
  const isSetBy = (up: boolean): boolean =>
    [...outputsIn(lift.lines(up, 0).join("\n"))].every(([output, value]) => found.get(output) === value);
  const isUp = isSetBy(true);
  return isUp === isSetBy(false) ? null : isUp;
}

const COMMENTS = /\(.*?\)|;.*/g;

/** The last M3 to M5, M7 to M9 and S of lines, or of a report. */
function outputsIn(lines: string): ReadonlyMap<string, number> {
  const outputs = new Map<string, number>();
  for (const [, letter, digits] of lines
    .toUpperCase()
    .replace(COMMENTS, "")
    .matchAll(/([MS])\s*(\d*\.?\d+)/g)) {
    const value = Number(digits);
    if (letter === "S") outputs.set("signal", value);
    else if (value >= 3 && value <= 5) outputs.set("spindle", value);
    else if (value >= 7 && value <= 9) outputs.set("coolant", value);
  }
  return outputs;
}
