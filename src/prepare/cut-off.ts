/** What the margins cut off: the lines that `prepare` would draw without them, and how many are concerned. */
import type { Drawing } from "../drawing/drawing.js";
import { EMPTY_BOX, boxContains, boxOfPoints, boxesTouch, isEmptyBox, type Box } from "../geometry/box.js";
import { lineCount, pickLines, type Lines } from "../geometry/polyline.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { clipRegions } from "./clip-regions.js";
import { clipLines } from "./clipped-fills.js";
import { flattenShapes } from "./flatten.js";
import { layersOf, visibleLayers } from "./layers.js";
import { isFarAway, type Placement } from "./place.js";
import { cropBox, strokedOnly } from "./shapes.js";

export interface CutOff {
  /** mm; what lies outside is not drawn. */
  readonly limit: Box;
  /** The lines that leave the limit, whole: the parts inside it are drawn. */
  readonly lines: Lines;
  /** How many of them lie outside entirely; the rest is drawn in part. */
  readonly outsideCount: number;
}

/** mm of line that may be lost at the margins without a word: rounding. */
const UNNOTICED_MM = 0.1;
/** Precise enough to be looked at. */
const FLATTEN_MM = 0.1;

/** Null where nothing is cut off. Only shapes that leave the limit cost time. `place`: by the same settings. */
export function cutOffLines(drawing: Drawing, settings: PrepareSettings, place: Placement): CutOff | null {
  const limit = cropBox(settings, place);
  if (limit === null) return null;
  const roomy = {
    x0: limit.x0 - UNNOTICED_MM,
    y0: limit.y0 - UNNOTICED_MM,
    x1: limit.x1 + UNNOTICED_MM,
    y1: limit.y1 + UNNOTICED_MM,
  };
  if (boxContains(roomy, place.whole)) return null;
  const table = layersOf(drawing, settings.layers);
  const isVisible = visibleLayers(table, settings);
  const boxes = place.shapeBoxes();
  const wanted = new Uint8Array(drawing.paths.count);
  for (let shape = 0, at = 0; shape < wanted.length; shape++, at += 4) {
    const box = { x0: boxes[at], y0: boxes[at + 1], x1: boxes[at + 2], y1: boxes[at + 3] };
    if (isEmptyBox(box) || isFarAway(box) || boxContains(roomy, box)) continue;
    if (isVisible[table.ofShape[shape]]) wanted[shape] = 1;
  }
  let lines = flattenShapes(drawing.paths, place.map, FLATTEN_MM, wanted, {});
  if (!settings.outlineFills) lines = strokedOnly(lines, drawing);
  if (drawing.clips.length > 0) {
    lines = clipLines(lines, drawing, clipRegions(drawing, place.map, FLATTEN_MM), {});
  }
  const leaving: number[] = [];
  let outsideCount = 0;
  for (let i = 0; i < lineCount(lines); i++) {
    const box = lineBox(lines, i);
    if (boxContains(roomy, box)) continue;
    leaving.push(i);
    if (!boxesTouch(box, limit)) outsideCount++;
  }
  return leaving.length === 0 ? null : { limit, lines: pickLines(lines, leaving), outsideCount };
}

const lineBox = ({ xy, offsets }: Lines, i: number): Box =>
  offsets[i] === offsets[i + 1] ? EMPTY_BOX : boxOfPoints(xy, 2 * offsets[i], 2 * offsets[i + 1]);
