/** The path of a `textPath`'s letters (SVG 2, §11.8). */
import type { Cascade } from "./cascade.js";
import { Declared } from "./declared.js";
import { SHAPE_TAGS } from "./basic-shapes.js";
import { splitLength, lengthPx } from "./length.js";
import { MeasuredPath, type PathPlace } from "./measured-path.js";
import { ShapeBuffer } from "../shape-buffer.js";
import type { Context } from "./svg-context.js";
import type { SvgGeometry } from "./svg-geometry.js";
import { attribute, HREF, tagOf, type SvgTree } from "./svg-tree.js";
import { declaredValue } from "./style.js";
import { parseTransform } from "./transform.js";
import { IDENTITY } from "../../geometry/affine.js";

/**
 * Letters may use one full turn of a closed path. It begins at `startOffset`, is centred on it, or ends
 * there, depending on the anchor.
 */
type Anchor = Context["style"]["textAnchor"];
const FIRST_OF_LOOP: Readonly<Record<Anchor, number>> = { start: 0, middle: -0.5, end: -1 };

export class TextPath {
  constructor(
    private readonly path: MeasuredPath,
    /** Distance along the path, in user units. */
    readonly startOffset: number,
    /** Letters are on the other side and run in the opposite direction. */
    private readonly isReversed: boolean,
  ) {}

  /**
   * The position of a letter whose middle is this far along; null if it falls off the path and is not drawn.
   */
  placeOf(middle: number, anchor: Anchor): PathPlace | null {
    const { length, isClosed } = this.path;
    if (!isClosed) return middle < 0 || middle > length ? null : this.placeAt(middle);
    const first = this.startOffset + FIRST_OF_LOOP[anchor] * length;
    if (middle < first || middle > first + length) return null;
    return this.placeAt(((middle % length) + length) % length);
  }

  /** Where text after the path continues. */
  end(): PathPlace | null {
    return this.placeAt(this.path.length);
  }

  private placeAt(along: number): PathPlace | null {
    if (!this.isReversed) return this.path.placeAt(along);
    const place = this.path.placeAt(this.path.length - along);
    return place === null ? null : { ...place, angle: place.angle + Math.PI };
  }
}

export class SvgTextPaths {
  private readonly declared = new Declared();

  constructor(
    private readonly tree: SvgTree,
    private readonly cascade: Cascade,
    private readonly geometry: SvgGeometry,
  ) {}

  /** The path of a `textPath` element in a text drawn in `context`; null if it refers to no shape. */
  of(element: number, context: Context): TextPath | null {
    const { tree, declared } = this;
    const href = attribute(tree, element, HREF)?.trim() ?? "";
    const target = href.startsWith("#") ? tree.elementById.get(href.slice(1)) : undefined;
    if (target === undefined || !SHAPE_TAGS.has(tagOf(tree, target))) return null;
    this.cascade.collect(target, declared);
    const outline = this.geometry.geometryOf(target, tagOf(tree, target), declared, context);
    // The shape's own transform applies, but not that of its ancestors.
    const map = parseTransform(declaredValue(context.style, declared, "transform") ?? "") ?? IDENTITY;
    const shape = new ShapeBuffer();
    shape.append(outline, map);
    const path = new MeasuredPath(shape);
    const isReversed = attribute(tree, element, "side")?.trim() === "right";
    return new TextPath(path, this.startOffset(element, target, path, context), isReversed);
  }

  private startOffset(element: number, target: number, path: MeasuredPath, context: Context): number {
    const text = attribute(this.tree, element, "startOffset") ?? "0";
    const parts = splitLength(text);
    if (parts?.unit === "%") return (parts.value / 100) * path.length;
    const offset = lengthPx(text, context.basis, "width") ?? 0;
    const own = Number(attribute(this.tree, target, "pathLength") ?? NaN);
    return own > 0 ? (offset * path.length) / own : offset;
  }
}
