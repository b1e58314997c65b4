/**
 * The steps of `prepare` after lines are assigned to layers: sort, count, filter by visibility, build the
 * StrokeSet.
 */
import type { Drawing } from "../drawing/drawing.js";
import { setFor, settingsIdOf, shiftedXy, type StrokeLayer, type StrokeSet } from "../drawing/stroke-set.js";
import { filterLines, lineCount, lineLength, pickLines, type Lines } from "../geometry/polyline.js";
import { type FileLayer, type LayerTable, speedFactorsOf, type SpeedParts } from "./layers/layers.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { inkPortions } from "./order/spread.js";

/** A layer of the file, visible or hidden, with figures about its lines on this paper. */
export interface PreparedLayer extends FileLayer {
  readonly visible: boolean;
  readonly strokeCount: number;
  readonly pointCount: number;
  readonly drawMm: number;
}

/**
 * Sorts lines by part of a layer (layers.ts), with the file's order within a part, and tags them with their part and
 * colour (`partOfTag`).
 */
export function sortedByLayer(lines: Lines, parts: SpeedParts, drawing: Drawing): Lines {
  const { stroke, fill } = drawing.paths;
  const part = Uint32Array.from(lines.tag, (shape) => parts.ofShape[shape]);
  const tag = Uint32Array.from(lines.tag, (shape, i) => {
    const color = stroke[shape] >= 0 ? stroke[shape] : fill[shape];
    return part[i] * colorTags(drawing) + color + 1;
  });
  const tagged = { ...lines, tag };
  if (isSorted(part)) return tagged;
  const linesOf = Array.from({ length: parts.count }, (): number[] => []);
  part.forEach((k, i) => linesOf[k].push(i));
  return pickLines(tagged, linesOf.flat());
}

/** Also for shapes without a colour. */
const colorTags = ({ colors }: Drawing): number => colors.length + 1;

/** The part of a layer of a line that `byLayer` has tagged. */
export const partOfTag =
  (drawing: Drawing) =>
  (tag: number): number =>
    Math.floor(tag / colorTags(drawing));

const isSorted = (values: Uint32Array): boolean => {
  for (let i = 1; i < values.length; i++) if (values[i] < values[i - 1]) return false;
  return true;
};

/** Removes strokes shorter than this, including dots; 0 keeps all. */
export const dropShort = (lines: Lines, shorterThan: number): Lines =>
  shorterThan > 0 ? filterLines(lines, (i) => lineLength(lines, i) >= shorterThan) : lines;

export function countLayers(
  lines: Lines,
  table: LayerTable,
  parts: SpeedParts,
  isVisible: readonly boolean[],
): PreparedLayer[] {
  const layers = table.layers.map((layer, k) => ({
    ...layer,
    visible: isVisible[k],
    strokeCount: 0,
    pointCount: 0,
    drawMm: 0,
  }));
  for (let i = 0; i < lineCount(lines); i++) {
    const layer = layers[parts.layer[lines.tag[i]]];
    layer.strokeCount++;
    layer.pointCount += lines.offsets[i + 1] - lines.offsets[i];
    layer.drawMm += lineLength(lines, i);
  }
  return layers;
}

export const visibleOnly = (lines: Lines, parts: SpeedParts, isVisible: readonly boolean[]): Lines =>
  isVisible.every(Boolean) ? lines : filterLines(lines, (i) => isVisible[parts.layer[lines.tag[i]]]);

export function emptyWarning(drawing: Drawing, isVisible: readonly boolean[]): string {
  if (drawing.paths.count === 0) return "The file has no lines to draw.";
  if (!isVisible.some(Boolean)) return "All layers are hidden: nothing will be drawn.";
  return "Nothing is left to draw on this paper: check the margins, the hidden layers and the shortest stroke.";
}

/**
 * The strokes of the visible layers, with the layers renumbered. With `reinkMm` a layer is split into several, "red",
 * "red (2)" …, because a plot can stop only between layers to take up ink. `shifts`: by layer id.
 */
export function strokeSetOf(
  lines: Lines,
  parts: SpeedParts,
  layers: readonly StrokeLayer[],
  isVisible: readonly boolean[],
  reinkMm: number,
  shifts: PrepareSettings["layerShifts"] = {},
): StrokeSet {
  const strokes = buildStrokes(lines, parts, layers, isVisible, reinkMm);
  const moved = strokes.layers.map((layer) => {
    const shift = setFor(shifts, settingsIdOf(layer));
    return shift ? { ...layer, shiftMm: { x: shift.xMm, y: shift.yMm } } : layer;
  });
  return {
    ...strokes,
    xy: shiftedXy({ ...strokes, layers: moved }, ({ shiftMm }) => shiftMm),
    layers: moved,
  };
}

/** A stroke stores its layer as a 16-bit index. */
const MAX_PORTIONS = 65_536;

/** Splits layers into portions if `reinkMm` is set. Each part of a layer begins a new portion. */
function buildStrokes(
  given: Lines,
  parts: SpeedParts,
  layers: readonly StrokeLayer[],
  isVisible: readonly boolean[],
  reinkMm: number,
): StrokeSet {
  const inked = reinkMm > 0 ? inkPortions(given, reinkMm) : null;
  const { xy, offsets, tag } = inked?.lines ?? given;
  const out: StrokeLayer[] = [];
  const layer = new Uint16Array(tag.length);
  let i = 0;
  for (const [k, { id, name, color }] of layers.entries()) {
    if (!isVisible[k]) continue;
    // Layers without strokes are kept too.
    out.push({ id, name, color });
    let number = 1;
    for (const first = i; i < tag.length && parts.layer[tag[i]] === k; i++) {
      const isNew =
        inked !== null && i > first && (inked.portion[i] !== inked.portion[i - 1] || tag[i] !== tag[i - 1]);
      if (isNew && out.length < MAX_PORTIONS) {
        number++;
        out.push({ id: `${id}~${number}`, name: `${name} (${number})`, color, partOf: id });
      }
      layer[i] = out.length - 1;
    }
  }
  const speedFactor = speedFactorsOf(tag, parts);
  return { xy, offsets, layer, ...(speedFactor === undefined ? {} : { speedFactor }), layers: out };
}
