/** The bounding boxes of elements: for transforms about them, and for clips and masks in units of them. */
import { compose, IDENTITY, translation, type Affine } from "../../geometry/affine.js";
import { EMPTY_BOX, isEmptyBox, mapBox, uniteBoxes, type Box } from "../../geometry/box.js";
import { curveBox } from "../shape-buffer.js";
import type { Warnings } from "../warnings.js";
import { lengthPx, type LengthBasis } from "./css/length.js";
import { declaredValue } from "./css/style.js";
import { elementTransform } from "./css/transform.js";
import { withStyle, type Context } from "./svg-context.js";
import type { SvgFile } from "./svg-file.js";
import type { TextPainter } from "./text/text-painter.js";
import { attribute, childrenOf, HREF, tagOf, type SvgTree } from "./svg-tree.js";
import { SHAPE_TAGS, type SvgGeometry } from "./shapes/basic-shapes.js";

/** Max elements measured, in the whole file. */
const MAX_MEASURED = 1_000_000;
/** Max elements still to measure for one box, beyond which copies (`use`) are left out. */
const MAX_PENDING = 16_000;

export class ElementBoxes {
  private measured = 0;

  constructor(
    private readonly file: SvgFile,
    private readonly geometry: SvgGeometry,
    /** Null: the file has no text. */
    private readonly texts: TextPainter | null,
    private readonly warnings: Warnings,
  ) {}

  /** The box of an element's geometry in its own user units; null if it has none, or if there is too much to measure. */
  boxOf(element: number, context: Context): Box | null {
    const { tree } = this.file;
    let box = EMPTY_BOX;
    const pending: { element: number; map: Affine }[] = [{ element, map: IDENTITY }];
    while (pending.length > 0) {
      const { element: at, map } = pending.pop()!;
      if (++this.measured > MAX_MEASURED) {
        this.warnings.add("clip-ignored", undefined, "too many objectBoundingBox clips");
        return null;
      }
      const tag = tagOf(tree, at);
      const declared = this.file.cascade.declaredOf(at);
      const style = this.file.computeStyle(context.style, declared, context.basis);
      if (declaredValue(style, declared, "display") === "none") continue;
      const own = at === element ? IDENTITY : elementTransform(style, declared, context.basis, () => null);
      const inner = own === null || own === IDENTITY ? map : compose(map, own);
      if (SHAPE_TAGS.has(tag)) {
        box = uniteBoxes(box, mapBox(inner, curveBox(this.geometry.geometryOf(at, tag, declared, context))));
      } else if (tag === "text") {
        const own = this.texts?.boxOf(at, withStyle(context, style, IDENTITY)) ?? EMPTY_BOX;
        box = uniteBoxes(box, mapBox(inner, own));
      } else if (tag === "use") {
        const { target, shift } = copyOf(tree, at, context.basis);
        if (target !== undefined && pending.length < MAX_PENDING) {
          pending.push({ element: target, map: compose(inner, shift) });
        }
      } else if (tag === "g" || tag === "a" || tag === "svg" || tag === "switch" || tag === "symbol") {
        for (const child of childrenOf(tree, at)) pending.push({ element: child, map: inner });
      }
    }
    return isEmptyBox(box) ? null : box;
  }
}

/** What a `use` refers to, and where it places that. */
export function copyOf(
  tree: SvgTree,
  use: number,
  basis: LengthBasis,
): { target: number | undefined; shift: Affine } {
  const x = lengthPx(attribute(tree, use, "x") ?? "0", basis, "width") ?? 0;
  const y = lengthPx(attribute(tree, use, "y") ?? "0", basis, "height") ?? 0;
  const target = tree.elementById.get((attribute(tree, use, HREF) ?? "").trim().slice(1));
  return { target, shift: translation(x, y) };
}
