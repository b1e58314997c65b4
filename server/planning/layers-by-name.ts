/** Options that name layers of the drawing: `--only NAME…` hides all others, `--pen LAYER=NAME` sets a layer's pen. */
import { PlotwrightError, prepare, type Drawing } from "../../src/index.js";
import { parseLayerName, PLOT_PEN_TABLE, type PlotPen, type PreparedLayer } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";

/** A layer by name or id, and a pen by name or id. */
export interface PenChoice {
  readonly layer: string;
  readonly pen: string;
}

/**
 * The settings with every layer hidden that is not in `only`: a name or id, case-insensitive, or the number with which
 * names begin. If a name is that of a sublayer, the layers are the sublayers.
 */
export function withOnlyLayers(
  drawing: Drawing,
  settings: PlotSettings,
  only: readonly string[] | undefined,
): PlotSettings {
  if (only === undefined) return settings;
  const bySublayer = { ...settings, prepare: { ...settings.prepare, layers: "sublayer" as const } };
  const isKnown = (layers: readonly NamedLayer[]): boolean =>
    only.every((name) => layers.some((layer) => isMeant(layer, name)));
  const isSublayer =
    settings.prepare.layers === "group" &&
    !isKnown(layersOf(drawing, settings)) &&
    isKnown(layersOf(drawing, bySublayer));
  const chosen = isSublayer ? bySublayer : settings;
  const layers = layersOf(drawing, chosen);
  const wanted = new Set(only.flatMap((name) => idsOf(layers, name, "--only")));
  const hiddenLayers = layers.map(({ id }) => id).filter((id) => !wanted.has(id));
  // A layer named here is drawn even if a code in its own name hides it.
  const shownLayers = layers.filter((layer) => only.some((name) => isNamed(layer, name))).map(({ id }) => id);
  return { ...chosen, prepare: { ...chosen.prepare, hiddenLayers, shownLayers } };
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

/** As in AxiDraw's software, "1" means all layers whose name begins with the number 1. */
const isMeant = (layer: NamedLayer, wanted: string): boolean =>
  [layer, ...layer.outer].some(
    (one) =>
      isNamed(one, wanted) || (/^\d+$/.test(wanted) && parseLayerName(one.name).number === Number(wanted)),
  );

interface NamedLayer extends PreparedLayer {
  /** For a sublayer, the layers around it. */
  readonly outer: Drawing["groups"];
}

function layersOf(drawing: Drawing, settings: PlotSettings): readonly NamedLayer[] {
  const { groups } = drawing;
  const { layers } = prepare(drawing, { ...settings.prepare, order: "none", hiddenLayers: [] });
  const outerOf = (id: string): Drawing["groups"][number][] => {
    const outer: Drawing["groups"][number][] = [];
    let at = groups.find((group) => group.id === id)?.parent;
    for (; at !== undefined; at = groups[at].parent) outer.push(groups[at]);
    return outer;
  };
  const isBySublayer = settings.prepare.layers === "sublayer";
  return layers.map((layer) => ({ ...layer, outer: isBySublayer ? outerOf(layer.id) : [] }));
}

function idsOf(layers: readonly NamedLayer[], name: string, option: string): string[] {
  const found = layers.filter((layer) => isMeant(layer, name));
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
