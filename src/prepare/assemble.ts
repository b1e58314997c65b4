/**
 * The steps of `prepare` after lines are assigned to layers: sort, count, filter by visibility, build the
 * StrokeSet.
 */
import type { Drawing } from "../drawing/drawing.js";
import { settingsIdOf, type StrokeLayer, type StrokeSet } from "../drawing/stroke-set.js";
import { lineCount, lineLength, pickLines, type Lines } from "../geometry/polyline.js";
import type { FileLayer, LayerTable } from "./layers.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { setFor } from "./set-for.js";
import { speedFactorsOf, type SpeedParts } from "./speed-parts.js";
import { inkPortions } from "./spread.js";

/** A layer of the file, visible or hidden, with figures about its lines on this paper. */
export interface PreparedLayer extends FileLayer {
  readonly visible: boolean;
  readonly strokeCount: number;
  readonly pointCount: number;
  readonly drawMm: number;
}

/** Sorts lines by part of a layer (speed-parts.ts), with the file's order within a part, and tags them with the part. */
export function byLayer(lines: Lines, parts: SpeedParts): Lines {
  const part = new Uint32Array(lines.tag.length);
  const tagged = { ...lines, tag: part };
  if (parts.count === 1) return tagged;
  for (let i = 0; i < part.length; i++) part[i] = parts.ofShape[lines.tag[i]];
  if (isSorted(part)) return tagged;
  const next = new Uint32Array(parts.count + 1);
  for (const k of part) next[k + 1]++;
  for (let k = 0; k < parts.count; k++) next[k + 1] += next[k];
  const order = new Uint32Array(part.length);
  part.forEach((k, i) => (order[next[k]++] = i));
  return pickLines(tagged, order);
}

const isSorted = (values: Uint32Array): boolean => {
  for (let i = 1; i < values.length; i++) if (values[i] < values[i - 1]) return false;
  return true;
};

/** Removes strokes shorter than this, including dots; 0 keeps all. */
export function dropShort(lines: Lines, shorterThan: number): Lines {
  if (!(shorterThan > 0)) return lines;
  const kept: number[] = [];
  for (let i = 0; i < lineCount(lines); i++) if (lineLength(lines, i) >= shorterThan) kept.push(i);
  return pickLines(lines, kept);
}

export function countLayers(
  lines: Lines,
  table: LayerTable,
  parts: SpeedParts,
  isVisible: readonly boolean[],
): PreparedLayer[] {
  const strokes = new Float64Array(table.layers.length);
  const points = new Float64Array(table.layers.length);
  const length = new Float64Array(table.layers.length);
  for (let i = 0; i < lineCount(lines); i++) {
    const k = parts.layer[lines.tag[i]];
    strokes[k]++;
    points[k] += lines.offsets[i + 1] - lines.offsets[i];
    length[k] += lineLength(lines, i);
  }
  return table.layers.map((layer, k) => ({
    ...layer,
    visible: isVisible[k],
    strokeCount: strokes[k],
    pointCount: points[k],
    drawMm: length[k],
  }));
}

export function visibleOnly(lines: Lines, parts: SpeedParts, isVisible: readonly boolean[]): Lines {
  if (isVisible.every(Boolean)) return lines;
  const kept: number[] = [];
  for (let i = 0; i < lineCount(lines); i++) if (isVisible[parts.layer[lines.tag[i]]]) kept.push(i);
  return pickLines(lines, kept);
}

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
  const strokes = unshifted(lines, parts, layers, isVisible, reinkMm);
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
  parts: SpeedParts,
  layers: readonly StrokeLayer[],
  isVisible: readonly boolean[],
  reinkMm: number,
): StrokeSet {
  if (reinkMm > 0) return inkedStrokeSet(lines, parts, layers, isVisible, reinkMm);
  let next = 0;
  const renumbered = layers.map((_, k) => (isVisible[k] ? next++ : 0));
  const layer = new Uint16Array(lineCount(lines));
  if (layers.length > 1) {
    for (let i = 0; i < layer.length; i++) layer[i] = renumbered[parts.layer[lines.tag[i]]];
  }
  return {
    xy: lines.xy,
    offsets: lines.offsets,
    layer,
    ...speedFactorField(lines, parts),
    layers: layers.filter((_, k) => isVisible[k]).map(plainLayer),
  };
}

function speedFactorField(lines: Lines, parts: SpeedParts): Pick<StrokeSet, "speedFactor"> {
  const speedFactor = speedFactorsOf(lines, parts);
  return speedFactor === undefined ? {} : { speedFactor };
}

const plainLayer = ({ id, name, color }: StrokeLayer): StrokeLayer => ({ id, name, color });

/** A stroke stores its layer as a 16-bit index. */
const MAX_PORTIONS = 65_536;

/** Splits layers into portions for `reinkMm`. Each part of a layer begins a new portion. */
function inkedStrokeSet(
  given: Lines,
  parts: SpeedParts,
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
    // Layers without strokes are kept too, as in `unshifted`.
    out.push(plainLayer(layers[k]));
    let number = 1;
    for (const first = i; i < layer.length && parts.layer[lines.tag[i]] === k; i++) {
      const isNew = i > first && (portion[i] !== portion[i - 1] || lines.tag[i] !== lines.tag[i - 1]);
      if (isNew && out.length < MAX_PORTIONS) {
        number++;
        const { id, name, color } = layers[k];
        out.push({ id: `${id}~${number}`, name: `${name} (${number})`, color, partOf: id });
      }
      layer[i] = out.length - 1;
    }
  }
  return { xy: lines.xy, offsets: lines.offsets, layer, ...speedFactorField(lines, parts), layers: out };
}
