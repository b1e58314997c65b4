/**
 * The pen sheet: one line of dashes and dots for each extra wait, shorter and shorter from the top down. Where the wait is too
 * short, a dash has a tail (the pen was not yet up) or lacks its beginning (it was not yet down), and dots are missing:
 *
 *      0   ──────  ·  ──────  ·  ──────     right
 *    −40   ──────~ ·   ─────~    ─────~     too short
 */
import { DEFAULT_MOTION, type MotionSettings } from "../settings/motion.js";
import type { LayerPen, PenSettings } from "../settings/pen.js";

/** The extra waits of the lines, ms. With the first one any pen draws right: the others are compared with it. */
export const PEN_SHEET_WAITS_MS: readonly number[] = [300, 60, 40, 20, 0, -20, -40, -60, -80];

const LINE_MM = 8;
/** Room for a line's number, left of it. */
const NUMBER_MM = 16;
/** A dash, and the gap after it, with a dot in its middle. */
const DASH_MM = 7;
const GAP_MM = 7;
const DASHES = 6;

export const PEN_SHEET_WIDTH_MM = NUMBER_MM + DASHES * (DASH_MM + GAP_MM);
export const PEN_SHEET_HEIGHT_MM = PEN_SHEET_WAITS_MS.length * LINE_MM;

/** As most drawings are drawn, without the fine limits of a quality. */
export const PEN_SHEET_MOTION: MotionSettings = DEFAULT_MOTION;

const NUMBERS_ID = "numbers";
const idOf = (waitMs: number): string => `wait${waitMs}`;

/** The sheet as an SVG drawing, one layer for each line, and one for their numbers. */
export function penSheet(): string {
  const numbers = PEN_SHEET_WAITS_MS.map(
    (waitMs, i) =>
      `<text x="0" y="${baseline(i) + 1.5}" font-size="4" stroke="#000" fill="none">${waitMs}</text>`,
  );
  const lines = PEN_SHEET_WAITS_MS.map((waitMs, i) => layer(idOf(waitMs), `${i + 1} ${waitMs} ms`, line(i)));
  const [width, height] = [PEN_SHEET_WIDTH_MM, PEN_SHEET_HEIGHT_MM];
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" ` +
    `width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">\n` +
    [layer(NUMBERS_ID, "0 numbers", numbers.join("")), ...lines].join("\n") +
    "\n</svg>\n"
  );
}

/** The pen with which the sheet is plotted: the carriage waits for it, in each line as long as its number says. */
export function penOfSheet(pen: PenSettings): PenSettings {
  const layers = Object.fromEntries([
    [NUMBERS_ID, waits(PEN_SHEET_WAITS_MS[0])],
    ...PEN_SHEET_WAITS_MS.map((waitMs) => [idOf(waitMs), waits(waitMs)] as const),
  ]);
  return { ...pen, overlap: "off", layers };
}

const waits = (ms: number): LayerPen => ({ extraLiftMs: ms, extraDropMs: ms });

const layer = (id: string, label: string, content: string): string =>
  `<g inkscape:groupmode="layer" id="${id}" inkscape:label="${label}">${content}</g>`;

const baseline = (i: number): number => (i + 0.5) * LINE_MM;

function line(i: number): string {
  const parts = Array.from({ length: DASHES }, (_, k) => {
    const x = NUMBER_MM + k * (DASH_MM + GAP_MM);
    const dotX = x + DASH_MM + GAP_MM / 2;
    return `M${x} ${baseline(i)}h${DASH_MM}M${dotX} ${baseline(i)}h0.1`;
  });
  return `<path d="${parts.join("")}" fill="none" stroke="#000"/>`;
}
