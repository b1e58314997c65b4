/**
 * Presets: named settings, for example for a pen or a paper. They belong to the plotter and are stored on the server.
 */
import { findMachine, withoutShaperIfUnmeasured } from "../../src/internal.js";
import { MAX_PRESETS, type PlotSettings, type Preset } from "../../src/schema/index.js";

export const fromPreset = (settings: PlotSettings, { motion, pen, pens, layers }: Preset): PlotSettings => ({
  ...settings,
  motion: withoutShaperIfUnmeasured(motion, findMachine(settings)?.springs ?? null),
  pen,
  ...pens,
  prepare: { ...settings.prepare, ...layers },
});

/** The list with the preset at the end, in place of one of the same name. */
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
