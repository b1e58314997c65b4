/** One leaf element to one shape of the drawing: geometry, paints, dashes. */
import { applyX, applyY, meanScale, type Affine } from "../geometry/affine.js";
import type { Box } from "../geometry/box.js";
import type { DashPattern } from "../drawing/drawing.js";
import { MM_PER_PX } from "../units.js";
import { drawBasicShape, type ShapeSource } from "./basic-shapes.js";
import type { Declared, Property } from "./cascade.js";
import type { DrawingBuilder, Look } from "./drawing-builder.js";
import { mapBox } from "./map-box.js";
import { lengthPx } from "./length.js";
import { polylineLength } from "./shape-length.js";
import { ShapeBuffer } from "./shape-buffer.js";
import type { Context } from "./svg-context.js";
import type { SvgDefinitions } from "./svg-definitions.js";
import { attribute, type SvgTree } from "./svg-tree.js";
import { declaredValue, type Paint } from "./style.js";
import type { Warnings } from "./warnings.js";

export class SvgPainter {
  private readonly shape = new ShapeBuffer();

  constructor(
    private readonly tree: SvgTree,
    private readonly definitions: SvgDefinitions,
    private readonly builder: DrawingBuilder,
    private readonly warnings: Warnings,
    /** mm on the page: how far an arc may be from its cubics. */
    private readonly arcToleranceMm: number,
  ) {}

  drawShape(element: number, tag: string, declared: Declared, context: Context): void {
    const { style } = context;
    if (!style.isVisible) return;
    const shape = this.geometryOf(element, tag, declared, context);
    if (shape.isEmpty) {
      if (shape.lonePoints > 0)
        this.warnings.add("single-point", this.placeOf(context, shape.x, shape.y, 0, 0));
      return;
    }
    const look = this.lookOf(element, tag, declared, context);
    if (look === null) return;
    this.builder.addShape(shape, context.map, look, context.group, context.clip, this.whereOf(element));
  }

  /** The element's outline in user units, in a buffer that the next call uses again. */
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

  drawText(element: number, context: Context): void {
    if (!context.style.isVisible) return;
    const number = (name: string): number => {
      const first = (attribute(this.tree, element, name) ?? "0").trim().split(/[\s,]+/)[0];
      return lengthPx(first, context.basis, name === "x" ? "width" : "height") ?? 0;
    };
    const size = context.style.fontSize;
    this.warnings.add("text-not-drawn", this.placeOf(context, number("x"), number("y") - size, size, size));
  }

  /** The box on the page of a rectangle in user units. */
  placeOf(context: Context, x: number, y: number, width: number, height: number): Box {
    return mapBox(context.map, { x0: x, y0: y, x1: x + width, y1: y + height });
  }

  private firstPoint(context: Context): Box {
    const { coords } = this.shape;
    const [x, y] = coords.length >= 2 ? coords.data : [this.shape.x, this.shape.y];
    const px = applyX(context.map, x, y);
    const py = applyY(context.map, x, y);
    return { x0: px, y0: py, x1: px, y1: py };
  }

  private whereOf(element: number): string {
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

  /** How the shape is painted; null where it is not painted at all. */
  private lookOf(element: number, tag: string, declared: Declared, context: Context): Look | null {
    const { style } = context;
    let stroke = this.colorOf(style.stroke, style.strokeOpacity, context, "gradient-stroke");
    const fill =
      tag === "line" ? null : this.colorOf(style.fill, style.fillOpacity, context, "gradient-fill");
    if (stroke !== null && style.strokeWidth === 0) {
      stroke = null;
      if (fill === null) this.warnings.add("zero-width-stroke", this.firstPoint(context));
    }
    if (stroke === null && fill === null) return null;
    const effect = declaredValue(style, declared, "vector-effect");
    const scale = effect === "non-scaling-stroke" ? MM_PER_PX : meanScale(context.map);
    return {
      stroke,
      fill,
      evenOdd: style.fillRule === "evenodd",
      strokeWidth: stroke === null ? 0 : style.strokeWidth * scale,
      dash: stroke === null || style.dashes === null ? null : this.dashOf(element, context, scale),
    };
  }

  private dashOf(element: number, context: Context, scale: number): DashPattern {
    const { dashes, dashOffset } = context.style;
    const own = Number(attribute(this.tree, element, "pathLength") ?? NaN);
    const unit = own > 0 ? (scale * polylineLength(this.shape)) / own : scale;
    return { lengths: (dashes ?? []).map((length) => length * unit), offset: dashOffset * unit };
  }

  /** "#rrggbb", or null where nothing is painted. */
  private colorOf(
    paint: Paint,
    opacity: number,
    context: Context,
    serverWarning: "gradient-stroke" | "gradient-fill",
  ): string | null {
    if (opacity === 0) return null;
    switch (paint.kind) {
      case "none":
        return null;
      case "color":
        return paint.color.alpha === 0 ? null : paint.color.hex;
      case "currentColor":
        return context.style.color.alpha === 0 ? null : context.style.color.hex;
      case "context":
        return this.colorOf(
          paint.of === "fill" ? context.contextFill : context.contextStroke,
          opacity,
          { ...context, contextFill: NO_PAINT, contextStroke: NO_PAINT },
          serverWarning,
        );
      case "server": {
        const color = this.definitions.serverColor(paint.id, context);
        if (color !== undefined) {
          this.warnings.add(serverWarning, this.firstPoint(context));
          return color;
        }
        if (paint.fallback.kind === "none") this.warnings.add("paint-missing", undefined, `#${paint.id}`);
        return this.colorOf(paint.fallback, opacity, context, serverWarning);
      }
    }
  }
}

const NO_PAINT: Paint = { kind: "none" };

/** Most that the map stretches along an axis; never 0, so that it may divide. */
const largestScale = (map: Affine): number =>
  Math.max(Math.hypot(map.a, map.b), Math.hypot(map.c, map.d), 1e-12);
