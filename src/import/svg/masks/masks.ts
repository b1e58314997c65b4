/**
 * Masks as clips (CSS Masking 1, §6). Drawing programs write masks where a clipPath would do. The content of the
 * mask is drawn apart and becomes a region. Where it only fades, the shape is drawn in full, which is reported.
 * Masks of pictures, patterns, filters and other masks are reported and not applied.
 */
import type { Box } from "../../../geometry/box.js";
import { compose, IDENTITY } from "../../../geometry/affine.js";
import { curvesOf, VERB_MOVE } from "../../../drawing/drawing.js";
import { ClipNode, type ClipShapes, rectangleClip } from "../../clip-node.js";
import { getOrAdd } from "../../../get-or-add.js";
import { basisOfBox, lengthPx, type Side } from "../css/length.js";
import type { ElementBoxes } from "../element-boxes.js";
import { boxUnits } from "./clips.js";
import { withStyle, type Context, contentKey } from "../svg-context.js";
import { effectsOf } from "../svg-effects.js";
import type { SvgFile } from "../svg-file.js";
import { attribute, tagOf } from "../svg-tree.js";
import { declaredValue, parseUrl } from "../css/style.js";
import { ClipType, FillRule, type Paths64 } from "clipper2-ts/dist/Core.js";
import { ClipperOffset, EndType, JoinType } from "clipper2-ts/dist/Offset.js";
import { cleanRings, combine, SCALE } from "../../../geometry/region.js";
import type { ReadDrawing, WarningCode } from "../../warnings.js";
import { clipShapesOf, outlinesOf, ringsOf } from "./clip-shapes.js";

/** Max elements and coordinates drawn in masks, in the whole file: masks may be used many times. */
const MAX_MASK_WORK = 2_000_000;
/** Cost of combining one shape with the others, in coordinates. Each use of a mask costs the same. */
const WORK_PER_SHAPE = 100;

export interface MaskClip {
  readonly clip: ClipNode | "empty";
  /** Whether the mask also fades, which is not drawn. */
  readonly isFaint: boolean;
}

/** Draws the content of an element and subtracts its cost from `work`; null if it exceeds what is left. */
export type DrawApart = (element: number, context: Context, work: { left: number }) => ReadDrawing | null;

export class SvgMasks {
  private readonly regions = new Map<string, MaskRegion | null>();
  /** The masks that are being drawn, to find those that refer to themselves. */
  private readonly open = new Set<number>();
  private readonly work = { left: MAX_MASK_WORK };

  constructor(
    private readonly file: SvgFile,
    private readonly boxes: ElementBoxes,
  ) {}

  /** The mask of `element` with this `mask` value, inside the context's clip; null if it is not applied. */
  clipOf(
    element: number,
    value: string | undefined,
    context: Context,
    drawApart: DrawApart,
  ): MaskClip | null {
    const { tree } = this.file;
    const id = value === undefined ? null : parseUrl(value);
    const target = id === null ? undefined : tree.elementById.get(id);
    if (target === undefined || tagOf(tree, target) !== "mask" || this.open.has(target)) return null;
    const declared = this.file.cascade.declaredOf(target);
    const style = this.file.computeStyle(
      this.file.styleAround(target, context.basis),
      declared,
      context.basis,
    );
    if (
      effectsOf(style, declared, this.file.parseColor).length > 0 ||
      declaredValue(style, declared, "clip-path") !== undefined
    )
      return null;
    const isAlpha = declaredValue(style, declared, "mask-type") === "alpha";
    const box = this.boxes.boxOf(element, context);
    if (box === null) return null;
    const outside = this.regionOf(target, box, context);
    const isOfBox = attribute(tree, target, "maskContentUnits") === "objectBoundingBox";
    const map = isOfBox ? compose(context.map, boxUnits(box)) : context.map;
    const inside = { ...context, map, group: -1, clip: null, uses: null };
    const region = this.contentOf(target, withStyle(inside, style, IDENTITY), isAlpha, drawApart);
    if (region === null) return null;
    const { shapes, isFaint } = region;
    return { clip: shapes === null ? "empty" : new ClipNode(outside, shapes), isFaint };
  }

  private contentOf(
    target: number,
    context: Context,
    isAlpha: boolean,
    drawApart: DrawApart,
  ): MaskRegion | null {
    return getOrAdd(this.regions, contentKey(target, context), () => {
      this.open.add(target);
      const content = drawApart(target, context, this.work);
      this.open.delete(target);
      this.work.left -= WORK_PER_SHAPE * (1 + (content?.paths.count ?? 0));
      return content === null ? null : maskRegion(content, isAlpha);
    });
  }

  /** The mask's own rectangle. */
  private regionOf(target: number, box: Box, context: Context): ClipNode {
    const isOfPage = attribute(this.file.tree, target, "maskUnits") === "userSpaceOnUse";
    const basis = isOfPage ? context.basis : basisOfBox(context.basis, box);
    const length = (name: string, side: Side, normal: string): number => {
      const text = attribute(this.file.tree, target, name) ?? normal;
      const isShare = !isOfPage && !text.includes("%");
      return lengthPx(isShare ? `${Number(text) * 100}%` : text, basis, side) ?? 0;
    };
    const x = length("x", "width", "-10%") + (isOfPage ? 0 : box.x0);
    const y = length("y", "height", "-10%") + (isOfPage ? 0 : box.y0);
    const x1 = x + length("width", "width", "120%");
    const y1 = y + length("height", "height", "120%");
    return rectangleClip(context.clip, context.map, { x0: x, y0: y, x1, y1 });
  }
}

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

interface MaskRegion {
  /** Null if the mask hides everything. */
  readonly shapes: ClipShapes | null;
  /** Whether the mask also fades, which is not drawn. */
  readonly isFaint: boolean;
}

/**
 * The region that a mask shows (CSS Masking 1, §6), from the drawing of its content: light shapes and lines add
 * to it, and black ones on top of them cut holes.
 *
 * @returns null if something in the mask is neither a plain shape nor a plain line
 */
function maskRegion(content: ReadDrawing, isAlpha: boolean): MaskRegion | null {
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
function wholeShapes({ paths }: ReadDrawing): ClipShapes {
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
function combined({ paths, clips }: ReadDrawing, isLight: (color: number) => boolean): Paths64 {
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
