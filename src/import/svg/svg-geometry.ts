/** Converts elements to outlines in user units, and finds their place on the page. */
import { applyX, applyY, largestScale } from "../../geometry/affine.js";
import { mapBox, type Box } from "../../geometry/box.js";
import { drawBasicShape, ShapeSource, type LengthName } from "./basic-shapes.js";
import type { Declared } from "./properties.js";
import type { Side } from "./length.js";
import { ShapeBuffer } from "../shape-buffer.js";
import type { Context } from "./svg-context.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import type { Warnings } from "../warnings.js";

export class SvgGeometry {
  /** The latest outline. */
  readonly shape = new ShapeBuffer();

  constructor(
    private readonly tree: SvgTree,
    private readonly warnings: Warnings,
    /** mm on the page: max distance between an arc and its cubics. */
    private readonly arcToleranceMm: number,
  ) {}

  /** Draws the element's outline in user units into `shape`, which the next call reuses. */
  geometryOf(element: number, tag: string, declared: Declared, context: Context): ShapeBuffer {
    const { shape } = this;
    shape.clear();
    const tolerance = this.arcToleranceMm / largestScale(context.map);
    const source = new ShapeSource(this.tree, element, declared, context);
    const drawn = drawBasicShape(tag, source, shape, tolerance);
    shape.finish();
    const fault = drawn ?? (source.malformed === null ? null : `"${source.malformed}" is not a length`);
    if (fault !== null) {
      const where = this.whereOf(element);
      if (tag === "path") this.warnings.add("path-data", this.firstPoint(context), `${where}: ${fault}`);
      else this.warnings.add("attribute-fault", this.firstPoint(context), `${tag} at ${where}: ${fault}`);
    }
    if (source.fontLength !== null)
      this.warnings.add("length-approximate", this.firstPoint(context), source.fontLength);
    return shape;
  }

  /** A length from CSS or an attribute; null if neither gives one. */
  lengthOf(
    element: number,
    declared: Declared,
    context: Context,
    name: LengthName,
    side: Side,
  ): number | null {
    return new ShapeSource(this.tree, element, declared, context).length(name, side);
  }

  /** The page box of a rectangle in user units. */
  placeOf(context: Context, x: number, y: number, width: number, height: number): Box {
    return mapBox(context.map, { x0: x, y0: y, x1: x + width, y1: y + height });
  }

  firstPoint(context: Context): Box {
    const { coords } = this.shape;
    const [x, y] = coords.length >= 2 ? coords.data : [this.shape.x, this.shape.y];
    const px = applyX(context.map, x, y);
    const py = applyY(context.map, x, y);
    return { x0: px, y0: py, x1: px, y1: py };
  }

  whereOf(element: number): string {
    const id = attribute(this.tree, element, "id");
    const line = `line ${this.tree.lines[element]}`;
    return id === undefined ? line : `${line}, id ${id.slice(0, 40)}`;
  }
}
