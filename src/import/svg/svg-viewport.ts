/** The viewport of a nested svg or a symbol: its place, its scale and its edge (SVG 2, §8.2). */
import { compose, IDENTITY, translation } from "../../geometry/affine.js";
import type { Declared } from "./declared.js";
import { lengthPx, type Side } from "./length.js";
import type { SvgClips } from "./svg-clips.js";
import { withViewport, type Context } from "./svg-context.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import { declaredValue } from "./style.js";
import { isEmptyViewBox, parseViewBox, viewBoxMap } from "./view-box.js";

/** The context inside `element`, to which `declared` belongs; null if it has no size. */
export function viewportInside(
  tree: SvgTree,
  clips: SvgClips,
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
  const clip = isCut ? clips.rectangleClip(context, x, y, width, height) : context.clip;
  const map = compose(translation(x, y), inner);
  return withViewport({ ...context, clip }, map, box?.width ?? width, box?.height ?? height);
}

/** A negative size is invalid and counts as absent. */
const notNegative = (length: number | null): number | null => (length !== null && length < 0 ? null : length);
