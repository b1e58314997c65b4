/**
 * The region that a mask shows (CSS Masking 1, §6), from the drawing of its content: light shapes and lines add
 * to it, and black ones on top of them cut holes.
 */
import { ClipperOffset, ClipType, EndType, FillRule, JoinType, type Paths64 } from "clipper2-ts";
import { curvesOf, VERB_MOVE, type Drawing } from "../../drawing/drawing.js";
import { cleanRings, combine, SCALE } from "../../geometry/region.js";
import type { ClipShapes } from "../clip-node.js";
import type { WarningCode } from "../warnings.js";
import { clipShapesOf, outlinesOf, ringsOf } from "./clip-shapes.js";

/** Below MIN a shape hides; between MIN and FULL it only fades. */
const MIN_LUMINANCE = 0.02;
const FULL_LUMINANCE = 0.98;

/** As in SVG, where a line's corner is cut off. */
const MITER_LIMIT = 4;
/** Max shapes to combine: more are an attack or a mistake. */
const MAX_COMBINED = 500;

/** Warnings about content that only fades. */
const FADES: ReadonlySet<string> = new Set<WarningCode>([
  "opacity-ignored",
  "gradient-fill",
  "gradient-stroke",
]);
/** Warnings about content that draws nothing. */
const HARMLESS: ReadonlySet<string> = new Set<WarningCode>([
  "empty-drawing",
  "single-point",
  "zero-width-stroke",
]);

export interface MaskRegion {
  /** Null if the mask hides everything. */
  readonly shapes: ClipShapes | null;
  /** Whether the mask also fades, which is not drawn. */
  readonly isFaint: boolean;
}

/** @returns null if something in the mask is neither a plain shape nor a plain line */
export function maskRegion(content: Drawing, isAlpha: boolean): MaskRegion | null {
  const { paths, warnings } = content;
  const fades = warnings.some(({ code }) => FADES.has(code));
  if (warnings.some(({ code }) => !FADES.has(code) && !HARMLESS.has(code))) return null;
  const light = content.colors.map((hex) => (isAlpha ? 1 : luminance(hex)));
  const tones = [...paths.fill, ...paths.stroke].filter((color) => color >= 0).map((color) => light[color]);
  const hasDark = tones.some((tone) => tone < MIN_LUMINANCE);
  const isFaint = !isAlpha && tones.some((tone) => tone >= MIN_LUMINANCE && tone < FULL_LUMINANCE);
  const shown = { isFaint: isFaint || fades };
  if (tones.every((tone) => tone < MIN_LUMINANCE)) return { shapes: null, ...shown };
  const isPlain = paths.stroke.every((color) => color < 0) && paths.clip.every((clip) => clip < 0);
  if (isPlain && !hasDark) return { shapes: wholeShapes(content), ...shown };
  // A transparent black shape only fades, and dashes are not cut out.
  const isComplex = (hasDark && fades) || paths.dash.some((dash) => dash >= 0);
  if (isComplex || paths.count > MAX_COMBINED) return null;
  const rings = combined(content, (color) => light[color] >= MIN_LUMINANCE);
  return { shapes: rings.length === 0 ? null : clipShapesOf(rings), ...shown };
}

/** The fills as they are, with their curves. */
function wholeShapes({ paths }: Drawing): ClipShapes {
  const rule: number[] = [];
  const shape: number[] = [];
  for (let i = 0; i < paths.count; i++) {
    for (let v = paths.verbOffsets[i]; v < paths.verbOffsets[i + 1]; v++) {
      if (paths.verbs[v] !== VERB_MOVE) continue;
      rule.push(paths.fillRule[i]);
      shape.push(i);
    }
  }
  const { verbs, coords } = paths;
  return { verbs, coords, rule: Uint8Array.from(rule), shape: Uint32Array.from(shape) };
}

/** Fills and lines in paint order: light ones added, the others taken away. */
function combined({ paths, clips }: Drawing, isLight: (color: number) => boolean): Paths64 {
  let region: Paths64 = [];
  const paint = (rings: Paths64, color: number, clip: number): void => {
    let inside = rings;
    for (let at = clip; at >= 0; at = clips[at].parent) {
      inside = combine(ClipType.Intersection, inside, ringsOf(clips[at]));
    }
    region = combine(isLight(color) ? ClipType.Union : ClipType.Difference, region, inside);
  };
  for (let i = 0; i < paths.count; i++) {
    const outlines = outlinesOf(curvesOf(paths, i));
    if (paths.fill[i] >= 0) {
      const rule = paths.fillRule[i] === 0 ? FillRule.NonZero : FillRule.EvenOdd;
      paint(
        cleanRings(
          outlines.map(({ ring }) => ring),
          rule,
        ),
        paths.fill[i],
        paths.clip[i],
      );
    }
    if (paths.stroke[i] < 0) continue;
    const line = new ClipperOffset(MITER_LIMIT);
    for (const { ring, isClosed } of outlines) {
      line.addPath(ring, JoinType.Miter, isClosed ? EndType.Joined : EndType.Butt);
    }
    const rings: Paths64 = [];
    line.execute((paths.strokeWidth[i] / 2) * SCALE, rings);
    paint(rings, paths.stroke[i], paths.clip[i]);
  }
  return region;
}

/** The luminance of "#rrggbb", 0 … 1, with the weights that masks use. */
function luminance(hex: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
