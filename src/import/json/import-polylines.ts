/**
 * plotwright's JSON of polylines, the simplest format for a program to pass a drawing:
 *
 *   { "widthMm": 210, "heightMm": 297,
 *     "layers": [ { "name": "Ink", "color": "#ff0000", "strokes": [ [x0, y0, x1, y1, …], … ] } ] }
 *
 * mm, origin top left, y down. Points may also be pairs: [[x0, y0], [x1, y1], …]. A stroke of one point is a
 * dot. A layer may have "speedFactors": a number for each stroke, 0.5 for one at half the usual speed. `toJson`
 * writes this format, with "strokesMm" for "strokes".
 */
import { type Drawing, isSpeedFactor } from "../../drawing/drawing.js";
import { PlotwrightError } from "../../errors.js";
import { IDENTITY } from "../../geometry/affine.js";
import { parseCssColor } from "../css-color.js";
import { DrawingBuilder, type Look } from "../drawing-builder.js";
import { ShapeBuffer } from "../shape-buffer.js";
import { WARNING_WORDS } from "../warning-words.js";
import { inWords, Warnings } from "../warnings.js";

const MAX_PAGE_MM = 100_000;

const bad = (what: string): PlotwrightError =>
  new PlotwrightError(
    "bad-file",
    `The JSON drawing cannot be read: ${what}. It should be { "widthMm", "heightMm", "layers": [{ "name", "color", "strokes": [[x, y, x, y, …]] }] }.`,
  );

/** Throws PlotwrightError("bad-file"). Without a page size, the page is the drawing's extent. */
export function importPolylines(text: string): Drawing {
  const file = objectOf(parseJson(text), "the file");
  const warnings = new Warnings();
  const builder = new DrawingBuilder(warnings);
  if (!Array.isArray(file["layers"])) throw bad("it has no list of layers");
  file["layers"].forEach((layer: unknown, index) => addLayer(builder, layer, index, warnings));
  const { widthMm, heightMm } = file;
  if (widthMm === undefined && heightMm === undefined) {
    warnings.add("page-size", undefined, "taken from the drawing");
    return inWords(builder.finishAround(), WARNING_WORDS);
  }
  return inWords(builder.finish(pageSide(widthMm, "widthMm"), pageSide(heightMm, "heightMm")), WARNING_WORDS);
}

function parseJson(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (cause) {
    throw new PlotwrightError("bad-file", `The JSON is damaged: ${(cause as Error).message.slice(0, 200)}`, {
      cause,
    });
  }
}

function objectOf(value: unknown, what: string): Record<string, unknown> {
  if (typeof value !== "object" || value === null || Array.isArray(value))
    throw bad(`${what} is not an object`);
  return value as Record<string, unknown>;
}

function pageSide(value: unknown, name: string): number {
  if (typeof value === "number" && value > 0 && value <= MAX_PAGE_MM) return value;
  throw bad(`${name} must be a number of mm above 0`);
}

function addLayer(builder: DrawingBuilder, value: unknown, index: number, warnings: Warnings): void {
  const layer = objectOf(value, `layer ${index + 1}`);
  const name = typeof layer["name"] === "string" ? layer["name"] : `Layer ${index + 1}`;
  const id = typeof layer["id"] === "string" ? layer["id"] : `layer-${index + 1}`;
  const given = layer["color"];
  const color = typeof given === "string" ? (parseCssColor(given)?.hex ?? null) : "#000000";
  if (color === null) throw bad(`the colour of layer ${index + 1} is not a CSS colour`);
  const strokes = layer["strokes"] ?? layer["strokesMm"];
  if (!Array.isArray(strokes)) throw bad(`layer ${index + 1} has no list of strokes`);
  const factors = layer["speedFactors"];
  if (factors !== undefined && !Array.isArray(factors)) {
    throw bad(`the speedFactors of layer ${index + 1} are not a list`);
  }
  const group = builder.addGroup(id, name, false);
  const look: Look = { stroke: color, fill: null };
  const shape = new ShapeBuffer();
  strokes.forEach((stroke: unknown, strokeIndex) => {
    const where = `stroke ${strokeIndex + 1} of layer ${index + 1}`;
    drawStroke(shape, stroke, where);
    const own = slower(look, factors?.[strokeIndex], where, warnings);
    if (!shape.isEmpty) builder.addShape(shape, IDENTITY, own, group, null, () => where);
  });
}

function slower(look: Look, given: unknown, where: string, warnings: Warnings): Look {
  if (given === undefined || given === 1) return look;
  if (isSpeedFactor(given)) return { ...look, speedFactor: given };
  warnings.add("speed-factor", undefined, `"${String(given).slice(0, 40)}" of ${where}`);
  return look;
}

function drawStroke(shape: ShapeBuffer, stroke: unknown, where: string): void {
  if (!Array.isArray(stroke)) throw bad(`${where} is not a list of numbers`);
  const numbers: readonly unknown[] = stroke.some(Array.isArray) ? stroke.flat() : stroke;
  if (numbers.length % 2 !== 0 || !numbers.every((n) => typeof n === "number" && Number.isFinite(n))) {
    throw bad(`${where} is not made of pairs of numbers`);
  }
  const xy = numbers as readonly number[];
  shape.clear();
  if (xy.length === 0) return;
  shape.moveTo(xy[0], xy[1]);
  if (xy.length === 2) shape.lineTo(xy[0], xy[1]);
  for (let i = 2; i < xy.length; i += 2) shape.lineTo(xy[i], xy[i + 1]);
}
