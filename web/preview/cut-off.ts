/** Draws lines outside the margins or the paper: pale if they are cut off, in a warning colour if not. */
import type { View } from "../scene/view.js";
import type { CutOffPicture } from "../worker/cut-off.js";

/** Visible on the paper and beside it, in both themes. */
const CUT_COLOR = "rgb(150 140 130 / 55%)";
const BESIDE_COLOR = "rgb(210 69 44 / 85%)";
const LINE_PX = 1;

export const paintCutOff = (context: CanvasRenderingContext2D, view: View, cutOff: CutOffPicture): void =>
  paintOutside(context, view, cutOff, CUT_COLOR);

export const paintBesidePaper = (
  context: CanvasRenderingContext2D,
  view: View,
  beside: CutOffPicture,
): void => paintOutside(context, view, beside, BESIDE_COLOR);

const paintOutside = (
  context: CanvasRenderingContext2D,
  view: View,
  { limit, points, offsets }: CutOffPicture,
  color: string,
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
  context.strokeStyle = color;
  context.lineWidth = LINE_PX;
  context.stroke();
  context.restore();
};
