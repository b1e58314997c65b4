/** Settings changes made by the layer and pen controls. Each is a pure function and one undo step. */
import { parseLayerName, type LayerMotion, type LayerPen, type PlotPen } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";

type Prepare = PlotSettings["prepare"];

/** A layer as the page lists it. */
export interface LayerRow {
  readonly id: string;
  readonly name: string;
  readonly color: string | null;
}

const withPrepare = (settings: PlotSettings, change: Partial<Prepare>): PlotSettings => ({
  ...settings,
  prepare: { ...settings.prepare, ...change },
});

/** The entries of all layers except one. */
export const withoutLayer = <T>(
  byLayer: Readonly<Record<string, T>> | undefined,
  id: string,
): Record<string, T> => Object.fromEntries(Object.entries(byLayer ?? {}).filter(([other]) => other !== id));

const without = (ids: readonly string[], id: string): string[] => ids.filter((other) => other !== id);

export const isLayerShown = ({ prepare }: PlotSettings, { id, name }: LayerRow): boolean =>
  !prepare.hiddenLayers.includes(id) && (prepare.shownLayers.includes(id) || !parseLayerName(name).skip);

/** A layer whose name begins with "%" is off unless it is in `shownLayers`. Others are on unless in `hiddenLayers`. */
export const showLayer = (settings: PlotSettings, { id, name }: LayerRow, isOn: boolean): PlotSettings => {
  const { hiddenLayers, shownLayers } = settings.prepare;
  const isOffByName = parseLayerName(name).skip;
  const others = without(hiddenLayers, id);
  return withPrepare(settings, {
    hiddenLayers: isOn || isOffByName ? others : [...others, id],
    shownLayers: isOn && isOffByName ? [...without(shownLayers, id), id] : without(shownLayers, id),
  });
};

export const showOnly = (settings: PlotSettings, rows: readonly LayerRow[], id: string): PlotSettings =>
  rows.reduce((changed, row) => showLayer(changed, row, row.id === id), settings);

export const showAll = (settings: PlotSettings, rows: readonly LayerRow[]): PlotSettings =>
  rows.reduce((changed, row) => showLayer(changed, row, true), settings);

/** Moves the layer to index `place`. The others keep their order. */
export const moveLayer = (
  settings: PlotSettings,
  rows: readonly LayerRow[],
  id: string,
  place: number,
): PlotSettings => {
  const others = rows.map((row) => row.id).filter((other) => other !== id);
  const at = Math.min(Math.max(0, place), others.length);
  return withPrepare(settings, { layerOrder: [...others.slice(0, at), id, ...others.slice(at)] });
};

/** The rows in the order of the settings. The plan may still have the order before the last change. */
export const inWantedOrder = <Row extends LayerRow>(
  { prepare: { layerOrder } }: PlotSettings,
  rows: readonly Row[],
): readonly Row[] => {
  const rank = ({ id }: Row): number =>
    layerOrder.includes(id) ? layerOrder.indexOf(id) : layerOrder.length;
  return [...rows].sort((a, b) => rank(a) - rank(b));
};

export const repeatLayer = (settings: PlotSettings, id: string, times: number | null): PlotSettings => {
  const others = withoutLayer(settings.prepare.layerRepeats, id);
  const isOnce = times === null || times <= 1;
  return withPrepare(settings, { layerRepeats: isOnce ? others : { ...others, [id]: times } });
};

/** Sets the layer's own hatch; null: use the drawing's hatch. */
export const hatchLayer = (
  settings: PlotSettings,
  id: string,
  hatch: Prepare["hatch"] | null,
): PlotSettings => {
  const others = settings.prepare.layerHatches.filter(({ layer }) => layer !== id);
  return withPrepare(settings, {
    layerHatches: hatch ? [...others, { ...hatch, layer: id }] : others,
  });
};

/** Null resets a field to the common setting. */
type Own<T> = { readonly [K in keyof T]?: NonNullable<T[K]> | null };

export const setLayerMotion = (settings: PlotSettings, id: string, own: Own<LayerMotion>): PlotSettings => ({
  ...settings,
  motion: { ...settings.motion, layers: withOwn<LayerMotion>(settings.motion.layers, id, own) },
});

export const setLayerPenMotion = (settings: PlotSettings, id: string, own: Own<LayerPen>): PlotSettings => ({
  ...settings,
  pen: { ...settings.pen, layers: withOwn<LayerPen>(settings.pen.layers, id, own) },
});

const withOwn = <T extends object>(
  layers: Readonly<Record<string, T>> | undefined,
  id: string,
  own: Own<T>,
): Record<string, T> => {
  const fields = Object.entries({ ...layers?.[id], ...own }).filter(
    ([, value]) => value !== null && value !== undefined,
  );
  const others = withoutLayer(layers, id);
  return fields.length === 0 ? others : { ...others, [id]: Object.fromEntries(fields) as T };
};

/** True: a stop before the layer, false: no stop, null: depends on its pen and name. */
export const stopBefore = (settings: PlotSettings, id: string, stop: boolean | null): PlotSettings => {
  const others = withoutLayer(settings.layerStops, id);
  return { ...settings, layerStops: stop === null ? others : { ...others, [id]: stop } };
};

export const setLayerPen = (settings: PlotSettings, id: string, penId: string | null): PlotSettings => {
  const others = withoutLayer(settings.layerPens, id);
  return { ...settings, layerPens: penId === null ? others : { ...others, [id]: penId } };
};

/** Adds a pen with a new id. */
export const addPen = (settings: PlotSettings, pen: Partial<PlotPen> & { name: string }): PlotSettings => {
  const isTaken = (id: string): boolean => settings.pens.some((other) => other.id === id);
  let number = settings.pens.length + 1;
  while (isTaken(`pen-${number}`)) number++;
  const fresh = { id: `pen-${number}`, color: null, widthMm: 0.4, offsetXMm: 0, offsetYMm: 0, ...pen };
  return { ...settings, pens: [...settings.pens, fresh] };
};

export const changePen = (settings: PlotSettings, id: string, change: Partial<PlotPen>): PlotSettings => ({
  ...settings,
  pens: settings.pens.map((pen) => (pen.id === id ? { ...pen, ...change } : pen)),
});

/** Its layers have no pen then: they are drawn with the pen that is in the holder. */
export const removePen = (settings: PlotSettings, id: string): PlotSettings => ({
  ...settings,
  pens: settings.pens.filter((pen) => pen.id !== id),
  layerPens: Object.fromEntries(Object.entries(settings.layerPens).filter(([, penId]) => penId !== id)),
});

/**
 * Gives each layer a pen of its colour. Adds a pen if none has that colour. Layers without a colour get one too:
 * otherwise they would be drawn with the pen that is in the holder.
 */
export const pensFromColors = (
  settings: PlotSettings,
  rows: readonly LayerRow[],
  nameOf: (color: string | null) => string,
): PlotSettings =>
  rows.reduce((changed, { id, color }) => {
    const known = changed.pens.some((pen) => pen.color === color)
      ? changed
      : addPen(changed, { name: nameOf(color), color });
    const pen = known.pens.find((other) => other.color === color);
    return pen ? setLayerPen(known, id, pen.id) : known;
  }, settings);
