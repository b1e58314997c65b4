/** For formats without a page: the page is the drawing's extent. */
import type { Drawing } from "../drawing/drawing.js";
import type { DrawingBuilder } from "./drawing-builder.js";
import type { Warnings } from "./warnings.js";

/** Min side of the page, mm, so that a drawing of one straight line has a page with an area. */
const SMALLEST_SIDE = 1;

export function finishAroundDrawing(builder: DrawingBuilder, warnings: Warnings): Drawing {
  const box = builder.extent();
  if (builder.shapeCount === 0) return builder.finish(SMALLEST_SIDE, SMALLEST_SIDE);
  builder.translate(-box.x0, -box.y0);
  warnings.translate(-box.x0, -box.y0);
  return builder.finish(Math.max(box.x1 - box.x0, SMALLEST_SIDE), Math.max(box.y1 - box.y0, SMALLEST_SIDE));
}
