/** Draws the letters of a text as shapes. Imported only for files that have text. */
import { compose, meanScale, rotation, scaling, translation, type Affine } from "../../../geometry/affine.js";
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
} from "../../../geometry/box.js";
import type { Look } from "../../drawing-builder.js";
import type { ImportOptions } from "../../import-options.js";
import { drawPathData } from "../../path-data.js";
import type { ShapeBuffer } from "../../shape-buffer.js";
import { USUAL_METRICS, type TextFont } from "../../text/text-font.js";
import { lengthPx } from "../css/length.js";
import { INITIAL_STYLE } from "../css/style.js";
import type { Context } from "../svg-context.js";
import { warnOf } from "../svg-effects.js";
import type { SvgPainter } from "../svg-painter.js";
import { attribute } from "../svg-tree.js";
import { textPlacerOf, type PlacedText, type TextPlacer } from "./placed-text.js";
import type { PlacedLetter } from "./text-layout.js";

/** A text that leaves the page by less is not reported, because that is rounding, mm. */
const UNNOTICED_MM = 0.1;

export class TextPainter {
  constructor(
    private readonly painter: SvgPainter,
    /** Null: texts are only reported. */
    private readonly placer: TextPlacer | null,
    /** In page mm. A text that crosses its edge is reported. Null: the page will be the drawing's own extent. */
    private readonly pageBox: Box | null,
  ) {}

  /** For the content of a mask, whose shapes `painter` draws. */
  forMask(painter: SvgPainter): TextPainter {
    return new TextPainter(painter, this.placer, null);
  }

  /** The box of a text in its user units: the full line height, from the first letter to the last. */
  boxOf(element: number, context: Context): Box {
    const { placer } = this;
    if (placer === null) return EMPTY_BOX;
    const { letters } = this.placed(element, context, placer);
    const { ascent, descent } = placer.font.metrics ?? USUAL_METRICS;
    return letters.reduce((box, { x, y, angle, advance, style: { fontSize } }) => {
      const turned = compose(translation(x, y), rotation(angle));
      const cell = { x0: 0, y0: -ascent * fontSize, x1: advance, y1: descent * fontSize };
      return uniteBoxes(box, mapBox(turned, cell));
    }, EMPTY_BOX);
  }

  /** Calls `add` with each visible letter and its map to page mm; false if the font has no outlines. */
  outlinesOf(element: number, context: Context, add: (shape: ShapeBuffer, map: Affine) => void): boolean {
    const { placer } = this;
    if (placer?.font.kind !== "outline") return false;
    const { letters } = this.placed(element, context, placer);
    for (const letter of letters) {
      if (!letter.style.isVisible) continue;
      add(this.shapeOf(letter), mapOf(letter, context));
    }
    for (const wanted of otherFaces(letters, placer.font))
      this.painter.warnings.add("text-style-ignored", undefined, wanted);
    return true;
  }

  private placed(element: number, context: Context, placer: TextPlacer): PlacedText {
    return placer.place(this.painter.file, this.painter.geometry, element, context);
  }

  /** In em. Valid until the next shape. */
  private shapeOf(letter: PlacedLetter): ShapeBuffer {
    const { shape } = this.painter.geometry;
    shape.clear();
    drawPathData(shape, letter.path, 1);
    shape.finish();
    return shape;
  }

  /** Draws the letters of a text as shapes; warns instead if there is no font. */
  draw(element: number, context: Context): void {
    const { placer } = this;
    const { builder, geometry, warnings } = this.painter;
    if (placer === null) {
      if (context.style.isVisible) warnings.add("text-not-drawn", this.roughPlaceOf(element, context));
      return;
    }
    const text = this.placed(element, context, placer);
    const firstShape = builder.shapeCount;
    for (const letter of text.letters) this.drawLetter(letter, element, context);
    let box = geometry.placeOf(context, text.x, text.y, 0, 0);
    if (builder.shapeCount > firstShape) {
      box = builder.boxOfShapes(firstShape, builder.shapeCount);
      warnOf(text.effects, box, warnings);
      if (placer.font.kind === "single-stroke") warnings.add("text-substituted", box);
      for (const wanted of otherFaces(text.letters, placer.font))
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
    const { painter } = this;
    const own = { ...context, style };
    const stroke = painter.colorOf(style.stroke, style.strokeOpacity, own, "stroke");
    const fill = painter.colorOf(style.fill, style.fillOpacity, own, "fill");
    if (stroke === null && fill === null) return;
    const isOutline = this.placer?.font.kind === "outline";
    const look: Look = {
      // A single stroke has no interior: the fill colour becomes its line colour.
      stroke: isOutline ? stroke : (stroke ?? fill),
      fill: isOutline ? fill : null,
      strokeWidth: stroke === null ? 0 : style.strokeWidth * meanScale(context.map),
      speedFactor: context.speedFactor,
    };
    const where = (): string => painter.geometry.whereOf(element);
    painter.builder.addShape(shape, mapOf(letter, context), look, context.group, context.clip, where);
  }

  private roughPlaceOf(element: number, context: Context): Box {
    const { fontSize } = context.style;
    const { file, geometry } = this.painter;
    const first = (name: "x" | "y"): number => {
      const text = (attribute(file.tree, element, name) ?? "0").trim().split(/[\s,]+/)[0];
      return lengthPx(text, context.basis, name === "x" ? "width" : "height") ?? 0;
    };
    return geometry.placeOf(context, first("x"), first("y") - fontSize, fontSize, fontSize);
  }
}

/** `pageBox` as for `TextPainter`. */
export const textPainterOf = (
  options: ImportOptions,
  painter: SvgPainter,
  pageBox: Box | null,
): TextPainter => new TextPainter(painter, textPlacerOf(options), pageBox);

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
