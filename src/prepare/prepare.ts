/**
 * From what the file says to what the pen draws: the list of steps below, in that order.
 *
 * Lines carry their shape as tag up to the crop, and their layer from then on. Hidden layers go all
 * the way to the counts, so that the page can show what a switch would bring; only then they drop out.
 */
import type { Drawing } from "../drawing/drawing.js";
import type { StrokeLayer, StrokeSet } from "../drawing/stroke-set.js";
import { meanScale } from "../geometry/affine.js";
import { boxesTouch, isEmptyBox, type Box } from "../geometry/box.js";
import { clipLinesToBox } from "../geometry/clip.js";
import { lineCount, lineLength, pickLines, type Lines } from "../geometry/polyline.js";
import { clipToRegions } from "./clip-regions.js";
import { dashLines, scaledPattern } from "./dash.js";
import { flattenShapes } from "./flatten.js";
import { joinLines } from "./join.js";
import { layersOf, type LayerTable } from "./layers.js";
import { orderLines } from "./order.js";
import { isFarAway, placeDrawing, type Placement } from "./place.js";
import type { PrepareSettings } from "./settings.js";
import { simplifyLines } from "./simplify.js";
import { fileTour, linesOfTour, travelOf } from "./tour.js";
import { stopIfCancelled, type Work } from "./work.js";

/** A layer of the file with what it holds on this paper, whether it is drawn or hidden. */
export interface PreparedLayer extends StrokeLayer {
  readonly visible: boolean;
  readonly strokeCount: number;
  readonly pointCount: number;
  readonly drawMm: number;
}

export interface Prepared {
  readonly strokes: StrokeSet;
  /** All layers of the file under the layer mode, hidden ones too, in the file's order. */
  readonly layers: readonly PreparedLayer[];
  /** The paper as it lies: after `landscape`. */
  readonly paperWidthMm: number;
  readonly paperHeightMm: number;
  /** Pen-up way from home through all strokes and home: as the file has them, and as they are drawn. */
  readonly travelMmUnordered: number;
  readonly travelMm: number;
  readonly drawMm: number;
  /** What this paper and these settings leave out; the drawing's own warnings are not repeated. */
  readonly warnings: readonly string[];
}

/**
 * Lays the drawing on the paper and makes it into strokes in drawing order (mm in the machine frame).
 * Throws PlotwrightError `bad-setting` (no room inside the margins) and `cancelled`.
 */
export function prepare(drawing: Drawing, settings: PrepareSettings, options: Work = {}): Prepared {
  const progress = (done: number, step: string): void => {
    stopIfCancelled(options);
    options.onProgress?.(done, step);
  };
  const warnings: string[] = [];

  progress(0, "placing");
  const place = placeDrawing(drawing, settings);
  const table = layersOf(drawing, settings.layers);
  const wanted = shapesOnPaper(drawing, settings, place, warnings);
  let lines = flattenShapes(drawing.paths, place.map, settings.flattenMm, wanted, options);
  progress(0.2, "shaping");
  lines = dashShapes(lines, drawing, place, settings);
  lines = settings.clipToMargins ? crop(lines, place, warnings) : lines;
  lines = clipToRegions(lines, drawing, place.map, settings.flattenMm);
  progress(0.4, "joining");
  lines = byLayer(lines, table);
  lines = settings.joinMm > 0 ? joinLines(lines, settings.joinMm) : lines;
  lines = dropShort(lines, settings.dropShorterMm);
  lines = simplifyLines(lines, settings.simplifyMm);
  progress(0.5, "counting");
  const layers = countLayers(lines, table, settings.hiddenLayers);
  lines = visibleOnly(lines, layers);
  progress(0.6, "ordering");
  const tour = orderLines(lines, settings.order, options);
  if (lineCount(lines) === 0) warnings.push(emptyWarning(drawing, layers));
  const strokes = strokeSetOf(linesOfTour(lines, tour), layers);
  progress(1, "done");

  return {
    strokes,
    layers,
    paperWidthMm: place.paper.x1,
    paperHeightMm: place.paper.y1,
    travelMmUnordered: travelOf(lines, fileTour(lines)),
    travelMm: travelOf(lines, tour),
    drawMm: totalLength(lines),
    warnings,
  };
}

/** Shapes worth flattening: those that reach the place where lines are kept, and are of this world. */
function shapesOnPaper(
  drawing: Drawing,
  settings: PrepareSettings,
  place: Placement,
  warnings: string[],
): Uint8Array {
  const wanted = new Uint8Array(drawing.paths.count);
  let outside = 0;
  let far = 0;
  for (let shape = 0; shape < wanted.length; shape++) {
    const box = place.shapeBoxes[shape];
    if (isEmptyBox(box)) continue;
    if (isFarAway(box)) far++;
    else if (settings.clipToMargins && !boxesTouch(box, place.inside)) outside++;
    else wanted[shape] = 1;
  }
  if (far > 0) warnings.push(`${shapes(far)} much too far from the paper (over 1000 km) and not drawn.`);
  if (outside > 0) warnings.push(`${shapes(outside)} wholly outside the margins and not drawn.`);
  return wanted;
}

const shapes = (count: number): string => (count === 1 ? "1 shape is" : `${count} shapes are`);

/** Where dashes are worth making when nothing is cut off: 100 m around home. */
const ANYWHERE: Box = { x0: -1e5, y0: -1e5, x1: 1e5, y1: 1e5 };

function dashShapes(lines: Lines, drawing: Drawing, place: Placement, settings: PrepareSettings): Lines {
  if (drawing.dashes.length === 0) return lines;
  const scale = meanScale(place.map);
  const patterns = drawing.dashes.map((pattern) => scaledPattern(pattern, scale));
  return dashLines(
    lines,
    (shape) => {
      const dash = drawing.paths.dash[shape];
      return dash >= 0 && drawing.paths.stroke[shape] >= 0 ? patterns[dash] : null;
    },
    settings.clipToMargins ? place.inside : ANYWHERE,
  );
}

/** mm of line that may go at the margins without a word: rounding, not drawing. */
const UNNOTICED_CROP = 0.1;

function crop(lines: Lines, place: Placement, warnings: string[]): Lines {
  const kept = clipLinesToBox(lines, place.inside);
  const lost = totalLength(lines) - totalLength(kept);
  if (lost > UNNOTICED_CROP) {
    warnings.push(`${Math.ceil(lost)} mm of line lie outside the margins and are cut off.`);
  }
  return kept;
}

/** Lines sorted by layer, in the file's order within each; their tag is the layer from here on. */
function byLayer(lines: Lines, table: LayerTable): Lines {
  const count = lineCount(lines);
  const next = new Uint32Array(table.layers.length + 1);
  for (let i = 0; i < count; i++) next[table.ofShape[lines.tag[i]] + 1]++;
  for (let layer = 0; layer < table.layers.length; layer++) next[layer + 1] += next[layer];
  const order = new Uint32Array(count);
  for (let i = 0; i < count; i++) order[next[table.ofShape[lines.tag[i]]]++] = i;
  const sorted = pickLines(lines, order);
  return { ...sorted, tag: sorted.tag.map((shape) => table.ofShape[shape]) };
}

function dropShort(lines: Lines, shorterThan: number): Lines {
  if (!(shorterThan > 0)) return lines;
  const kept: number[] = [];
  for (let i = 0; i < lineCount(lines); i++) if (lineLength(lines, i) >= shorterThan) kept.push(i);
  return pickLines(lines, kept);
}

function countLayers(lines: Lines, table: LayerTable, hidden: readonly string[]): PreparedLayer[] {
  const strokes = new Float64Array(table.layers.length);
  const points = new Float64Array(table.layers.length);
  const length = new Float64Array(table.layers.length);
  for (let i = 0; i < lineCount(lines); i++) {
    strokes[lines.tag[i]]++;
    points[lines.tag[i]] += lines.offsets[i + 1] - lines.offsets[i];
    length[lines.tag[i]] += lineLength(lines, i);
  }
  const hiddenIds = new Set(hidden);
  return table.layers.map((layer, k) => ({
    ...layer,
    visible: !hiddenIds.has(layer.id),
    strokeCount: strokes[k],
    pointCount: points[k],
    drawMm: length[k],
  }));
}

function visibleOnly(lines: Lines, layers: readonly PreparedLayer[]): Lines {
  if (layers.every((layer) => layer.visible)) return lines;
  const kept: number[] = [];
  for (let i = 0; i < lineCount(lines); i++) if (layers[lines.tag[i]].visible) kept.push(i);
  return pickLines(lines, kept);
}

function emptyWarning(drawing: Drawing, layers: readonly PreparedLayer[]): string {
  if (drawing.paths.count === 0) return "The file has no lines to draw.";
  if (layers.every((layer) => !layer.visible)) return "All layers are hidden: nothing will be drawn.";
  return "Nothing is left to draw on this paper: look at the margins, the hidden layers and the shortest stroke.";
}

/** The strokes with the visible layers only, numbered anew. */
function strokeSetOf(lines: Lines, layers: readonly PreparedLayer[]): StrokeSet {
  const visible = layers.filter((layer) => layer.visible);
  let next = 0;
  const renumbered = layers.map((layer) => (layer.visible ? next++ : 0));
  return {
    xy: lines.xy,
    offsets: lines.offsets,
    layer: Uint16Array.from(lines.tag, (layer) => renumbered[layer]),
    layers: visible.map(({ id, name, color }) => ({ id, name, color })),
  };
}

function totalLength(lines: Lines): number {
  let length = 0;
  for (let i = 0; i < lineCount(lines); i++) length += lineLength(lines, i);
  return length;
}
