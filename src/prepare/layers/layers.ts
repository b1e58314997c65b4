/**
 * Assigns each shape to a layer: by group or sublayer of the file, by stroke colour, or all in one; and to a part of it
 * with one speed.
 */
import {
  isBackground,
  PAIRS_OF_VERB,
  VERB_CLOSE,
  VERB_MOVE,
  type Drawing,
  type DrawingPaths,
} from "../../drawing/drawing.js";
import type { StrokeLayer } from "../../drawing/stroke-set.js";
import { distance } from "../../geometry/polyline.js";
import { parseLayerName } from "./layer-codes.js";
import type { LayerMode, PrepareSettings } from "../../settings/prepare.js";

/** StrokeSet stores a layer index in 16 bits; further layers share the last index. */
const MAX_LAYERS = 65_535;

/** A layer as it is in the file. */
export interface FileLayer extends StrokeLayer {
  /** Number of colours of its lines; `color` is the one with the greatest length. */
  readonly colorCount: number;
  /** Mean stroke width of its lines by length, mm on the file's page; 0 if the file has no widths. */
  readonly strokeWidthMm: number;
}

export interface LayerTable {
  /** Only layers that contain a shape that is drawn, in the file's order. */
  readonly layers: readonly FileLayer[];
  /** Index into `layers` for every shape; of no meaning for a background whose layer has nothing else. */
  readonly ofShape: Uint16Array;
}

export function layersOf(drawing: Drawing, mode: LayerMode): LayerTable {
  const { paths } = drawing;
  const groupOf = mode === "group" ? layerOfGroups(drawing) : null;
  const isByGroup = mode === "group" || mode === "sublayer";
  const keyCount = isByGroup ? drawing.groups.length : mode === "stroke" ? drawing.colors.length : 1;
  const keyOf = (shape: number): number => {
    if (isByGroup) return groupOf?.[paths.group[shape]] ?? paths.group[shape];
    return mode === "stroke" ? Math.max(inkOf(paths, shape), 0) : 0;
  };

  const inksOfKey: (Map<number, number> | undefined)[] = new Array(keyCount);
  /** Length times width, of the lines that have a width; and their length. */
  const areas = new Float64Array(keyCount);
  const lengths = new Float64Array(keyCount);
  for (let shape = 0; shape < paths.count; shape++) {
    if (isBackground(paths, shape)) continue;
    const key = keyOf(shape);
    const shapeMm = Math.max(lengthOf(paths, shape), DOT_MM);
    const widthMm = paths.strokeWidth[shape];
    if (widthMm > 0) {
      areas[key] += shapeMm * widthMm;
      lengths[key] += shapeMm;
    }
    const inks = (inksOfKey[key] ??= new Map<number, number>());
    const ink = inkOf(paths, shape);
    inks.set(ink, (inks.get(ink) ?? 0) + shapeMm);
  }

  const layers: FileLayer[] = [];
  const indexOfKey = new Uint16Array(keyCount);
  for (let key = 0; key < keyCount; key++) {
    const inks = inksOfKey[key];
    if (!inks) continue;
    if (layers.length < MAX_LAYERS)
      layers.push(layerOf(drawing, mode, key, inks, areas[key] / Math.max(lengths[key], 1e-9)));
    indexOfKey[key] = layers.length - 1;
  }
  const ofShape = new Uint16Array(paths.count);
  if (layers.length > 1)
    for (let shape = 0; shape < paths.count; shape++) ofShape[shape] = indexOfKey[keyOf(shape)];
  return { layers, ofShape };
}

/** By group, the layer that it belongs to. A sublayer whose name begins with "%" is a layer itself, which is not drawn. */
function layerOfGroups({ groups }: Drawing): number[] {
  const layerOf: number[] = [];
  groups.forEach(({ name, parent }, k) => {
    layerOf.push(parent === undefined || parseLayerName(name).skip ? k : layerOf[parent]);
  });
  return layerOf;
}

/**
 * Which layers are drawn: those that are not hidden in the settings and whose name does not begin with "%"
 * (unless shown explicitly).
 */
export function visibleLayers(
  { layers }: LayerTable,
  { hiddenLayers, shownLayers }: Pick<PrepareSettings, "hiddenLayers" | "shownLayers">,
): boolean[] {
  const hidden = new Set(hiddenLayers);
  const shown = new Set(shownLayers);
  return layers.map(({ id, name }) => !hidden.has(id) && (shown.has(id) || !parseLayerName(name).skip));
}

/** The layers in drawing order: those in `wanted` first, the rest in the file's order. */
export function inOrder(table: LayerTable, wanted: readonly string[]): LayerTable {
  if (wanted.length === 0) return table;
  const rankOf = new Map([...new Set(wanted)].map((id, rank) => [id, rank]));
  const rank = ({ id }: StrokeLayer): number => rankOf.get(id) ?? wanted.length;
  // Array.sort is stable, so layers that are not in `wanted` keep the file's order.
  const order = table.layers.map((_, k) => k).sort((a, b) => rank(table.layers[a]) - rank(table.layers[b]));
  const placeOf = new Uint16Array(order.length);
  order.forEach((layer, place) => (placeOf[layer] = place));
  return {
    layers: order.map((layer) => table.layers[layer]),
    ofShape: table.ofShape.map((layer) => placeOf[layer]),
  };
}

/** Length assigned to a dot when choosing a layer's main colour, mm. */
const DOT_MM = 0.1;

/** The length of a shape's lines on the file's page; for a curve, the length of its control polygon. */
function lengthOf({ verbs, coords, verbOffsets, coordOffsets }: DrawingPaths, shape: number): number {
  let lengthMm = 0;
  let start = coordOffsets[shape];
  let at = start;
  for (let v = verbOffsets[shape]; v < verbOffsets[shape + 1]; v++) {
    const end = at + 2 * PAIRS_OF_VERB[verbs[v]];
    if (verbs[v] === VERB_MOVE) [start, at] = [at, end];
    if (verbs[v] === VERB_CLOSE) lengthMm += between(coords, at - 2, start);
    for (; at < end; at += 2) lengthMm += between(coords, at - 2, at);
  }
  return lengthMm;
}

const between = (coords: Float64Array, from: number, to: number): number =>
  distance(coords[from], coords[from + 1], coords[to], coords[to + 1]);

/** The colour in which a shape is drawn: that of its stroke, otherwise of its fill (then its outline is drawn). */
const inkOf = ({ stroke, fill }: DrawingPaths, shape: number): number =>
  stroke[shape] >= 0 ? stroke[shape] : fill[shape];

/** @param inks the length drawn in each colour */
function layerOf(
  drawing: Drawing,
  mode: LayerMode,
  key: number,
  inks: ReadonlyMap<number, number>,
  strokeWidthMm: number,
): FileLayer {
  const [[ink]] = [...inks].sort(([, a], [, b]) => b - a);
  const colors = { color: ink >= 0 ? drawing.colors[ink] : null, colorCount: inks.size, strokeWidthMm };
  if (mode === "group" || mode === "sublayer")
    return { id: drawing.groups[key].id, name: drawing.groups[key].name, ...colors };
  if (mode === "stroke") return { id: drawing.colors[key], name: drawing.colors[key], ...colors };
  return { id: "all", name: "All strokes", ...colors };
}

/**
 * The parts of layers that are drawn at different speeds. After lines are sorted by layer, the tag of a line is its
 * part, so lines are joined and ordered only within a part. The parts of a layer are consecutive.
 *
 *   layers   outline          fill
 *   parts    0 full  1 half   2 full
 */
export interface SpeedParts {
  readonly count: number;
  /** By shape. */
  readonly ofShape: Uint16Array | Uint32Array;
  /** By part: its layer, and its share of the layer's speed. */
  readonly layer: readonly number[];
  readonly factor: readonly number[];
}

export function speedPartsOf(drawing: Drawing, { layers, ofShape }: LayerTable): SpeedParts {
  const { speedFactor } = drawing.paths;
  const all = layers.map((_, k) => k);
  if (!speedFactor) return { count: layers.length, ofShape, layer: all, factor: all.map(() => 1) };
  const factorsOf = layers.map(() => new Set<number>());
  speedFactor.forEach((factor, shape) => factorsOf[ofShape[shape]].add(factor));
  const layer: number[] = [];
  const factor: number[] = [];
  /** By layer: the part of each factor. */
  const partOf = factorsOf.map((factors, k) => {
    const parts = new Map<number, number>();
    // The fastest first.
    for (const one of [...factors].sort((a, b) => b - a)) {
      parts.set(one, layer.length);
      layer.push(k);
      factor.push(one);
    }
    return parts;
  });
  const ofPart = Uint32Array.from(ofShape, (k, shape) => partOf[k].get(speedFactor[shape]) ?? 0);
  return { count: layer.length, ofShape: ofPart, layer, factor };
}

/** Each line's share of its layer's speed, by its part; undefined if all are 1. */
export function speedFactorsOf(tag: Uint32Array, { factor }: SpeedParts): Float64Array | undefined {
  return factor.every((one) => one === 1) ? undefined : Float64Array.from(tag, (part) => factor[part]);
}
