/** Named settings for a pen or a paper, kept in the browser and parsed by the schema like everything stored. */
import { z } from "zod";
import {
  motionSettingsSchema,
  penSettingsSchema,
  plotSettingsSchema,
  prepareSettingsSchema,
  type PlotSettings,
} from "../../src/schema/index.js";
import type { TextStore } from "./persist.js";

const KEY = "plotwright.presets.v1";
const MAX_PRESETS = 100;

const inks = plotSettingsSchema.shape;
const prepare = prepareSettingsSchema.shape;

/** What a preset carries: how pens move and stand and which layers they draw, not where the drawing lies. */
const presetSchema = z.object({
  name: z.string().trim().min(1).max(60),
  motion: motionSettingsSchema,
  pen: penSettingsSchema,
  /** Presets from before there were pens leave those as they are. */
  pens: z
    .object({
      pens: inks.pens,
      layerPens: inks.layerPens,
      penStops: inks.penStops,
      layerStops: inks.layerStops,
    })
    .optional(),
  layers: z
    .object({
      layers: prepare.layers,
      hiddenLayers: prepare.hiddenLayers,
      shownLayers: prepare.shownLayers,
      layerOrder: prepare.layerOrder,
      layerRepeats: prepare.layerRepeats,
      layerHatches: prepare.layerHatches,
    })
    .optional(),
});
export type Preset = z.infer<typeof presetSchema>;

export const fromPreset = (settings: PlotSettings, { motion, pen, pens, layers }: Preset): PlotSettings => ({
  ...settings,
  motion,
  pen,
  ...pens,
  prepare: { ...settings.prepare, ...layers },
});

export const readPresets = (store: TextStore | null): Preset[] => {
  try {
    const list: unknown = JSON.parse(store?.getItem(KEY) ?? "[]");
    if (!Array.isArray(list)) return [];
    return list.flatMap((item) => {
      const parsed = presetSchema.safeParse(item);
      return parsed.success ? [parsed.data] : [];
    });
  } catch {
    return [];
  }
};

export const writePresets = (store: TextStore | null, presets: readonly Preset[]): void => {
  try {
    store?.setItem(KEY, JSON.stringify(presets));
  } catch {
    // A full or refused store: the presets last as long as the page.
  }
};

/** The list with the preset in it: in the place of one of the same name, else at the end. */
export const withPreset = (presets: readonly Preset[], name: string, settings: PlotSettings): Preset[] => {
  const { motion, pen, pens, layerPens, penStops, layerStops } = settings;
  const { layers, hiddenLayers, shownLayers, layerOrder, layerRepeats, layerHatches } = settings.prepare;
  const preset = {
    name: name.trim(),
    motion,
    pen,
    pens: { pens, layerPens, penStops, layerStops },
    layers: { layers, hiddenLayers, shownLayers, layerOrder, layerRepeats, layerHatches },
  };
  const others = presets.filter((other) => other.name !== preset.name);
  return [...others, preset].slice(-MAX_PRESETS);
};
