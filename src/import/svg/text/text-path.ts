/** The path of a `textPath`'s letters (SVG 2, §11.8). */
import { SHAPE_TAGS, type SvgGeometry } from "../shapes/basic-shapes.js";
import { drawPathData } from "../../path-data.js";
import { elementTransform } from "../css/transform.js";
import { splitLength, lengthPx } from "../css/length.js";
import { MeasuredPath, type PathPosition } from "../shapes/measured-path.js";
import { curveBox, ShapeBuffer } from "../../shape-buffer.js";
import type { Context } from "../svg-context.js";
import type { SvgFile } from "../svg-file.js";
import { attribute, HREF, tagOf } from "../svg-tree.js";
import { IDENTITY } from "../../../geometry/affine.js";

/** Max error of an arc that letters are placed on, in em. */
const ARC_TOLERANCE = 1e-4;

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
  ) {}

  /** The position of a letter whose middle is this far along; null if it falls off the path and is not drawn. */
  placeOf(middle: number, anchor: Anchor): PathPosition | null {
    const { length, isClosed } = this.path;
    if (!isClosed) return middle < 0 || middle > length ? null : this.path.positionAt(middle);
    const first = this.startOffset + FIRST_OF_LOOP[anchor] * length;
    if (middle < first || middle > first + length) return null;
    return this.path.positionAt(((middle % length) + length) % length);
  }

  /** Where text after the path continues. */
  end(): PathPosition | null {
    return this.path.positionAt(this.path.length);
  }
}

export class SvgTextPaths {
  constructor(
    private readonly file: SvgFile,
    private readonly geometry: SvgGeometry,
  ) {}

  /** The path of a `textPath` element in a text drawn in `context`; null if it has none. */
  of(element: number, context: Context): TextPath | null {
    return this.ownPath(element, context) ?? this.referredPath(element, context);
  }

  /** The path in its own `path` attribute, which applies before a reference. */
  private ownPath(element: number, context: Context): TextPath | null {
    const shape = new ShapeBuffer();
    drawPathData(
      shape,
      attribute(this.file.tree, element, "path") ?? "",
      ARC_TOLERANCE * context.style.fontSize,
    );
    shape.finish();
    const path = new MeasuredPath(shape);
    return path.length > 0 ? new TextPath(path, this.startOffset(element, null, path, context)) : null;
  }

  private referredPath(element: number, context: Context): TextPath | null {
    const { tree } = this.file;
    const href = attribute(tree, element, HREF)?.trim() ?? "";
    const target = href.startsWith("#") ? tree.elementById.get(href.slice(1)) : undefined;
    if (target === undefined || !SHAPE_TAGS.has(tagOf(tree, target))) return null;
    const declared = this.file.cascade.declaredOf(target);
    const outline = this.geometry.geometryOf(target, tagOf(tree, target), declared, context);
    // The shape's own transform applies, but not that of its ancestors.
    const map = elementTransform(context.style, declared, context.basis, () => curveBox(outline)) ?? IDENTITY;
    const shape = new ShapeBuffer();
    shape.append(outline, map);
    const path = new MeasuredPath(shape);
    const own = Number(attribute(tree, target, "pathLength") ?? NaN);
    return new TextPath(path, this.startOffset(element, own > 0 ? own : null, path, context));
  }

  /** @param pathLength the length that the shape declares for itself */
  private startOffset(
    element: number,
    pathLength: number | null,
    path: MeasuredPath,
    context: Context,
  ): number {
    const text = attribute(this.file.tree, element, "startOffset") ?? "0";
    const parts = splitLength(text);
    if (parts?.unit === "%") return (parts.value / 100) * path.length;
    const offset = lengthPx(text, context.basis, "width") ?? 0;
    return pathLength === null ? offset : (offset * path.length) / pathLength;
  }
}
