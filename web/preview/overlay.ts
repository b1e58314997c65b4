/** Drawn over the strokes: rulers along the edges, and what lies beside the paper. */
import type { Box } from "../../src/internal.js";
import type { DeskColors } from "./backdrop.js";
import { rulerStep, type Size, type View } from "../scene/view.js";
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
  context.fillStyle = colors.ruler;
  context.fillRect(0, 0, size.width, RULER_PX);
  context.fillRect(0, RULER_PX, RULER_PX, size.height - RULER_PX);
  if (span) markSpan(context, view, span);
  drawTicks(context, view.offsetX, unitPx, size.width, colors, false);
  context.save();
  // The left ruler is the top one, rotated. Its numbers read upwards.
  context.rotate(-Math.PI / 2);
  context.scale(-1, 1);
  drawTicks(context, view.offsetY, unitPx, size.height, colors, true);
  context.restore();
  context.fillStyle = colors.ruler;
  context.fillRect(0, 0, RULER_PX, RULER_PX);
  context.fillStyle = colors["ruler-text"];
  context.font = "9px Helvetica, Arial, sans-serif";
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

const markSpan = (context: CanvasRenderingContext2D, { offsetX, offsetY, scale }: View, span: Box): void => {
  const x = Math.max(RULER_PX, offsetX + span.x0 * scale);
  const y = Math.max(RULER_PX, offsetY + span.y0 * scale);
  context.fillStyle = SPAN_COLOR;
  context.fillRect(x, 0, Math.max(0, offsetX + span.x1 * scale - x), RULER_PX);
  context.fillRect(0, y, RULER_PX, Math.max(0, offsetY + span.y1 * scale - y));
};

const drawTicks = (
  context: CanvasRenderingContext2D,
  offset: number,
  scale: number,
  lengthPx: number,
  colors: DeskColors,
  isMirrored: boolean,
): void => {
  const step = rulerStep(scale, 64);
  const parts = 10;
  const first = Math.floor((RULER_PX - offset) / scale / step) * step;
  const last = (lengthPx - offset) / scale;
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
  context.font = "10px Helvetica, Arial, sans-serif";
  context.textAlign = isMirrored ? "right" : "left";
  for (let mm = first; mm <= last; mm += step) {
    const px = offset + mm * scale;
    if (px < RULER_PX + 2) continue;
    const label = String(Number(mm.toFixed(6)));
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
  const x = (mm: number): number => view.offsetX + mm * view.scale;
  const y = (mm: number): number => view.offsetY + mm * view.scale;
  context.save();
  // Clips to the canvas without the box.
  context.beginPath();
  context.rect(0, 0, context.canvas.width, context.canvas.height);
  context.rect(
    x(limit.x0),
    y(limit.y0),
    (limit.x1 - limit.x0) * view.scale,
    (limit.y1 - limit.y0) * view.scale,
  );
  context.clip("evenodd");
  context.beginPath();
  for (let i = 0; i + 1 < offsets.length; i++) {
    context.moveTo(x(points[offsets[i]]), y(points[offsets[i] + 1]));
    for (let k = offsets[i] + 2; k < offsets[i + 1]; k += 2) context.lineTo(x(points[k]), y(points[k + 1]));
  }
  context.lineCap = context.lineJoin = "round";
  for (const [color, widthPx] of passes) {
    context.strokeStyle = color;
    context.lineWidth = widthPx;
    context.stroke();
  }
  context.restore();
};
