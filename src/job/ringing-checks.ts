/** The second ringing sheet: the same staircase unshaped and shaped for several frequencies, to choose the straightest by eye. */
import type { Springs } from "../machines/profile.js";

/** Side of a step, mm. */
const STEP_MM = 25;
const STEPS = 3;
/** Width and height of a staircase, mm. */
export const STAIRS_MM = STEPS * STEP_MM;
/** Beyond this distance from the figure before, lines are not clearer, mm. */
export const NEXT_STAIRS_MM = 12;

/** Sharp turns and a high acceleration let the machine swing. */
export const CHECK_ACCEL = 3_000;

export interface RingingCheck {
  /** Multiplies both frequencies; null: not shaped. */
  readonly factor: number | null;
  readonly springs: Springs | null;
  readonly svg: string;
}

/** One figure without shaping, and one for each factor. The user plots them separately and chooses the best by eye. */
export function ringingChecks(springs: Springs): RingingCheck[] {
  const svg =
    `<svg xmlns="http://www.w3.org/2000/svg" width="${STAIRS_MM}mm" height="${STAIRS_MM}mm" ` +
    `viewBox="0 0 ${STAIRS_MM} ${STAIRS_MM}">\n<path d="${stairsPath(0, 0)}" fill="none" stroke="#000"/>\n</svg>\n`;
  return [null, 0.8, 0.9, 1, 1.1, 1.25].map((factor) => ({
    factor,
    springs: factor === null ? null : { ...springs, xHz: factor * springs.xHz, yHz: factor * springs.yHz },
    svg,
  }));
}

/** Path data of a figure: a staircase, down and to the right. */
export const stairsPath = (xMm: number, yMm: number): string =>
  `M${xMm} ${yMm}${`v${STEP_MM}h${STEP_MM}`.repeat(STEPS)}`;
