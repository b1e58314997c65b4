/** Which layer each shape belongs to: by group of the file, by stroke colour, or all in one. */
import type { Drawing, DrawingPaths } from "../drawing/drawing.js";
import type { StrokeLayer } from "../drawing/stroke-set.js";
import { parseLayerName } from "./layer-codes.js";
import type { LayerMode, PrepareSettings } from "../settings/prepare.js";

/** StrokeSet keeps a layer index in 16 bits; what is beyond shares the last layer. */
const MOST_LAYERS = 65_535;

export interface LayerTable {
  /** Only layers that hold a shape, in the file's order. */
  readonly layers: readonly StrokeLayer[];
  /** Index into `layers` for every shape. */
  readonly ofShape: Uint16Array;
}

export function layersOf(drawing: Drawing, mode: LayerMode): LayerTable {
  const { paths } = drawing;
  const keyCount = mode === "group" ? drawing.groups.length : mode === "stroke" ? drawing.colors.length : 1;
  const keyOf = (shape: number): number =>
    mode === "group" ? paths.group[shape] : mode === "stroke" ? Math.max(inkOf(paths, shape), 0) : 0;

  const used = new Uint8Array(keyCount);
  const colors = new Int32Array(keyCount).fill(UNSEEN);
  const { group, stroke, fill } = paths;
  for (let shape = 0; shape < paths.count; shape++) {
    // Most are as the one before.
    const before = shape - 1;
    const isAlike =
      shape > 0 &&
      group[shape] === group[before] &&
      stroke[shape] === stroke[before] &&
      fill[shape] === fill[before];
    if (isAlike) continue;
    const key = keyOf(shape);
    const ink = inkOf(paths, shape);
    colors[key] = colors[key] === UNSEEN || colors[key] === ink ? ink : MIXED;
    used[key] = 1;
  }

  const layers: StrokeLayer[] = [];
  const indexOfKey = new Uint16Array(keyCount);
  for (let key = 0; key < keyCount; key++) {
    if (used[key] === 0) continue;
    if (layers.length < MOST_LAYERS) layers.push(layerOf(drawing, mode, key, colors[key]));
    indexOfKey[key] = layers.length - 1;
  }
  const ofShape = new Uint16Array(paths.count);
  if (layers.length > 1)
    for (let shape = 0; shape < paths.count; shape++) ofShape[shape] = indexOfKey[keyOf(shape)];
  return { layers, ofShape };
}

/** Which layers are drawn: those that nobody switched off, and whose name does not say "%". */
export function visibleLayers(
  { layers }: LayerTable,
  { hiddenLayers, shownLayers }: Pick<PrepareSettings, "hiddenLayers" | "shownLayers">,
): boolean[] {
  const hidden = new Set(hiddenLayers);
  const shown = new Set(shownLayers);
  return layers.map(({ id, name }) => !hidden.has(id) && (shown.has(id) || !parseLayerName(name).skip));
}

/** The layers in the order in which they are drawn: those in `wanted` first, the rest as in the file. */
export function inOrder(table: LayerTable, wanted: readonly string[]): LayerTable {
  if (wanted.length === 0) return table;
  const rankOf = new Map([...new Set(wanted)].map((id, rank) => [id, rank]));
  const rank = ({ id }: StrokeLayer): number => rankOf.get(id) ?? wanted.length;
  // Array.sort is stable: what is not wanted keeps the file's order.
  const order = table.layers.map((_, k) => k).sort((a, b) => rank(table.layers[a]) - rank(table.layers[b]));
  const placeOf = new Uint16Array(order.length);
  order.forEach((layer, place) => (placeOf[layer] = place));
  return {
    layers: order.map((layer) => table.layers[layer]),
    ofShape: table.ofShape.map((layer) => placeOf[layer]),
  };
}

const UNSEEN = -2;
const MIXED = -1;

/** The colour that a shape is drawn in: its stroke, else its fill (its outline is drawn then). */
const inkOf = ({ stroke, fill }: DrawingPaths, shape: number): number =>
  stroke[shape] >= 0 ? stroke[shape] : fill[shape];

function layerOf(drawing: Drawing, mode: LayerMode, key: number, ink: number): StrokeLayer {
  const color = ink >= 0 ? drawing.colors[ink] : null;
  if (mode === "group") return { id: drawing.groups[key].id, name: drawing.groups[key].name, color };
  if (mode === "stroke") return { id: drawing.colors[key], name: drawing.colors[key], color };
  return { id: "all", name: "All strokes", color };
}
