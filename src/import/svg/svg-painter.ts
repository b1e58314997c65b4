/** Converts one leaf element to one shape of the drawing: geometry, paints, dashes. */
import { meanScale, unstretched } from "../../geometry/affine.js";
import type { Box } from "../../geometry/box.js";
import type { DashPattern } from "../../drawing/drawing.js";
import { MM_PER_PX } from "../../units.js";
import type { Declared, Paint } from "./css/properties.js";
import type { DrawingBuilder, Look } from "../drawing-builder.js";
import { MeasuredPath } from "./shapes/measured-path.js";
import { curveBox } from "../shape-buffer.js";
import { type Context, isMarked } from "./svg-context.js";
import type { SvgFile } from "./svg-file.js";
import { MaskPaintServers, type SvgPaintServers } from "./shapes/paint-servers.js";
import type { SvgGeometry } from "./shapes/basic-shapes.js";
import { attribute } from "./svg-tree.js";
import type { Color } from "../color.js";
import { declaredValue } from "./css/style.js";
import type { Warnings } from "../warnings.js";

export class SvgPainter {
  constructor(
    readonly file: SvgFile,
    readonly geometry: SvgGeometry,
    private readonly servers: SvgPaintServers,
    readonly builder: DrawingBuilder,
    readonly warnings: Warnings,
  ) {}

  /** A painter for the content of a mask. */
  forMask(builder: DrawingBuilder, warnings: Warnings): SvgPainter {
    const { file, geometry } = this;
    return new SvgPainter(file, geometry, new MaskPaintServers(file), builder, warnings);
  }

  drawShape(element: number, tag: string, declared: Declared, context: Context): void {
    const { style } = context;
    if (!style.isVisible) return;
    const shape = this.geometry.geometryOf(element, tag, declared, context);
    if (shape.isEmpty) {
      if (shape.lonePoints > 0 && !isMarked(tag, context))
        this.warnings.add("single-point", this.geometry.placeOf(context, shape.x, shape.y, 0, 0));
      return;
    }
    const look = this.lookOf(element, tag, declared, context);
    if (look !== null) {
      const where = (): string => this.geometry.whereOf(element);
      this.builder.addShape(shape, context.map, look, context.group, context.clip, where);
    }
  }

  /** How the shape is painted; null if it is not painted. */
  private lookOf(element: number, tag: string, declared: Declared, context: Context): Look | null {
    const { style } = context;
    let stroke = this.colorOf(style.stroke, style.strokeOpacity, context, "stroke");
    const fill = tag === "line" ? null : this.colorOf(style.fill, style.fillOpacity, context, "fill");
    if (stroke !== null && style.strokeWidth === 0) {
      stroke = null;
      if (fill === null) this.warnings.add("zero-width-stroke", this.geometry.firstPoint(context));
    }
    if (stroke === null && fill === null) return null;
    const effect = declaredValue(style, declared, "vector-effect");
    const isNonScaling = effect === "non-scaling-stroke";
    const scale = isNonScaling ? MM_PER_PX : meanScale(context.map);
    return {
      stroke,
      fill,
      evenOdd: style.fillRule === "evenodd",
      strokeWidth: stroke === null ? 0 : style.strokeWidth * scale,
      dash:
        stroke === null || style.dashes === null ? null : this.dashOf(element, context, scale, isNonScaling),
      speedFactor: context.speedFactor,
    };
  }

  private dashOf(element: number, context: Context, scale: number, isNonScaling: boolean): DashPattern {
    const { dashes, dashOffset } = context.style;
    const own = Number(attribute(this.file.tree, element, "pathLength") ?? NaN);
    const unit = own > 0 ? (scale * new MeasuredPath(this.geometry.shape).length) / own : scale;
    const measure = isNonScaling ? null : unstretched(context.map);
    return {
      lengths: (dashes ?? []).map((length) => length * unit),
      offset: dashOffset * unit,
      ...(measure === null ? {} : { measure }),
    };
  }

  /** The colour without its transparency; null if nothing is visible. */
  private solid({ hex, alpha }: Color, opacity: number, context: Context): string | null {
    if (alpha === 0) return null;
    if (alpha * opacity < 1) this.warnings.add("opacity-ignored", this.geometry.firstPoint(context));
    return hex;
  }

  /** "#rrggbb", or null if nothing is painted. */
  colorOf(paint: Paint, opacity: number, context: Context, part: "stroke" | "fill"): string | null {
    if (opacity === 0) return null;
    switch (paint.kind) {
      case "none":
        return null;
      case "color":
        return this.solid(paint.color, opacity, context);
      case "currentColor":
        return this.solid(context.style.color, opacity, context);
      case "context":
        return this.colorOf(
          paint.of === "fill" ? context.contextFill : context.contextStroke,
          opacity,
          { ...context, contextFill: NO_PAINT, contextStroke: NO_PAINT },
          part,
        );
      case "server": {
        const { servers, warnings } = this;
        const isFlat = servers.isOfBox(paint.id) && isFlatBox(curveBox(this.geometry.shape));
        const color = isFlat ? undefined : servers.serverColor(paint.id, context);
        if (color === undefined) {
          if (paint.fallback.kind === "none" && !isFlat)
            warnings.add("paint-missing", undefined, `#${paint.id}`);
          return this.colorOf(paint.fallback, opacity, context, part);
        }
        if (color === null) return null;
        const place = this.geometry.firstPoint(context);
        if (servers.isPattern(paint.id)) warnings.add(`pattern-${part}`, place, `"${paint.id}"`);
        else warnings.add(`gradient-${part}`, place);
        return color;
      }
    }
  }
}

const isFlatBox = ({ x0, y0, x1, y1 }: Box): boolean => x0 === x1 || y0 === y1;

const NO_PAINT: Paint = { kind: "none" };
