/** The basic shapes of the CSS property `clip-path` (CSS Shapes 1, §3): circle, ellipse, inset, polygon, path. */
import { translation } from "../../../geometry/affine.js";
import type { Box } from "../../../geometry/box.js";
import { drawEllipse } from "../../arc.js";
import { drawPathData } from "../../path-data.js";
import { ShapeBuffer } from "../../shape-buffer.js";
import { basisOfBox, lengthPx, type LengthBasis, type Side } from "../css/length.js";
import { originOf } from "../css/transform.js";

/** Max error of an arc, as a share of the reference box's diagonal. */
const ARC_TOLERANCE = 1e-6;
const FUNCTION = /^([a-z]+)\((.*)\)$/s;
const RULE = /^(nonzero|evenodd)\s*,\s*/;

interface CssClipShape {
  readonly shape: ShapeBuffer;
  readonly evenOdd: boolean;
}

/** The name of the reference box in a value of `clip-path`, and the shape without it. */
export function splitReferenceBox(value: string): { readonly shape: string; readonly isViewBox: boolean } {
  const shape = value.replace(/\b(view|fill|stroke|border|padding|content|margin)-box\b/g, "").trim();
  return { shape, isViewBox: /\bview-box\b/.test(value) };
}

/** The shape in user units, inside the reference box; null if it is malformed or not supported. */
export function cssClipShape(text: string, box: Box, outer: LengthBasis): CssClipShape | null {
  const [, name, body] = FUNCTION.exec(text) ?? ["", "", ""];
  const rule = RULE.exec(body)?.[1];
  const args = body.replace(RULE, "").trim();
  const basis = basisOfBox(outer, box);
  const shape = new ShapeBuffer();
  const tolerance = ARC_TOLERANCE * Math.hypot(basis.viewportWidth, basis.viewportHeight);
  const isDrawn = draw(name, args, { shape, box, basis, tolerance });
  shape.finish();
  return isDrawn ? { shape, evenOdd: rule === "evenodd" } : null;
}

interface Target {
  readonly shape: ShapeBuffer;
  readonly box: Box;
  /** Percentages refer to the box. */
  readonly basis: LengthBasis;
  /** Tolerance of arcs, in user units. */
  readonly tolerance: number;
}

function draw(name: string, args: string, target: Target): boolean {
  switch (name) {
    case "circle":
    case "ellipse":
      return drawRound(name, args, target);
    case "inset":
      return drawInset(args, target);
    case "polygon":
      return drawPolygon(args, target);
    case "path":
      return drawPath(args, target);
    default:
      return false;
  }
}

function drawPath(args: string, { shape, box, tolerance }: Target): boolean {
  const path = new ShapeBuffer();
  const fault = drawPathData(path, args.replace(/^["']|["']$/g, ""), tolerance);
  path.finish();
  shape.append(path, translation(box.x0, box.y0));
  return fault < 0;
}

function drawRound(
  name: "circle" | "ellipse",
  args: string,
  { shape, box, basis, tolerance }: Target,
): boolean {
  const [, radii, position = "center"] = /^(.*?)(?:(?:^|\s+)at\s+(.*))?$/s.exec(args) ?? [];
  const origin = position.split(/\s+/).length > 2 ? null : originOf(position, basis);
  if (origin === null) return false;
  const [cx, cy] = [box.x0 + origin.x, box.y0 + origin.y];
  const across = [Math.abs(cx - box.x0), Math.abs(box.x1 - cx)];
  const down = [Math.abs(cy - box.y0), Math.abs(box.y1 - cy)];
  const isCircle = name === "circle";
  const radius = (text: string, side: Side, sides: readonly number[]): number | null => {
    if (text === "closest-side") return Math.min(...sides);
    return text === "farthest-side" ? Math.max(...sides) : lengthPx(text, basis, side);
  };
  const [first, second = first] = radii.split(/\s+/).map((part) => (part === "" ? "closest-side" : part));
  const rx = radius(first, isCircle ? "both" : "width", isCircle ? [...across, ...down] : across);
  const ry = isCircle ? rx : radius(second, "height", down);
  if (rx === null || ry === null || rx < 0 || ry < 0) return false;
  if (rx > 0 && ry > 0) drawEllipse(shape, cx, cy, rx, ry, tolerance);
  return true;
}

/** Distances from the sides, as in `margin`. Round corners are not supported. */
function drawInset(args: string, { shape, box, basis }: Target): boolean {
  const [top, right = top, bottom = top, left = right] = args.split(/\s+/);
  const [y0, x1, y1, x0] = [top, right, bottom, left].map((text, i) =>
    lengthPx(text, basis, i % 2 === 0 ? "height" : "width"),
  );
  if (x0 === null || x1 === null || y0 === null || y1 === null || args.includes("round")) return false;
  if (box.x0 + x0 >= box.x1 - x1 || box.y0 + y0 >= box.y1 - y1) return true;
  shape.rectangle(box.x0 + x0, box.y0 + y0, box.x1 - x1, box.y1 - y1);
  return true;
}

function drawPolygon(args: string, { shape, box, basis }: Target): boolean {
  const points = args.split(",").map((pair) => {
    const [x = "", y = "", ...rest] = pair.trim().split(/\s+/);
    return rest.length > 0 ? [null] : [lengthPx(x, basis, "width"), lengthPx(y, basis, "height")];
  });
  for (const [x, y = null] of points) {
    if (x === null || y === null) return false;
    if (shape.isEmpty) shape.moveTo(box.x0 + x, box.y0 + y);
    else shape.lineTo(box.x0 + x, box.y0 + y);
  }
  shape.close();
  return true;
}
