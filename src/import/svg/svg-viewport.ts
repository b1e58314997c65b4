/**
 * Viewports: viewBox and preserveAspectRatio, and the place, scale and edge of a nested svg or a symbol (SVG 2, §8.2).
 *
 *   viewBox x y w h          viewport W × H
 *   scale  sx = W/w, sy = H/h;  "meet" uses the smaller for both, "slice" the larger, "none" each separately
 *   then the box is aligned to xMin|xMid|xMax, YMin|YMid|YMax of the viewport.
 */
import { compose, IDENTITY, translation, type Affine } from "../../geometry/affine.js";
import { lengthPx, type Side } from "./css/length.js";
import type { Declared } from "./css/properties.js";
import { withViewport, type Context } from "./svg-context.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import { declaredValue } from "./css/style.js";
import { rectangleClip } from "../clip-node.js";

interface ViewBox {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Null if it is absent, malformed or has no area. */
export function parseViewBox(text: string | undefined): ViewBox | null {
  if (text === undefined) return null;
  const numbers = text
    .trim()
    .split(/[\s,]+/)
    .map(Number);
  if (numbers.length !== 4 || !numbers.every(Number.isFinite)) return null;
  const [x, y, width, height] = numbers;
  return width > 0 && height > 0 ? { x, y, width, height } : null;
}

/** A size of 0 disables drawing; a negative or malformed size counts as absent. */
export function isEmptyViewBox(text: string | undefined): boolean {
  const [, , width, height] = (text ?? "")
    .trim()
    .split(/[\s,]+/)
    .map(Number);
  return (width === 0 && height >= 0) || (height === 0 && width >= 0);
}

const ALIGN = /^\s*(?:defer\s+)?(none|x(Min|Mid|Max)Y(Min|Mid|Max))(?:\s+(meet|slice))?\s*$/;
const SHARE: Readonly<Record<string, number>> = { Min: 0, Mid: 0.5, Max: 1 };

/** Maps viewBox coordinates to a viewport of the given size with its corner at 0, 0. */
export function viewBoxMap(box: ViewBox, width: number, height: number, aspect: string | undefined): Affine {
  const match = ALIGN.exec(aspect ?? "") ?? ALIGN.exec("xMidYMid meet")!;
  const sx = width / box.width;
  const sy = height / box.height;
  if (match[1] === "none") return { a: sx, b: 0, c: 0, d: sy, e: -box.x * sx, f: -box.y * sy };
  const scale = match[4] === "slice" ? Math.max(sx, sy) : Math.min(sx, sy);
  const freeX = width - box.width * scale;
  const freeY = height - box.height * scale;
  return {
    a: scale,
    b: 0,
    c: 0,
    d: scale,
    e: freeX * SHARE[match[2]] - box.x * scale,
    f: freeY * SHARE[match[3]] - box.y * scale,
  };
}

/** The context inside `element`, to which `declared` belongs; null if it has no size. */
export function viewportInside(
  tree: SvgTree,
  element: number,
  declared: Declared,
  context: Context,
): Context | null {
  // As in browsers, the attributes apply and CSS does not.
  const length = (name: "x" | "y" | "width" | "height", side: Side): number | null =>
    lengthPx(attribute(tree, element, name) ?? "", context.basis, side);
  const x = length("x", "width") ?? 0;
  const y = length("y", "height") ?? 0;
  const useSize = context.uses?.target === element ? context.uses.size : null;
  const width = useSize?.width ?? notNegative(length("width", "width")) ?? context.basis.viewportWidth;
  const height = useSize?.height ?? notNegative(length("height", "height")) ?? context.basis.viewportHeight;
  const viewBox = attribute(tree, element, "viewBox");
  if (!(width > 0 && height > 0) || isEmptyViewBox(viewBox)) return null;
  const box = parseViewBox(viewBox);
  const inner =
    box === null ? IDENTITY : viewBoxMap(box, width, height, attribute(tree, element, "preserveAspectRatio"));
  const overflow = declaredValue(context.style, declared, "overflow");
  const isCut = overflow !== "visible" && overflow !== "auto";
  const clip = isCut
    ? rectangleClip(context.clip, context.map, { x0: x, y0: y, x1: x + width, y1: y + height })
    : context.clip;
  const map = compose(translation(x, y), inner);
  return withViewport({ ...context, clip }, map, box?.width ?? width, box?.height ?? height);
}

/** A negative size is invalid and counts as absent. */
const notNegative = (length: number | null): number | null => (length !== null && length < 0 ? null : length);
