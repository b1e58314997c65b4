/** Converts elements to outlines in user units, and finds their place on the page. */
import { applyX, applyY, largestScale } from "../../geometry/affine.js";
import type { Box } from "../../geometry/box.js";
import { drawBasicShape, type LengthName, type ShapeSource } from "./basic-shapes.js";
import type { Property } from "./properties.js";
import type { Declared } from "./declared.js";
import { isFontLength, lengthPx, type Side } from "./length.js";
import { mapBox } from "../map-box.js";
import { ShapeBuffer } from "../shape-buffer.js";
import type { Context } from "./svg-context.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import { declaredValue } from "./style.js";
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
    const source = new ElementSource(this.tree, element, declared, context);
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
    return new ElementSource(this.tree, element, declared, context).length(name, side);
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

/** The numbers of one element. */
class ElementSource implements ShapeSource {
  /** The element's last length that could not be read. */
  malformed: string | null = null;
  /** The element's last length in ex or ch. */
  fontLength: string | null = null;

  constructor(
    private readonly tree: SvgTree,
    private readonly element: number,
    private readonly declared: Declared,
    private readonly context: Context,
  ) {}

  length(name: LengthName, side: Side): number | null {
    return this.px(this.css(name) ?? attribute(this.tree, this.element, name), side);
  }

  attributeLength(name: "x1" | "y1" | "x2" | "y2", side: Side): number | null {
    return this.px(attribute(this.tree, this.element, name), side);
  }

  text(name: "d" | "points"): string | undefined {
    const path = name === "d" ? this.css("d") : undefined;
    if (path === "none") return "";
    const quoted = path === undefined ? null : /^path\(\s*["'](.*)["']\s*\)$/s.exec(path);
    return quoted?.[1] ?? attribute(this.tree, this.element, name);
  }

  private px(text: string | undefined, side: Side): number | null {
    if (text === undefined || text === "auto") return null;
    const length = lengthPx(text, this.context.basis, side);
    if (length === null) this.malformed = text.slice(0, 40);
    else if (isFontLength(text)) this.fontLength = text.trim();
    return length;
  }

  private css(name: Property): string | undefined {
    return declaredValue(this.context.style, this.declared, name);
  }
}
