/**
 * viewBox and preserveAspectRatio: the map from a viewBox into its viewport (SVG 2, §8.2).
 *
 *   viewBox x y w h          viewport W × H
 *   scale  sx = W/w, sy = H/h;  "meet" uses the smaller for both, "slice" the larger, "none" each separately
 *   then the box is aligned to xMin|xMid|xMax, YMin|YMid|YMax of the viewport.
 */
import type { Affine } from "../../geometry/affine.js";

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
