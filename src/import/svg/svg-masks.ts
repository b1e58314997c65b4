/**
 * Masks that are plain light shapes, as clips (CSS Masking 1, §6). Drawing programs write these where a clipPath
 * would do. Where a gradient fades, the shape is drawn in full, which is reported. What shows through an
 * image, a text or a line is not cut out; such masks are reported.
 */
import type { Box } from "../../geometry/box.js";
import { compose, IDENTITY } from "../../geometry/affine.js";
import type { ClipNode } from "../clip-node.js";
import { AncestorStyles } from "./ancestor-style.js";
import { SHAPE_TAGS } from "./basic-shapes.js";
import type { Cascade } from "./cascade.js";
import { Declared } from "./declared.js";
import { lengthPx, type LengthBasis, type Side } from "./length.js";
import type { SvgClips } from "./svg-clips.js";
import { withStyle, type Context } from "./svg-context.js";
import { effectsOf } from "./svg-effects.js";
import { attribute, HREF, tagOf, TEXT_NODE, type SvgTree } from "./svg-tree.js";
import { computeStyle, declaredValue, parseUrl, type Style } from "./style.js";

/** A darker shape hides, and a lighter one shows with less contrast. */
const MIN_LUMINANCE = 0.02;
const FULL_LUMINANCE = 0.98;
/** Of gradients and of transparent shapes: somewhere between. */
const FAINT = 0.5;

const PAINTS_NOTHING = new Set([TEXT_NODE, "title", "desc", "metadata", "defs", "style"]);

export interface MaskClip {
  readonly clip: ClipNode | "empty";
  /** Whether the mask also fades, which is not drawn. */
  readonly isFaint: boolean;
}

export class SvgMasks {
  private readonly declared = new Declared();
  private readonly ancestors: AncestorStyles;

  constructor(
    private readonly tree: SvgTree,
    private readonly cascade: Cascade,
    private readonly clips: SvgClips,
  ) {
    this.ancestors = new AncestorStyles(tree, cascade);
  }

  /** The mask of `element` with this `mask` value, inside the context's clip; null if it is no plain mask. */
  clipOf(element: number, value: string | undefined, context: Context): MaskClip | null {
    const { tree, declared } = this;
    const id = value === undefined ? null : parseUrl(value);
    const target = id === null ? undefined : tree.elementById.get(id);
    if (target === undefined || tagOf(tree, target) !== "mask") return null;
    this.cascade.collect(target, declared);
    const style = computeStyle(this.ancestors.outside(target, context.basis), declared, context.basis);
    if (effectsOf(style, declared).length > 0 || declaredValue(style, declared, "clip-path") !== undefined)
      return null;
    const isAlpha = declaredValue(style, declared, "mask-type") === "alpha";
    const light = this.lightOf(target, style, isAlpha, context.basis);
    if (light === null) return null;
    const box = this.clips.boxOf(element, context);
    if (box === null) return null;
    const clip = this.regionOf(target, box, context);
    const isOfBox = attribute(tree, target, "maskContentUnits") === "objectBoundingBox";
    const units = { a: box.x1 - box.x0, b: 0, c: 0, d: box.y1 - box.y0, e: box.x0, f: box.y0 };
    const map = isOfBox ? compose(context.map, units) : context.map;
    const inner = withStyle({ ...context, map }, style, IDENTITY);
    return { clip: this.clips.contentClip(target, inner, clip, "fillRule"), isFaint: light < FULL_LUMINANCE };
  }

  /** The least luminance of the shapes in the mask; null if something in it is no plain light shape. */
  private lightOf(target: number, style: Style, isAlpha: boolean, basis: LengthBasis): number | null {
    const { tree } = this;
    let least = 1;
    for (let child = tree.firstChildren[target]; child >= 0; child = tree.nextSiblings[child]) {
      if (PAINTS_NOTHING.has(tagOf(tree, child))) continue;
      const light = this.lightOfShape(child, style, basis);
      if (light === null || (!isAlpha && light < MIN_LUMINANCE)) return null;
      if (!isAlpha) least = Math.min(least, light);
    }
    return least;
  }

  private lightOfShape(child: number, outer: Style, basis: LengthBasis): number | null {
    const { tree, declared } = this;
    this.cascade.collect(child, declared);
    const style = computeStyle(outer, declared, basis);
    const isHidden = declaredValue(style, declared, "display") === "none" || !style.isVisible;
    if (isHidden) return 1;
    const effects = effectsOf(style, declared);
    if (effects.some(([code]) => code !== "opacity-ignored") || style.stroke.kind !== "none") return null;
    if (tagOf(tree, child) === "use") {
      const shape = tree.elementById.get((attribute(tree, child, HREF) ?? "").trim().slice(1));
      return shape === undefined || tagOf(tree, shape) === "use"
        ? null
        : this.lightOfShape(shape, style, basis);
    }
    const { fill } = style;
    if (!SHAPE_TAGS.has(tagOf(tree, child))) return null;
    if (fill.kind === "server") return this.isGradient(fill.id) ? FAINT : null;
    if (fill.kind !== "color") return null;
    const isFaint = fill.color.alpha * style.fillOpacity < 1 || effects.length > 0;
    return Math.min(luminance(fill.color.hex), isFaint ? FAINT : 1);
  }

  private isGradient(id: string): boolean {
    const server = this.tree.elementById.get(id);
    return server !== undefined && tagOf(this.tree, server).endsWith("Gradient");
  }

  /** The mask's own rectangle. */
  private regionOf(target: number, box: Box, context: Context): ClipNode {
    const isOfPage = attribute(this.tree, target, "maskUnits") === "userSpaceOnUse";
    const [width, height] = [box.x1 - box.x0, box.y1 - box.y0];
    const basis = isOfPage
      ? context.basis
      : { ...context.basis, viewportWidth: width, viewportHeight: height };
    const length = (name: string, side: Side, normal: string): number => {
      const text = attribute(this.tree, target, name) ?? normal;
      const isShare = !isOfPage && !text.includes("%");
      return lengthPx(isShare ? `${Number(text) * 100}%` : text, basis, side) ?? 0;
    };
    const x = length("x", "width", "-10%") + (isOfPage ? 0 : box.x0);
    const y = length("y", "height", "-10%") + (isOfPage ? 0 : box.y0);
    return this.clips.rectangleClip(
      context,
      x,
      y,
      length("width", "width", "120%"),
      length("height", "height", "120%"),
    );
  }
}

/** Of "#rrggbb", 0 … 1, as masks weigh the colours. */
function luminance(hex: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
