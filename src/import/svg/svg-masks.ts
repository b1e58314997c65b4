/**
 * Masks as clips (CSS Masking 1, §6). Drawing programs write masks where a clipPath would do. The content of the
 * mask is drawn apart and becomes a region. Where it only fades, the shape is drawn in full, which is reported.
 * Masks of pictures, patterns, filters and other masks are reported and not applied.
 */
import type { Box } from "../../geometry/box.js";
import { compose, IDENTITY } from "../../geometry/affine.js";
import type { Drawing } from "../../drawing/drawing.js";
import { ClipNode } from "../clip-node.js";
import { getOrAdd } from "../get-or-add.js";
import { basisOfBox, lengthPx, type Side } from "./length.js";
import { maskRegion, type MaskRegion } from "./mask-region.js";
import { boxUnits, type SvgClips } from "./svg-clips.js";
import { withStyle, type Context } from "./svg-context.js";
import { effectsOf } from "./svg-effects.js";
import type { SvgFile } from "./svg-file.js";
import { attribute, tagOf } from "./svg-tree.js";
import { computeStyle, declaredValue, parseUrl } from "./style.js";

/** Max elements and coordinates drawn in masks, in the whole file: masks may be used many times. */
const MAX_MASK_WORK = 2_000_000;
/** Cost of combining one shape with the others, in coordinates. Each use of a mask costs the same. */
const WORK_PER_SHAPE = 100;

interface MaskClip {
  readonly clip: ClipNode | "empty";
  /** Whether the mask also fades, which is not drawn. */
  readonly isFaint: boolean;
}

/** Draws the content of an element and subtracts its cost from `work`; null if it exceeds what is left. */
export type DrawApart = (element: number, context: Context, work: { left: number }) => Drawing | null;

export class SvgMasks {
  private readonly regions = new Map<string, MaskRegion | null>();
  /** The masks that are being drawn, to find those that refer to themselves. */
  private readonly open = new Set<number>();
  private readonly work = { left: MAX_MASK_WORK };

  constructor(
    private readonly file: SvgFile,
    private readonly clips: SvgClips,
    private readonly drawApart: DrawApart,
  ) {}

  /** The mask of `element` with this `mask` value, inside the context's clip; null if it is not applied. */
  clipOf(element: number, value: string | undefined, context: Context): MaskClip | null {
    const { tree } = this.file;
    const id = value === undefined ? null : parseUrl(value);
    const target = id === null ? undefined : tree.elementById.get(id);
    if (target === undefined || tagOf(tree, target) !== "mask" || this.open.has(target)) return null;
    const declared = this.file.cascade.declaredOf(target);
    const style = computeStyle(this.file.styleAround(target, context.basis), declared, context.basis);
    if (effectsOf(style, declared).length > 0 || declaredValue(style, declared, "clip-path") !== undefined)
      return null;
    const isAlpha = declaredValue(style, declared, "mask-type") === "alpha";
    const box = this.clips.boxOf(element, context);
    if (box === null) return null;
    const outside = this.regionOf(target, box, context);
    const isOfBox = attribute(tree, target, "maskContentUnits") === "objectBoundingBox";
    const map = isOfBox ? compose(context.map, boxUnits(box)) : context.map;
    const inside = { ...context, map, group: -1, clip: null, uses: null };
    const region = this.contentOf(target, withStyle(inside, style, IDENTITY), isAlpha);
    if (region === null) return null;
    const { shapes, isFaint } = region;
    return { clip: shapes === null ? "empty" : new ClipNode(outside, shapes), isFaint };
  }

  private contentOf(target: number, context: Context, isAlpha: boolean): MaskRegion | null {
    const { a, b, c, d, e, f } = context.map;
    const key = `${target} ${a} ${b} ${c} ${d} ${e} ${f}`;
    return getOrAdd(this.regions, key, () => {
      this.open.add(target);
      const content = this.drawApart(target, context, this.work);
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
    return this.clips.rectangleClip(
      context,
      x,
      y,
      length("width", "width", "120%"),
      length("height", "height", "120%"),
    );
  }
}
