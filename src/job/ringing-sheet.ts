/**
 * The ringing sheet: square corners, drawn with such a high acceleration that the machine swings visibly after each of
 * them. The axis that has just stopped swings, which makes ripples on the next line. That line is drawn at a known speed:
 *
 *        ┌~~~~~──────   after a corner from up to right, y swings: ripples of length λ on the horizontal line
 *        │              f = v / λ
 *        │              on vertical lines, x swings
 */
import { PlotwrightError } from "../errors.js";
import type { Springs } from "../machines/profile.js";
import { codeOfSpeed, speedOfCode } from "../plan/coded-layers.js";
import { type MotionSettings, DEFAULT_MOTION } from "../settings/motion.js";
import { SPRINGS_TABLE } from "../settings/machine.js";
import { isAllowed, rangeInWords } from "../settings/setting.js";

/** The speeds of the three figures, mm/s. A ripple of 15 Hz is 2 to 5 mm long. */
export const RINGING_SPEEDS: readonly number[] = [30, 50, 75].map((speed) => speedOfCode(codeOfSpeed(speed)));

/** Side of a step, mm. */
const STEP_MM = 25;
const STEPS = 3;
/** Width and height of a figure, mm. */
export const STAIRS_MM = STEPS * STEP_MM;
/** Each figure is this far to the right of and above the one before, mm, so that no lines touch. */
export const NEXT_STAIRS_MM = 12;
/** The page: wider than high, so that it is not turned on the paper, with room for margins. */
const PAGE_MM = { width: 150, height: 148 };
const FROM_MM = 22;

/** The settings for plotting it: corners without rounding, high acceleration, no shaper. */
export const RINGING_MOTION: MotionSettings = {
  ...DEFAULT_MOTION,
  mode: "junction",
  shaper: "none",
  draw: { ...DEFAULT_MOTION.draw, accelMmPerS2: 3_000, cornerMm: 1 },
};

/** The sheet as an SVG drawing. Its layers' names carry their speeds as codes. */
export function ringingSheet(): string {
  const layers = RINGING_SPEEDS.map((speed, i) => {
    const label = `${i + 1}+s${codeOfSpeed(speed)} ${speed} mm/s`;
    return `<g inkscape:groupmode="layer" id="v${i + 1}" inkscape:label="${label}">${stairs(i)}</g>`;
  });
  return svg(layers.join("\n"));
}

export interface RingingCheck {
  /** Multiplies both frequencies; null: not shaped. */
  readonly factor: number | null;
  readonly springs: Springs | null;
  readonly svg: string;
}

/** One figure without shaping, and one for each factor. The user plots them separately and chooses the best by eye. */
export function ringingChecks(springs: Springs): RingingCheck[] {
  const sheet = svg(stairs(0));
  return [null, 0.8, 0.9, 1, 1.1, 1.25].map((factor) => ({
    factor,
    springs: factor === null ? null : { ...springs, xHz: factor * springs.xHz, yHz: factor * springs.yHz },
    svg: sheet,
  }));
}

/**
 * The frequency of a swing, Hz, from the ripples counted over a length of line.
 *
 * @throws PlotwrightError "bad-setting" for a frequency that no machine has
 */
export function frequencyOfRipples(speedMmPerS: number, ripples: number, overMm: number): number {
  const hz = (speedMmPerS * ripples) / overMm;
  if (!isAllowed(SPRINGS_TABLE.xHz, hz)) {
    throw new PlotwrightError(
      "bad-setting",
      `${ripples} ripples over ${overMm} mm at ${speedMmPerS} mm/s would be ${Math.round(hz * 10) / 10} Hz; ` +
        `a machine swings at ${rangeInWords(SPRINGS_TABLE.xHz)}: count again, near the corner.`,
    );
  }
  return hz;
}

/** Path data of a figure: a staircase, down and to the right. */
export const stairsPath = (xMm: number, yMm: number): string =>
  `M${xMm} ${yMm}${`v${STEP_MM}h${STEP_MM}`.repeat(STEPS)}`;

/** The sheet's figure for the i-th speed; the first is at the bottom left. */
function stairs(i: number): string {
  const xMm = FROM_MM + i * NEXT_STAIRS_MM;
  const yMm = FROM_MM + (RINGING_SPEEDS.length - 1 - i) * NEXT_STAIRS_MM;
  return `<path d="${stairsPath(xMm, yMm)}" fill="none" stroke="#000"/>`;
}

const svg = (content: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" ` +
  `width="${PAGE_MM.width}mm" height="${PAGE_MM.height}mm" ` +
  `viewBox="0 0 ${PAGE_MM.width} ${PAGE_MM.height}">\n${content}\n</svg>\n`;
