/** Elements to outlines in user units, and where they are on the page. */
import { applyX, applyY, type Affine } from "../geometry/affine.js";
import type { Box } from "../geometry/box.js";
import { drawBasicShape, type ShapeSource } from "./basic-shapes.js";
import type { Declared, Property } from "./cascade.js";
import { lengthPx } from "./length.js";
import { mapBox } from "./map-box.js";
import { ShapeBuffer } from "./shape-buffer.js";
import type { Context } from "./svg-context.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import { declaredValue } from "./style.js";
import type { Warnings } from "./warnings.js";

export class SvgGeometry {
  /** The outline made last. */
  readonly shape = new ShapeBuffer();

  constructor(
    private readonly tree: SvgTree,
    private readonly warnings: Warnings,
    /** mm on the page: how far an arc may be from its cubics. */
    private readonly arcToleranceMm: number,
  ) {}

  /** The element's outline in user units, in `shape`, which the next call uses again. */
  geometryOf(element: number, tag: string, declared: Declared, context: Context): ShapeBuffer {
    const { shape } = this;
    shape.clear();
    const tolerance = this.arcToleranceMm / largestScale(context.map);
    const fault = drawBasicShape(tag, this.sourceOf(element, declared, context), shape, tolerance);
    shape.finish();
    if (fault !== null) {
      const where = this.whereOf(element);
      if (tag === "path") this.warnings.add("path-data", this.firstPoint(context), `${where}: ${fault}`);
      else this.warnings.add("attribute-fault", this.firstPoint(context), `${tag} at ${where}: ${fault}`);
    }
    return shape;
  }

  /** The box on the page of a rectangle in user units. */
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

  private sourceOf(element: number, declared: Declared, context: Context): ShapeSource {
    const { tree } = this;
    const { basis, style } = context;
    const length = (text: string | undefined, side: "width" | "height" | "both"): number | null =>
      text === undefined || text === "auto" ? null : lengthPx(text, basis, side);
    const css = (name: Property): string | undefined =>
      declared.size === 0 ? undefined : declaredValue(style, declared, name);
    return {
      length: (name, side) => length(css(name) ?? attribute(tree, element, name), side),
      attributeLength: (name, side) => length(attribute(tree, element, name), side),
      text: (name) => {
        if (name === "points") return attribute(tree, element, name);
        const path = css("d");
        const quoted = path === undefined ? null : /^path\(\s*["'](.*)["']\s*\)$/s.exec(path);
        return quoted?.[1] ?? attribute(tree, element, name);
      },
    };
  }
}

/** Most that the map stretches along an axis; never 0, so that it may divide. */
const largestScale = (map: Affine): number =>
  Math.max(Math.hypot(map.a, map.b), Math.hypot(map.c, map.d), 1e-12);
