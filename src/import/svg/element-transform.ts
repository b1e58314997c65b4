/**
 * An element's own transform: the attribute or CSS property, CSS's individual transforms, and their origin.
 */
import { compose, IDENTITY, type Affine } from "../../geometry/affine.js";
import type { Box } from "../../geometry/box.js";
import type { Declared } from "./declared.js";
import type { LengthBasis } from "./length.js";
import { declaredValue, type Style } from "./style.js";
import { aroundOrigin, parseTransform } from "./transform.js";

/**
 * Null if it is malformed. `boxOf` gives the shape's own box in user units; null for none. Percentages refer
 * to that box if `transform-box` asks for it, otherwise to the viewport.
 */
export function elementTransform(
  style: Style,
  declared: Declared,
  outer: LengthBasis,
  boxOf: () => Box | null,
): Affine | null {
  const steps = (["translate", "rotate", "scale"] as const).flatMap((name) => {
    const value = declaredValue(style, declared, name);
    return value === undefined || value === "none" ? [] : [`${name}(${value.trim().replace(/\s+/g, ",")})`];
  });
  const text = declaredValue(style, declared, "transform");
  if (text === undefined && steps.length === 0) return IDENTITY;
  const boxName = declaredValue(style, declared, "transform-box");
  const box = boxName === undefined || boxName === "view-box" ? null : boxOf();
  const basis =
    box === null ? outer : { ...outer, viewportWidth: box.x1 - box.x0, viewportHeight: box.y1 - box.y0 };
  const separate = parseTransform(steps.join(" "), basis);
  const own = parseTransform(text ?? "", basis);
  if (separate === null || own === null) return null;
  const map = compose(separate, own);
  const origin = declaredValue(style, declared, "transform-origin");
  if (origin === undefined && box === null) return map;
  return aroundOrigin(map, origin ?? "0 0", basis, { x: box?.x0 ?? 0, y: box?.y0 ?? 0 });
}
