/**
 * Settings of a plotter instead of a drawing: its pen's heights and waits, its pens, and its presets. The server stores
 * one such record for each plotter. The plotter's model is `Plotter.machine`.
 */
import { z } from "zod";
import type { JobSettings } from "../drivers/machine-job.js";
import { PlotwrightError } from "../errors.js";
import { findMachine } from "../machines/profiles.js";
import { withoutShaperIfUnmeasured } from "../plan/quality.js";
import type { PenSetup, PlotPen } from "../prepare/layers/pens.js";
import type { PenSettings } from "../settings/pen.js";
import type { PrepareSettings } from "../settings/prepare.js";
import { givenSettingsSchema, withOffs, type GivenSettings } from "./given-settings.js";
import {
  motionSettingsSchema,
  penSettingsSchema,
  plotterPenSchema,
  plotSettingsSchema,
  prepareSettingsSchema,
  type PlotSettings,
} from "./settings.js";

const { pens, layerPens, penStops, layerStops } = plotSettingsSchema.shape;
const prepare = prepareSettingsSchema.shape;

/** Settings under a name: how pens move and which layers they draw, not where the drawing is on the paper. */
export interface Preset extends JobSettings {
  readonly name: string;
  readonly pens: PenSetup;
  readonly layers: Pick<
    PrepareSettings,
    "layers" | "hiddenLayers" | "shownLayers" | "layerOrder" | "layerRepeats" | "layerHatches"
  >;
}

export const presetSchema = z.object({
  name: z.string().trim().min(1).max(60),
  motion: motionSettingsSchema,
  pen: penSettingsSchema,
  pens: z.object({ pens, layerPens, penStops, layerStops }),
  layers: z.object({
    layers: prepare.layers,
    hiddenLayers: prepare.hiddenLayers,
    shownLayers: prepare.shownLayers,
    layerOrder: prepare.layerOrder,
    layerRepeats: prepare.layerRepeats,
    layerHatches: prepare.layerHatches,
  }),
}) satisfies z.ZodType<Preset>;

export const MAX_PRESETS = 100;

export interface PlotterSettings {
  /** Without the heights of single layers, which belong to a drawing. */
  readonly pen: Omit<PenSettings, "layers">;
  readonly pens: readonly PlotPen[];
  readonly presets: readonly Preset[];
}

export const plotterSettingsSchema: z.ZodType<PlotterSettings> = z.object({
  pen: plotterPenSchema,
  pens,
  presets: z.array(presetSchema).max(MAX_PRESETS).default([]),
});

/** What jobs and moves by hand of a plotter start from, and the presets that may be laid over it. */
export interface PlotterDefaults {
  readonly settings: PlotSettings;
  readonly isModelSet: boolean;
  readonly presets: readonly { readonly name: string; readonly settings: GivenSettings }[];
}
export const plotterDefaultsSchema: z.ZodType<PlotterDefaults> = z.object({
  /** Complete: its model, heights and pens, and the defaults of all other settings. */
  settings: plotSettingsSchema,
  /** False: the model is that of its last job, at first an AxiDraw V3. */
  isModelSet: z.boolean(),
  /** Each as settings to give with a job. */
  presets: z.array(z.object({ name: z.string(), settings: givenSettingsSchema })),
});

/** The plotter's part of a drawing's settings. */
export function plotterPartOf(settings: PlotSettings): Pick<PlotterSettings, "pen" | "pens"> {
  // Parsing leaves out `layers`.
  return { pen: plotterPenSchema.parse(settings.pen), pens: settings.pens };
}

/** The settings of a drawing for some other plotter: without this plotter's heights, and only with the pens it needs. */
export function withoutPlotterPart({ pen, pens, ...settings }: PlotSettings): GivenSettings {
  const used = new Set(Object.values(settings.layerPens));
  return { ...settings, pen: { layers: pen.layers }, pens: pens.filter(({ id }) => used.has(id)) };
}

/**
 * The settings with a plotter's own heights and pens. Pens that layers of the drawing use and the plotter does not
 * have are kept.
 */
export function withPlotterPart(
  settings: PlotSettings,
  { pen, pens }: Pick<PlotterSettings, "pen" | "pens">,
): PlotSettings {
  const { layers } = settings.pen;
  const used = new Set(Object.values(settings.layerPens));
  const others = settings.pens.filter(({ id }) => used.has(id) && !pens.some((own) => own.id === id));
  return {
    ...settings,
    pen: layers === undefined ? pen : { ...pen, layers },
    pens: [...pens, ...others],
  };
}

/** The settings with those of a preset. */
export const fromPreset = (settings: PlotSettings, { motion, pen, pens, layers }: Preset): PlotSettings => ({
  ...settings,
  motion: withoutShaperIfUnmeasured(motion, findMachine(settings)?.springs ?? null),
  pen,
  ...pens,
  prepare: { ...settings.prepare, ...layers },
});

/** A preset as settings to give with a job on a plotter with these settings. */
export const presetAsGiven = (settings: PlotSettings, preset: Preset): GivenSettings => {
  const { motion } = fromPreset(settings, preset);
  return withOffs({ motion, pen: preset.pen, ...preset.pens, prepare: preset.layers });
};

/** The list with the preset at the end, in place of one of the same name. */
export const withPreset = (
  presets: readonly Preset[],
  name: string,
  settings: PlotSettings,
): PlotterSettings["presets"] => {
  const { motion, pen, pens, layerPens, penStops, layerStops } = settings;
  const { layers, hiddenLayers, shownLayers, layerOrder, layerRepeats, layerHatches } = settings.prepare;
  const preset = {
    name: name.trim(),
    motion,
    pen,
    pens: { pens, layerPens, penStops, layerStops },
    layers: { layers, hiddenLayers, shownLayers, layerOrder, layerRepeats, layerHatches },
  };
  return [...withoutPreset(presets, preset.name), preset].slice(-MAX_PRESETS);
};

/** @param name without blanks around it */
export const withoutPreset = (presets: readonly Preset[], name: string): PlotterSettings["presets"] =>
  presets.filter((preset) => preset.name !== name);

/** The preset with that name, in any case. Throws `bad-setting` with the names that there are. */
export function presetNamed(presets: readonly Preset[], wanted: string): Preset {
  const name = wanted.trim();
  const found =
    presets.find((preset) => preset.name === name) ??
    presets.find((preset) => preset.name.toLowerCase() === name.toLowerCase());
  if (found !== undefined) return found;
  const known = presets.map((preset) => preset.name).join(", ");
  const all = known === "" ? "It has none." : `It has ${known}.`;
  throw new PlotwrightError("bad-setting", `The plotter has no preset ${JSON.stringify(name)}. ${all}`);
}
