/**
 * The pens of a drawing: which pen draws which layer, where the plot stops to change pens, and the correction
 * for a pen that sits off-centre in the holder.
 *
 * For example, with layers a (red), b (red) and c (black), the plot stops before these strokes. A drawing with a single
 * pen does not stop at its beginning.
 *
 *   strokes   0 1 2 | 3 4 | 5 6 7        "pens"    0, 5
 *   layers    a     | b   | c            "layers"  0, 3, 5
 */
import {
  settingsIdOf,
  strokeCount,
  type StrokeLayer,
  type StrokeSet,
  setFor,
} from "../../drawing/stroke-set.js";
import { parseLayerName, shownLayerName } from "./layer-codes.js";
import type { ShiftMm } from "../../settings/placement.js";
import type { PrepareSettings } from "../../settings/prepare.js";
import type { PlotPenValues } from "../../settings/values.js";

export const PEN_STOP_MODES = ["never", "pens", "layers"] as const;
/** Where a plot stops for another pen: where the pen changes, before every layer, or nowhere. */
export type PenStopMode = (typeof PEN_STOP_MODES)[number];

/** A pen that the user has. */
export interface PlotPen extends PlotPenValues {
  readonly id: string;
  readonly name: string;
  /** "#rrggbb", or null to use the layer's colour. */
  readonly color: string | null;
}

/** The user's pens, the pen of each layer, and where the plot stops to change pens. */
export interface PenSetup {
  /** The pens that `layerPens` refers to. */
  readonly pens: readonly PlotPen[];
  /** Pen id by layer id. A layer without one is drawn with the pen that is in the holder. */
  readonly layerPens: Readonly<Record<string, string>>;
  /** "pens": stop where a different pen is needed, and before a layer whose name begins with "!". */
  readonly penStops: PenStopMode;
  /** By layer id: whether to stop before it; overrides the rule for its pen and name. Ignored with "never". */
  readonly layerStops: Readonly<Record<string, boolean>>;
}

export const NO_PENS: PenSetup = { pens: [], layerPens: {}, penStops: "pens", layerStops: {} };

/** A stop: the plot waits, with the pen up, before it draws this stroke. */
export interface PenStop {
  readonly strokeIndex: number;
  readonly layerId: string;
  /** Without its codes. */
  readonly layerName: string;
  /** The pen to insert; null if the layer has none assigned. */
  readonly penName: string | null;
  /** The pen's colour, or else the layer's. */
  readonly color: string | null;
}

/** The pen that draws a layer; null for the one in the holder. */
export function penOf({ pens, layerPens }: PenSetup, layer: StrokeLayer): PlotPen | null {
  const id = setFor(layerPens, settingsIdOf(layer));
  return id === undefined ? null : (pens.find((pen) => pen.id === id) ?? null);
}

/**
 * Where the plot waits for the operator, in order. There is a stop before the first stroke if its layer asks for one, or
 * if several pens are needed, since any of them may be in the holder. Linear in strokes.
 */
export function penStopsOf(strokes: StrokeSet, setup: PenSetup): readonly PenStop[] {
  if (setup.penStops === "never") return [];
  const stops: PenStop[] = [];
  let inHolder: string | null = null;
  const count = strokeCount(strokes);
  const hasSeveralPens = pensUsed(strokes, setup).size > 1;
  for (let stroke = 0; stroke < count; stroke++) {
    const isFirst = stroke === 0;
    if (!isFirst && strokes.layer[stroke] === strokes.layer[stroke - 1]) continue;
    const layer = strokes.layers[strokes.layer[stroke]];
    const pen = penOf(setup, layer);
    const needsOther = pen !== null && (isFirst ? hasSeveralPens : pen.id !== inHolder);
    if (pen !== null) inHolder = pen.id;
    if (stopsBefore(setup, layer, isFirst, needsOther)) stops.push(stopAt(stroke, layer, pen));
  }
  return stops;
}

function pensUsed(strokes: StrokeSet, setup: PenSetup): ReadonlySet<string> {
  const layers = new Set(strokes.layer.subarray(0, strokeCount(strokes)));
  const ids = [...layers].map((layer) => penOf(setup, strokes.layers[layer])?.id);
  return new Set(ids.filter((id) => id !== undefined));
}

function stopsBefore(setup: PenSetup, layer: StrokeLayer, isFirst: boolean, needsOther: boolean): boolean {
  // Layers are split only for stops to take up ink.
  if (layer.partOf !== undefined) return true;
  const own = setFor(setup.layerStops, layer.id);
  if (own !== undefined) return own;
  if (parseLayerName(layer.name).pause) return true;
  return needsOther || (setup.penStops === "layers" && !isFirst);
}

const stopAt = (strokeIndex: number, layer: StrokeLayer, pen: PlotPen | null): PenStop => ({
  strokeIndex,
  layerId: settingsIdOf(layer),
  layerName: shownLayerName(layer.name),
  penName: pen?.name ?? null,
  color: pen?.color ?? layer.color,
});

/** The settings for `prepare` from a job's settings, including the pen offset correction of each layer. */
export function prepareSettingsOf(
  settings: Pick<PenSetup, "pens" | "layerPens"> & { readonly prepare: PrepareSettings },
): PrepareSettings {
  const shifts: Record<string, ShiftMm> = {};
  for (const [layer, penId] of Object.entries(settings.layerPens)) {
    const pen = settings.pens.find(({ id }) => id === penId);
    if (!pen || (pen.offsetXMm === 0 && pen.offsetYMm === 0)) continue;
    shifts[layer] = { xMm: -pen.offsetXMm, yMm: -pen.offsetYMm };
  }
  return Object.keys(shifts).length > 0 ? { ...settings.prepare, layerShifts: shifts } : settings.prepare;
}
