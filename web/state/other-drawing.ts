/** Which settings stay when another drawing is opened. Not in layer-settings.ts, because that is loaded later. */
import { withoutFilesPage } from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";

/** Layers identified by a colour mean the same in every drawing. */
const isColorId = (id: string): boolean => /^#[0-9a-f]{6}$/.test(id);

/** The settings for another drawing: without those of single layers, except layers identified by a colour. */
export const forOtherDrawing = (settings: PlotSettings): PlotSettings => {
  const kept = <T>(byLayer: Readonly<Record<string, T>> | undefined): Record<string, T> =>
    Object.fromEntries(Object.entries(byLayer ?? {}).filter(([id]) => isColorId(id)));
  const { motion, pen } = settings;
  const prepare = withoutFilesPage(settings.prepare);
  return {
    ...settings,
    prepare: {
      ...prepare,
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
