/** Options that name layers of the drawing: `--only NAME…` hides all others, `--pen LAYER=NAME` sets a layer's pen. */
import { PlotwrightError, prepare, type Drawing } from "../../src/index.js";
import { PLOT_PEN_TABLE, type PlotPen, type PreparedLayer } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";

/** A layer by name or id, and a pen by name or id. */
export interface PenChoice {
  readonly layer: string;
  readonly pen: string;
}

/** The settings with every layer hidden that is not in `only` (by name or id, case-insensitive). */
export function withOnlyLayers(
  drawing: Drawing,
  settings: PlotSettings,
  only: readonly string[] | undefined,
): PlotSettings {
  if (only === undefined) return settings;
  const layers = layersOf(drawing, settings);
  const wanted = new Set(only.flatMap((name) => idsOf(layers, name, "--only")));
  const idsThat = (isOn: boolean): string[] =>
    layers.map(({ id }) => id).filter((id) => wanted.has(id) === isOn);
  // A layer named here is drawn even if a code in its own name hides it.
  const prepareSettings = { ...settings.prepare, hiddenLayers: idsThat(false), shownLayers: idsThat(true) };
  return { ...settings, prepare: prepareSettings };
}

/**
 * The settings with the pens of these layers. Without any pens in the settings, pens with these names are made: the plot
 * stops and asks for them by name.
 */
export function withLayerPens(
  drawing: Drawing,
  settings: PlotSettings,
  choices: readonly PenChoice[] | undefined,
): PlotSettings {
  if (choices === undefined) return settings;
  const layers = layersOf(drawing, settings);
  const pens = settings.pens.length > 0 ? settings.pens : choices.map(({ pen }) => newPen(pen));
  const layerPens = choices.flatMap(({ layer, pen }) =>
    idsOf(layers, layer, "--pen").map((id) => [id, penIn(pens, pen).id] as const),
  );
  const isRepeated = ({ id }: PlotPen, i: number): boolean => pens.findIndex((pen) => pen.id === id) !== i;
  return {
    ...settings,
    pens: pens.filter((pen, i) => !isRepeated(pen, i)),
    layerPens: { ...settings.layerPens, ...Object.fromEntries(layerPens) },
  };
}

const isNamed = ({ id, name }: { readonly id: string; readonly name: string }, wanted: string): boolean =>
  [id, name].some((one) => one.toLowerCase() === wanted.toLowerCase());

const layersOf = (drawing: Drawing, settings: PlotSettings): readonly PreparedLayer[] =>
  prepare(drawing, { ...settings.prepare, order: "none", hiddenLayers: [] }).layers;

function idsOf(layers: readonly PreparedLayer[], name: string, option: string): string[] {
  const found = layers.filter((layer) => isNamed(layer, name));
  if (found.length > 0) return found.map(({ id }) => id);
  const known = layers.map((layer) => JSON.stringify(layer.name)).join(", ");
  throw new PlotwrightError(
    "bad-setting",
    `${option}: there is no layer ${JSON.stringify(name)}. The drawing has ${known}.`,
  );
}

function penIn(pens: readonly PlotPen[], name: string): PlotPen {
  const found = pens.find((pen) => isNamed(pen, name));
  if (found !== undefined) return found;
  const known = pens.map((pen) => JSON.stringify(pen.name)).join(", ");
  throw new PlotwrightError(
    "bad-setting",
    `--pen: there is no pen ${JSON.stringify(name)}. The plotter has ${known}.`,
  );
}

const newPen = (name: string): PlotPen => ({
  id: name.toLowerCase(),
  name,
  color: null,
  widthMm: PLOT_PEN_TABLE.widthMm.default,
  offsetXMm: 0,
  offsetYMm: 0,
});
