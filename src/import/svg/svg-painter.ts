/** Converts one leaf element to one shape of the drawing: geometry, paints, dashes. */
import {
  compose,
  meanScale,
  rotation,
  scaling,
  translation,
  unstretched,
  type Affine,
} from "../../geometry/affine.js";
import {
  EMPTY_BOX,
  boxContains,
  boxesTouch,
  boxOfPoints,
  grownBox,
  intersectBoxes,
  isEmptyBox,
  mapBox,
  uniteBoxes,
  type Box,
} from "../../geometry/box.js";
import type { DashPattern } from "../../drawing/drawing.js";
import { MM_PER_PX } from "../../units.js";
import type { Declared, Paint } from "./css/properties.js";
import type { DrawingBuilder, Look } from "../drawing-builder.js";
import { lengthPx } from "./css/length.js";
import { drawPathData } from "../path-data.js";
import { MeasuredPath } from "./shapes/measured-path.js";
import { curveBox, type ShapeBuffer } from "../shape-buffer.js";
import { type Context, isMarked } from "./svg-context.js";
import { warnOf } from "./svg-effects.js";
import type { SvgFile } from "./svg-file.js";
import { MaskPaintServers, type SvgPaintServers } from "./shapes/paint-servers.js";
import type { SvgGeometry } from "./shapes/basic-shapes.js";
import type { PlacedText, TextPlacer } from "./text/placed-text.js";
import type { PlacedLetter } from "./text/text-layout.js";
import { USUAL_METRICS, type TextFont } from "../text/text-font.js";
import { attribute } from "./svg-tree.js";
import type { Color } from "../color.js";
import { declaredValue, INITIAL_STYLE } from "./css/style.js";
import type { Warnings } from "../warnings.js";

/** A text that leaves the page by less is not reported, because that is rounding, mm. */
const UNNOTICED_MM = 0.1;

export class SvgPainter {
  constructor(
    private readonly file: SvgFile,
    private readonly geometry: SvgGeometry,
    /** Null if the file has no text, or it is only reported. */
    private readonly texts: TextPlacer | null,
    private readonly servers: SvgPaintServers,
    private readonly builder: DrawingBuilder,
    private readonly warnings: Warnings,
    /** In page mm. A text that crosses its edge is reported. Null: the page will be the drawing's own extent. */
    private readonly pageBox: Box | null,
  ) {}

  /** A painter for the content of a mask. */
  forMask(builder: DrawingBuilder, warnings: Warnings): SvgPainter {
    const { file, geometry, texts } = this;
    return new SvgPainter(file, geometry, texts, new MaskPaintServers(file), builder, warnings, null);
  }

  /** The box of a text in its user units: the full line height, from the first letter to the last. */
  textBox(element: number, context: Context): Box {
    const { texts } = this;
    if (texts === null) return EMPTY_BOX;
    const { letters } = this.placed(element, context, texts);
    const { ascent, descent } = texts.font.metrics ?? USUAL_METRICS;
    return letters.reduce((box, { x, y, angle, advance, style: { fontSize } }) => {
      const turned = compose(translation(x, y), rotation(angle));
      const cell = { x0: 0, y0: -ascent * fontSize, x1: advance, y1: descent * fontSize };
      return uniteBoxes(box, mapBox(turned, cell));
    }, EMPTY_BOX);
  }

  /** Calls `add` with each visible letter and its map to page mm; false if the font has no outlines. */
  outlinesOf(element: number, context: Context, add: (shape: ShapeBuffer, map: Affine) => void): boolean {
    const { texts } = this;
    if (texts?.font.kind !== "outline") return false;
    const { letters } = this.placed(element, context, texts);
    for (const letter of letters) {
      if (!letter.style.isVisible) continue;
      add(this.shapeOf(letter), mapOf(letter, context));
    }
    for (const wanted of otherFaces(letters, texts.font))
      this.warnings.add("text-style-ignored", undefined, wanted);
    return true;
  }

  private placed(element: number, context: Context, texts: TextPlacer): PlacedText {
    return texts.place(this.file, this.geometry, element, context);
  }

  /** In em. Valid until the next shape. */
  private shapeOf(letter: PlacedLetter): ShapeBuffer {
    const { shape } = this.geometry;
    shape.clear();
    drawPathData(shape, letter.path, 1);
    shape.finish();
    return shape;
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

  /** Draws the letters of a text as shapes; warns instead if there is no font. */
  drawText(element: number, context: Context): void {
    const { builder, warnings } = this;
    const { texts } = this;
    if (texts === null) {
      if (context.style.isVisible) warnings.add("text-not-drawn", this.roughPlaceOf(element, context));
      return;
    }
    const text = this.placed(element, context, texts);
    const firstShape = builder.shapeCount;
    for (const letter of text.letters) this.drawLetter(letter, element, context);
    let box = this.geometry.placeOf(context, text.x, text.y, 0, 0);
    if (builder.shapeCount > firstShape) {
      box = builder.boxOfShapes(firstShape, builder.shapeCount);
      warnOf(text.effects, box, warnings);
      if (texts.font.kind === "single-stroke") warnings.add("text-substituted", box);
      for (const wanted of otherFaces(text.letters, texts.font))
        warnings.add("text-style-ignored", box, wanted);
      if (this.isCutByPage(box, context)) warnings.add("text-over-edge", box);
    }
    if (text.offPathCount > 0 && context.style.isVisible)
      warnings.add("text-off-path", box, undefined, text.offPathCount);
    for (const char of text.missing) warnings.add("glyphs-missing", box, `"${char}"`);
    if (text.unsupported.length > 0) {
      warnings.add("text-not-drawn", box, undefined, text.unsupported.length);
    }
  }

  /** Whether a box is partly on the page and partly outside, within its clips. */
  private isCutByPage(box: Box, { clip }: Context): boolean {
    const { pageBox } = this;
    if (pageBox === null) return false;
    let visible = box;
    for (let at = clip; at !== null; at = at.parent)
      visible = intersectBoxes(visible, boxOfPoints(at.shapes.coords));
    return (
      !isEmptyBox(visible) &&
      boxesTouch(visible, pageBox) &&
      !boxContains(grownBox(pageBox, UNNOTICED_MM), visible)
    );
  }

  private drawLetter(letter: PlacedLetter, element: number, context: Context): void {
    const { style } = letter;
    if (!style.isVisible) return;
    const shape = this.shapeOf(letter);
    if (shape.isEmpty) return;
    const own = { ...context, style };
    const stroke = this.colorOf(style.stroke, style.strokeOpacity, own, "stroke");
    const fill = this.colorOf(style.fill, style.fillOpacity, own, "fill");
    if (stroke === null && fill === null) return;
    const isOutline = this.texts?.font.kind === "outline";
    const look: Look = {
      // A single stroke has no interior: the fill colour becomes its line colour.
      stroke: isOutline ? stroke : (stroke ?? fill),
      fill: isOutline ? fill : null,
      strokeWidth: stroke === null ? 0 : style.strokeWidth * meanScale(context.map),
      speedFactor: context.speedFactor,
    };
    const where = (): string => this.geometry.whereOf(element);
    this.builder.addShape(shape, mapOf(letter, context), look, context.group, context.clip, where);
  }

  private roughPlaceOf(element: number, context: Context): Box {
    const { fontSize } = context.style;
    const first = (name: "x" | "y"): number => {
      const text = (attribute(this.file.tree, element, name) ?? "0").trim().split(/[\s,]+/)[0];
      return lengthPx(text, context.basis, name === "x" ? "width" : "height") ?? 0;
    };
    return this.geometry.placeOf(context, first("x"), first("y") - fontSize, fontSize, fontSize);
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
  private colorOf(paint: Paint, opacity: number, context: Context, part: "stroke" | "fill"): string | null {
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

/** Styles that letters request and the font does not have: another family, bold, italic. */
function otherFaces(letters: readonly PlacedLetter[], { face }: TextFont): ReadonlySet<string> {
  const wanted = new Set<string>();
  if (face === undefined) return wanted;
  for (const { fontFamily, isBold, isItalic } of new Set(letters.map(({ style }) => style))) {
    const family = fontFamily.split(",")[0].replace(/["']/g, "").trim();
    if (family !== INITIAL_STYLE.fontFamily && family.toLowerCase() !== face.family.toLowerCase())
      wanted.add(`font ${family}`);
    if (isBold !== face.isBold) wanted.add(isBold ? "bold" : "not bold");
    if (isItalic !== face.isItalic) wanted.add(isItalic ? "italic" : "not italic");
  }
  return wanted;
}

/** A letter's em to page mm. */
function mapOf({ x, y, angle, stretch, style }: PlacedLetter, context: Context): Affine {
  const turned = compose(translation(x, y), rotation(angle));
  return compose(context.map, compose(turned, scaling(style.fontSize * stretch, style.fontSize)));
}

const isFlatBox = ({ x0, y0, x1, y1 }: Box): boolean => x0 === x1 || y0 === y1;

const NO_PAINT: Paint = { kind: "none" };
