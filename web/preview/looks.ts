/** How each way of looking at a drawing colours its strokes, and how wide it draws them. */
import { meanScale, penOf, settingsIdOf, type StrokeLayer } from "../../src/internal.js";
import { layerColor } from "../scene/color-map.js";
import type { ColorMode } from "../scene/color-mode.js";
import { ASKED_COLOR, INK_COLOR } from "../scene/renderer.js";
import type { PageState } from "../state/store.js";
import type { Planned } from "../worker/protocol.js";

/** Where neither the file nor a pen says how wide a line is. */
const DEFAULT_LINE_MM = 0.35;
const SWING_LINE_MM = 0.1;
/** Widths are shown in steps of this, which is what the graphics card can tell apart. */
const STEP_MM = 0.05;

export interface LayerLook {
  /** "#rrggbb" */
  readonly color: string;
  readonly widthMm: number;
}

interface Looked {
  readonly planned: Planned;
  readonly settings: PageState["settings"];
}

/** By index in `drawnLayers`. */
export const layerLooks = (colorBy: ColorMode, { planned, settings }: Looked): LayerLook[] => {
  const areColorsTold =
    new Set(planned.drawnLayers.map(({ color }) => color)).size === planned.drawnLayers.length;
  return planned.drawnLayers.map((layer, index) => {
    const pen = penOf(settings, layer);
    const penMm = pen?.widthMm ?? DEFAULT_LINE_MM;
    // Thin, so that what was asked can be seen beside it.
    if (colorBy === "swing") return { color: ASKED_COLOR, widthMm: SWING_LINE_MM };
    if (colorBy === "ink") {
      return { color: layer.color ?? INK_COLOR, widthMm: stepped(fileWidthMm(planned, layer) ?? penMm) };
    }
    if (colorBy === "pen") {
      return { color: pen?.color ?? layer.color ?? INK_COLOR, widthMm: stepped(penMm) };
    }
    // These show structure: a line takes up no more than half of the room that it has.
    return {
      // Layers of one colour could not be told apart by it.
      color: (areColorsTold ? layer.color : null) ?? layerColor(index),
      widthMm: stepped(Math.min(penMm, planned.lineGapMm / 2)),
    };
  });
};

/** Of the layer's lines on this paper, as the file draws them; null where it does not say. */
const fileWidthMm = ({ layers, pageToPaper }: Planned, layer: StrokeLayer): number | null => {
  const widthMm = layers.find(({ id }) => id === settingsIdOf(layer))?.strokeWidthMm ?? 0;
  return widthMm > 0 ? widthMm * meanScale(pageToPaper) : null;
};

const stepped = (mm: number): number => STEP_MM * Math.max(1, Math.round(mm / STEP_MM));

/** Lines are thinned from afar in looks that show structure, and as wide as on paper in the others. */
export const isTrueToWidth = (colorBy: ColorMode): boolean => colorBy === "ink" || colorBy === "pen";

/** A line of the legend. */
export interface LegendEntry {
  readonly color: string;
  readonly label: string;
}

/** Layers, pens or inks with the colours that they are shown in, each once. `labelOf` has the words. */
export const legendEntries = (
  looked: Looked,
  colorBy: ColorMode,
  labelOf: (layer: StrokeLayer, look: LayerLook) => string,
): LegendEntry[] => {
  const looks = layerLooks(colorBy, looked);
  const entries = looked.planned.drawnLayers.map((layer, index) => ({
    color: looks[index].color,
    label: labelOf(layer, looks[index]),
  }));
  const keyOf = ({ color, label }: LegendEntry): string => `${color} ${label}`;
  return [...new Map(entries.map((entry) => [keyOf(entry), entry])).values()];
};
