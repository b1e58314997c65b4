/** Which settings stay when another drawing is opened. Not in layer-settings.ts, because that is loaded later. */
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../src/schema/index.js";

/** Layers identified by a colour mean the same in every drawing. */
const isColorId = (id: string): boolean => /^#[0-9a-f]{6}$/.test(id);

/**
 * The settings for another drawing: without those of single layers, except layers identified by a colour, and without
 * the answer to what happens outside the paper, and without the resolution of the file.
 */
export const forOtherDrawing = (settings: PlotSettings): PlotSettings => {
  const kept = <T>(byLayer: Readonly<Record<string, T>> | undefined): Record<string, T> =>
    Object.fromEntries(Object.entries(byLayer ?? {}).filter(([id]) => isColorId(id)));
  const { motion, pen, prepare } = settings;
  return {
    ...settings,
    prepare: {
      ...prepare,
      outside: DEFAULT_PLOT_SETTINGS.prepare.outside,
      pxPerInch: DEFAULT_PLOT_SETTINGS.prepare.pxPerInch,
      hiddenLayers: [],
      shownLayers: [],
      layerOrder: prepare.layerOrder.filter(isColorId),
      layerRepeats: kept(prepare.layerRepeats),
      layerHatches: prepare.layerHatches.filter(({ layer }) => isColorId(layer)),
    },
    motion: motion.layers ? { ...motion, layers: kept(motion.layers) } : motion,
    pen: pen.layers ? { ...pen, layers: kept(pen.layers) } : pen,
    layerPens: kept(settings.layerPens),
    layerStops: kept(settings.layerStops),
  };
};
