/** The steps of `prepare` once lines belong to layers: sorted, counted, switched off, handed over. */
import type { Drawing } from "../drawing/drawing.js";
import { settingsIdOf, type StrokeLayer, type StrokeSet } from "../drawing/stroke-set.js";
import { lineCount, lineLength, pickLines, type Lines } from "../geometry/polyline.js";
import type { FileLayer, LayerTable } from "./layers.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { setFor } from "./set-for.js";
import { inkPortions } from "./spread.js";

/** A layer of the file with what it holds on this paper, whether it is drawn or hidden. */
export interface PreparedLayer extends FileLayer {
  readonly visible: boolean;
  readonly strokeCount: number;
  readonly pointCount: number;
  readonly drawMm: number;
}

/** Lines sorted by layer, in the file's order within each; their tag is the layer from here on. */
export function byLayer(lines: Lines, table: LayerTable): Lines {
  const layer = new Uint32Array(lines.tag.length);
  // Written out, since what is spread is an object of another kind to V8: all that reads lines would be compiled anew.
  const tagged = { xy: lines.xy, offsets: lines.offsets, tag: layer };
  if (table.layers.length === 1) return tagged;
  for (let i = 0; i < layer.length; i++) layer[i] = table.ofShape[lines.tag[i]];
  if (isSorted(layer)) return tagged;
  const next = new Uint32Array(table.layers.length + 1);
  for (const k of layer) next[k + 1]++;
  for (let k = 0; k < table.layers.length; k++) next[k + 1] += next[k];
  const order = new Uint32Array(layer.length);
  layer.forEach((k, i) => (order[next[k]++] = i));
  return pickLines(tagged, order);
}

const isSorted = (values: Uint32Array): boolean => {
  for (let i = 1; i < values.length; i++) if (values[i] < values[i - 1]) return false;
  return true;
};

/** Without strokes shorter than that, dots among them; 0 keeps all. */
export function dropShort(lines: Lines, shorterThan: number): Lines {
  if (!(shorterThan > 0)) return lines;
  const kept: number[] = [];
  for (let i = 0; i < lineCount(lines); i++) if (lineLength(lines, i) >= shorterThan) kept.push(i);
  return pickLines(lines, kept);
}

export function countLayers(lines: Lines, table: LayerTable, isVisible: readonly boolean[]): PreparedLayer[] {
  const strokes = new Float64Array(table.layers.length);
  const points = new Float64Array(table.layers.length);
  const length = new Float64Array(table.layers.length);
  for (let i = 0; i < lineCount(lines); i++) {
    strokes[lines.tag[i]]++;
    points[lines.tag[i]] += lines.offsets[i + 1] - lines.offsets[i];
    length[lines.tag[i]] += lineLength(lines, i);
  }
  return table.layers.map((layer, k) => ({
    ...layer,
    visible: isVisible[k],
    strokeCount: strokes[k],
    pointCount: points[k],
    drawMm: length[k],
  }));
}

export function visibleOnly(lines: Lines, isVisible: readonly boolean[]): Lines {
  if (isVisible.every(Boolean)) return lines;
  const kept: number[] = [];
  for (let i = 0; i < lineCount(lines); i++) if (isVisible[lines.tag[i]]) kept.push(i);
  return pickLines(lines, kept);
}

export function emptyWarning(drawing: Drawing, isVisible: readonly boolean[]): string {
  if (drawing.paths.count === 0) return "The file has no lines to draw.";
  if (!isVisible.some(Boolean)) return "All layers are hidden: nothing will be drawn.";
  return "Nothing is left to draw on this paper: look at the margins, the hidden layers and the shortest stroke.";
}

/**
 * The strokes with the visible layers only, numbered anew. With `reinkMm` a layer becomes several,
 * "red", "red (2)" …, so that the stop between layers is the stop to take up ink. `shifts` by layer id.
 */
export function strokeSetOf(
  lines: Lines,
  layers: readonly StrokeLayer[],
  isVisible: readonly boolean[],
  reinkMm: number,
  shifts: PrepareSettings["layerShifts"] = {},
): StrokeSet {
  const strokes = unshifted(lines, layers, isVisible, reinkMm);
  const shiftsMm = strokes.layers.map((layer) => setFor(shifts, settingsIdOf(layer)));
  if (shiftsMm.every((shift) => shift === undefined)) return strokes;
  const { offsets, layer } = strokes;
  const xy = strokes.xy.slice();
  for (let i = 0; i < layer.length; i++) {
    const shift = shiftsMm[layer[i]];
    if (!shift) continue;
    for (let p = offsets[i]; p < offsets[i + 1]; p++) {
      xy[2 * p] += shift.xMm;
      xy[2 * p + 1] += shift.yMm;
    }
  }
  const moved = strokes.layers.map((one, k) => {
    const shift = shiftsMm[k];
    return shift ? { ...one, shiftMm: { x: shift.xMm, y: shift.yMm } } : one;
  });
  return { ...strokes, xy, layers: moved };
}

function unshifted(
  lines: Lines,
  layers: readonly StrokeLayer[],
  isVisible: readonly boolean[],
  reinkMm: number,
): StrokeSet {
  if (reinkMm > 0) return inkedStrokeSet(lines, layers, isVisible, reinkMm);
  let next = 0;
  const renumbered = layers.map((_, k) => (isVisible[k] ? next++ : 0));
  const layer = new Uint16Array(lineCount(lines));
  if (layers.length > 1) for (let i = 0; i < layer.length; i++) layer[i] = renumbered[lines.tag[i]];
  return {
    xy: lines.xy,
    offsets: lines.offsets,
    layer,
    layers: layers.filter((_, k) => isVisible[k]).map(plainLayer),
  };
}

const plainLayer = ({ id, name, color }: StrokeLayer): StrokeLayer => ({ id, name, color });

/** A 16-bit index is all that a stroke has for its layer. */
const MOST_PORTIONS = 65_536;

function inkedStrokeSet(
  given: Lines,
  layers: readonly StrokeLayer[],
  isVisible: readonly boolean[],
  reinkMm: number,
): StrokeSet {
  const { lines, portion } = inkPortions(given, reinkMm);
  const out: StrokeLayer[] = [];
  const layer = new Uint16Array(lineCount(lines));
  let i = 0;
  for (let k = 0; k < layers.length; k++) {
    if (!isVisible[k]) continue;
    // A layer without strokes stays, as without portions.
    out.push(plainLayer(layers[k]));
    for (let part = 0; i < layer.length && lines.tag[i] === k; i++) {
      if (portion[i] > part && out.length < MOST_PORTIONS) {
        part = portion[i];
        const { id, name, color } = layers[k];
        out.push({ id: `${id}~${part + 1}`, name: `${name} (${part + 1})`, color, partOf: id });
      }
      layer[i] = out.length - 1;
    }
  }
  return { xy: lines.xy, offsets: lines.offsets, layer, layers: out };
}
