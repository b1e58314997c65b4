/** Drawn over the strokes: rulers along the edges, and what lies beside the paper. */
import type { Box } from "../../src/internal.js";
import { DESK_FONT, type DeskColors } from "./backdrop.js";
import { rulerStep, screenBox, screenMap, turnOf, type Size, type View } from "../scene/view.js";
import type { CutOffPicture } from "../worker/cut-off.js";

export const RULER_PX = 22;

/** `span`: the marked part of the rulers, mm. */
export const drawRulers = (
  context: CanvasRenderingContext2D,
  view: View,
  size: Size,
  colors: DeskColors,
  unitMm: number,
  span: Box | null,
): void => {
  const unitPx = view.scale * unitMm;
  const [cos, sin] = turnOf(view);
  const isUpright = sin === 0;
  context.fillStyle = colors.ruler;
  context.fillRect(0, 0, size.width, RULER_PX);
  context.fillRect(0, RULER_PX, RULER_PX, size.height - RULER_PX);
  if (span) markSpan(context, view, span);
  drawTicks(context, view.offsetX, (isUpright ? cos : -sin) * unitPx, size.width, colors, false);
  context.save();
  // The left ruler is the top one, rotated. Its numbers read upwards.
  context.rotate(-Math.PI / 2);
  context.scale(-1, 1);
  drawTicks(context, view.offsetY, (isUpright ? cos : sin) * unitPx, size.height, colors, true);
  context.restore();
  context.fillStyle = colors.ruler;
  context.fillRect(0, 0, RULER_PX, RULER_PX);
  context.fillStyle = colors["ruler-text"];
  context.font = DESK_FONT;
  context.textAlign = "center";
  context.fillText(unitMm === 1 ? "mm" : "in", RULER_PX / 2, RULER_PX / 2 + 3);
  context.strokeStyle = colors["ruler-line"];
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(0, RULER_PX + 0.5);
  context.lineTo(size.width, RULER_PX + 0.5);
  context.moveTo(RULER_PX + 0.5, 0);
  context.lineTo(RULER_PX + 0.5, size.height);
  context.stroke();
};

const SPAN_COLOR = "rgb(47 98 216 / 22%)";

const markSpan = (context: CanvasRenderingContext2D, view: View, span: Box): void => {
  const { x0, y0, x1, y1 } = screenBox(view, span);
  const x = Math.max(RULER_PX, x0);
  const y = Math.max(RULER_PX, y0);
  context.fillStyle = SPAN_COLOR;
  context.fillRect(x, 0, Math.max(0, x1 - x), RULER_PX);
  context.fillRect(0, y, RULER_PX, Math.max(0, y1 - y));
};

/** `scale`: px per unit; below 0: the numbers grow towards the ruler's beginning. */
const drawTicks = (
  context: CanvasRenderingContext2D,
  offset: number,
  scale: number,
  lengthPx: number,
  colors: DeskColors,
  isMirrored: boolean,
): void => {
  const step = rulerStep(Math.abs(scale), 64);
  const parts = 10;
  const ends = [(RULER_PX - offset) / scale, (lengthPx - offset) / scale];
  const first = Math.floor(Math.min(...ends) / step) * step;
  const last = Math.max(...ends);
  context.strokeStyle = colors["ruler-text"];
  context.lineWidth = 1;
  context.beginPath();
  for (let k = 0; first + (k * step) / parts <= last; k++) {
    const px = Math.round(offset + (first + (k * step) / parts) * scale) + 0.5;
    if (px < RULER_PX) continue;
    const height = k % parts === 0 ? 8 : k % (parts / 2) === 0 ? 5 : 3;
    context.moveTo(px, RULER_PX - height);
    context.lineTo(px, RULER_PX);
  }
  context.globalAlpha = 0.55;
  context.stroke();
  context.globalAlpha = 1;
  context.fillStyle = colors["ruler-text"];
  context.font = DESK_FONT;
  context.textAlign = isMirrored ? "right" : "left";
  for (let mm = first; mm <= last; mm += step) {
    const px = offset + mm * scale;
    if (px < RULER_PX + 2) continue;
    const label = String(Number(mm.toFixed(6)));
    // Not cut off at the end of the ruler.
    if (px + 3 + context.measureText(label).width > lengthPx) continue;
    if (isMirrored) {
      context.save();
      context.translate(px, 0);
      context.scale(-1, 1);
      context.fillText(label, -3, 10);
      context.restore();
    } else {
      context.fillText(label, px + 3, 10);
    }
  }
};

/** Visible on the paper and beside it, in both themes. From the outside inwards. */
const CUT: readonly GlowPass[] = [["rgb(150 140 130 / 55%)", 1]];
/** A glow, so that it is seen at any zoom and beside any ink. */
const BESIDE: readonly GlowPass[] = [
  ["rgb(232 52 32 / 16%)", 13],
  ["rgb(232 52 32 / 38%)", 6],
  ["rgb(226 38 20)", 2],
];
type GlowPass = readonly [color: string, widthPx: number];

const TILE_COLOR = "#2f62d8";

/** The edges of the sheets over which a drawing is spread, with their numbers on top. Their overlaps are shaded. */
export const paintTiles = (context: CanvasRenderingContext2D, view: View, windows: readonly Box[]): void => {
  context.save();
  context.strokeStyle = context.fillStyle = TILE_COLOR;
  context.font = `600 ${DESK_FONT}`;
  context.setLineDash([6, 4]);
  for (const window of windows) {
    const { x0: x, y0: y, x1, y1 } = screenBox(view, window);
    const [width, height] = [x1 - x, y1 - y];
    context.strokeRect(x, y, width, height);
    // Twice where two of them overlap.
    context.globalAlpha = 0.06;
    context.fillRect(x, y, width, height);
    context.globalAlpha = 1;
  }
  context.setLineDash([]);
  windows.forEach((window, k) => {
    const { x0, y0 } = screenBox(view, window);
    paintTileNumber(context, x0, y0, String(k + 1));
  });
  context.restore();
};

const NUMBER_PX = 20;

/** On a plate, which keeps it readable on dense ink. */
const paintTileNumber = (context: CanvasRenderingContext2D, x: number, y: number, number: string): void => {
  const width = Math.max(NUMBER_PX, context.measureText(number).width + 10);
  context.fillStyle = TILE_COLOR;
  context.beginPath();
  context.roundRect(x + 5, y + 5, width, NUMBER_PX, 5);
  context.fill();
  context.fillStyle = "#fff";
  context.textAlign = "center";
  context.fillText(number, x + 5 + width / 2, y + 19);
};

export const paintCutOff = (context: CanvasRenderingContext2D, view: View, cutOff: CutOffPicture): void =>
  paintOutside(context, view, cutOff, CUT);

export const paintBesidePaper = (
  context: CanvasRenderingContext2D,
  view: View,
  beside: CutOffPicture,
): void => paintOutside(context, view, beside, BESIDE);

const paintOutside = (
  context: CanvasRenderingContext2D,
  view: View,
  { limit, points, offsets }: CutOffPicture,
  passes: readonly GlowPass[],
): void => {
  const { a, b, c, d, e, f } = screenMap(view);
  const kept = screenBox(view, limit);
  const to = (k: number): [number, number] => [
    a * points[k] + c * points[k + 1] + e,
    b * points[k] + d * points[k + 1] + f,
  ];
  context.save();
  // Clips to the canvas without the box.
  context.beginPath();
  context.rect(0, 0, context.canvas.width, context.canvas.height);
  context.rect(kept.x0, kept.y0, kept.x1 - kept.x0, kept.y1 - kept.y0);
  context.clip("evenodd");
  context.beginPath();
  for (let i = 0; i + 1 < offsets.length; i++) {
    context.moveTo(...to(offsets[i]));
    for (let k = offsets[i] + 2; k < offsets[i + 1]; k += 2) context.lineTo(...to(k));
  }
  context.lineCap = context.lineJoin = "round";
  for (const [color, widthPx] of passes) {
    context.strokeStyle = color;
    context.lineWidth = widthPx;
    context.stroke();
  }
  context.restore();
};
