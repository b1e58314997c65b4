/** Finds the lines that the margins cut off, to show them on the page. */
import { isBackground, type Drawing } from "../drawing/drawing.js";
import { boxContains, boxesTouch, grownBox, isEmptyBox, type Box } from "../geometry/box.js";
import { filterLines, lineBox, lineCount, type Lines } from "../geometry/polyline.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { clipRegions, clipLines } from "./steps/clips.js";
import { flattenShapes, gapsOfShapes, cropBox, strokedOnly } from "./steps/shapes.js";
import { layersOf, visibleLayers } from "./layers/layers.js";
import { isFarAway, type Layout } from "./layout.js";

interface CutOff {
  /** Lines outside this box are not drawn, mm. */
  readonly limit: Box;
  /** The lines that are outside the limit at least in part. Their parts inside are drawn. */
  readonly lines: Lines;
  /** How many of them are entirely outside. */
  readonly outsideCount: number;
}

/** A line that leaves the limit by less than this is not listed, because that is rounding, mm. */
const UNNOTICED_MM = 0.1;
/** Precise enough for the screen. */
const FLATTEN_MM = 0.1;

/** Null if nothing is cut off. Only shapes that leave the limit are flattened. `place`: from the same settings. */
export function cutOffLines(drawing: Drawing, settings: PrepareSettings, place: Layout): CutOff | null {
  const limit = cropBox(settings, place);
  if (limit === null) return null;
  const widened = grownBox(limit, UNNOTICED_MM);
  if (boxContains(widened, place.whole)) return null;
  const table = layersOf(drawing, settings.layers);
  const isVisible = visibleLayers(table, settings);
  const wanted = new Uint8Array(drawing.paths.count);
  place.shapeBoxes().forEach((box, shape) => {
    if (isEmptyBox(box) || isFarAway(box) || boxContains(widened, box)) return;
    if (isVisible[table.ofShape[shape]] && !isBackground(drawing.paths, shape)) wanted[shape] = 1;
  });
  let lines = flattenShapes(drawing.paths, place.map, FLATTEN_MM, wanted, {});
  if (!settings.outlineFills) lines = strokedOnly(lines, drawing);
  if (drawing.clips.length > 0) {
    const clipOf = clipRegions(drawing, place.map, FLATTEN_MM);
    lines = clipLines(lines, drawing, clipOf, gapsOfShapes(drawing.paths, FLATTEN_MM), {});
  }
  const leaving = filterLines(lines, (i) => !boxContains(widened, lineBox(lines, i)));
  const outside = filterLines(leaving, (i) => !boxesTouch(lineBox(leaving, i), limit));
  return lineCount(leaving) === 0 ? null : { limit, lines: leaving, outsideCount: lineCount(outside) };
}
