/** Transforms of elements, from the `transform` attribute and CSS properties, as one affine map in user units. */
import {
  compose,
  IDENTITY,
  isFiniteAffine,
  mapAround,
  rotation,
  scaling,
  translation,
  type Affine,
} from "../../../geometry/affine.js";
import type { Box } from "../../../geometry/box.js";
import type { Declared } from "./properties.js";
import { absolutePx, basisOfBox, lengthPx, splitLength, type LengthBasis } from "./length.js";
import { declaredValue, type Style } from "./style.js";
import { RAD_PER_DEG } from "../../../units.js";

const FUNCTION = /\s*,?\s*([a-zA-Z]+)\s*\(([^()]*)\)\s*/y;
const ANGLES: Readonly<Record<string, number>> = {
  "": RAD_PER_DEG,
  deg: RAD_PER_DEG,
  rad: 1,
  grad: Math.PI / 200,
  turn: 2 * Math.PI,
};

/** Converts percentages of a translation to px, if there is a `basis`. */
function inPx(name: string, args: readonly string[], basis: LengthBasis | null): readonly string[] {
  return args.map((arg, i) => {
    if (basis === null || !arg.endsWith("%")) return arg;
    const side = i === 0 && name !== "translatey" ? "width" : "height";
    return String(lengthPx(arg, basis, side) ?? arg);
  });
}

/** Identity for "none" or blank text; null if any part is malformed (then the whole transform is ignored). */
export function parseTransform(text: string, basis: LengthBasis | null = null): Affine | null {
  if (text === "none" || text.trim() === "") return IDENTITY;
  let map = IDENTITY;
  FUNCTION.lastIndex = 0;
  while (FUNCTION.lastIndex < text.length) {
    const match = FUNCTION.exec(text);
    if (match === null) return null;
    if (/,\s*,|^\s*,|,\s*$/.test(match[2])) return null;
    const name = match[1].toLowerCase();
    const args = splitArguments(match[2]);
    const step = parseFunction(name, name.startsWith("translate") ? inPx(name, args, basis) : args);
    if (step === null) return null;
    map = compose(map, step);
  }
  return isFiniteAffine(map) ? map : null;
}

const ORIGINS: Readonly<Record<string, string>> = {
  left: "0%",
  top: "0%",
  center: "50%",
  right: "100%",
  bottom: "100%",
};
/** Keywords that belong to one axis, in any order. */
const ACROSS = new Set(["left", "right"]);
const DOWN = new Set(["top", "bottom"]);

/**
 * A position as in CSS's `transform-origin`, from the corner of the box that percentages refer to; null if it is
 * malformed.
 */
export function originOf(text: string, basis: LengthBasis): { x: number; y: number } | null {
  const [first, second = "center"] = text.trim().split(/\s+/);
  const isSwapped = DOWN.has(first) || ACROSS.has(second);
  const [across, down] = isSwapped ? [second, first] : [first, second];
  const x = lengthPx(ORIGINS[across] ?? across, basis, "width");
  const y = lengthPx(ORIGINS[down] ?? down, basis, "height");
  return x === null || y === null || DOWN.has(across) || ACROSS.has(down) ? null : { x, y };
}

/**
 * Applies a CSS `transform-origin` to the map; unchanged if the origin is malformed. Percentages refer to
 * `basis`, whose box begins at `corner`.
 */
export function aroundOrigin(
  map: Affine,
  origin: string,
  basis: LengthBasis,
  corner = { x: 0, y: 0 },
): Affine {
  const place = originOf(origin, basis);
  if (place === null) return map;
  const moved = mapAround(corner.x + place.x, corner.y + place.y, map);
  return isFiniteAffine(moved) ? moved : map;
}

/**
 * An element's own transform: the attribute or CSS property, CSS's individual transforms, and their origin.
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
  const basis = box === null ? outer : basisOfBox(outer, box);
  const separate = parseTransform(steps.join(" "), basis);
  const own = parseTransform(text ?? "", basis);
  if (separate === null || own === null) return null;
  const map = compose(separate, own);
  const origin = declaredValue(style, declared, "transform-origin");
  if (origin === undefined && box === null) return map;
  return aroundOrigin(map, origin ?? "0 0", basis, { x: box?.x0 ?? 0, y: box?.y0 ?? 0 });
}

/** Numbers may be written without separators, as in path data: "1-2.5.5". */
function splitArguments(text: string): string[] {
  return text.match(/[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?:[a-zA-Z]+|%)?|[^\s,]+/g) ?? [];
}

function parseFunction(name: string, args: readonly string[]): Affine | null {
  const n = args.length;
  switch (name) {
    case "matrix":
      return n === 6 ? matrix(args) : null;
    case "translate":
      return n === 1 || n === 2 ? lengths(args, (x, y = 0) => translation(x, y)) : null;
    case "translatex":
      return n === 1 ? lengths(args, (x) => translation(x, 0)) : null;
    case "translatey":
      return n === 1 ? lengths(args, (y) => translation(0, y)) : null;
    case "scale":
      return n === 1 || n === 2 ? factors(args, (x, y = x) => scaling(x, y)) : null;
    case "scalex":
      return n === 1 ? factors(args, (x) => scaling(x, 1)) : null;
    case "scaley":
      return n === 1 ? factors(args, (y) => scaling(1, y)) : null;
    case "rotate":
      return n === 1 || n === 3 ? rotate(args) : null;
    case "skewx":
      return n === 1 ? skew(args[0], "0") : null;
    case "skewy":
      return n === 1 ? skew("0", args[0]) : null;
    case "skew":
      return n === 1 || n === 2 ? skew(args[0], args[1] ?? "0") : null;
    default:
      return null;
  }
}

function matrix(args: readonly string[]): Affine | null {
  const [a, b, c, d, e, f] = args.map(Number);
  const map = { a, b, c, d, e, f };
  return isFiniteAffine(map) ? map : null;
}

function lengths(args: readonly string[], make: (x: number, y?: number) => Affine): Affine | null {
  const px = args.map(absolutePx);
  return px.includes(null) ? null : make(...(px as [number, number?]));
}

function factors(args: readonly string[], make: (x: number, y?: number) => Affine): Affine | null {
  const values = args.map((arg) => (arg.endsWith("%") ? Number(arg.slice(0, -1)) / 100 : Number(arg)));
  return values.every(Number.isFinite) ? make(...(values as [number, number?])) : null;
}

function angleRad(text: string): number | null {
  const parts = splitLength(text);
  if (parts === null) return null;
  const factor = ANGLES[parts.unit];
  return factor === undefined ? null : parts.value * factor;
}

function rotate(args: readonly string[]): Affine | null {
  const angle = angleRad(args[0]);
  if (angle === null) return null;
  if (args.length === 1) return rotation(angle);
  return lengths(args.slice(1), (x, y = 0) => mapAround(x, y, rotation(angle)));
}

function skew(x: string, y: string): Affine | null {
  const ax = angleRad(x);
  const ay = angleRad(y);
  if (ax === null || ay === null) return null;
  return { a: 1, b: Math.tan(ay), c: Math.tan(ax), d: 1, e: 0, f: 0 };
}
