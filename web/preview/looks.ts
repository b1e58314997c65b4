/** Colours and line widths of the strokes in each look. */
import { meanScale, penOf, settingsIdOf, type StrokeLayer } from "../../src/internal.js";
import { layerColor } from "../scene/color-map.js";
import type { ColorMode } from "../scene/color-mode.js";
import { ASKED_COLOR, INK_COLOR } from "../scene/renderer.js";
import type { PageState } from "../state/store.js";
import type { Planned } from "../worker/protocol.js";

/** Line width if neither the file nor a pen has one. */
const DEFAULT_LINE_MM = 0.35;
const SWING_LINE_MM = 0.1;
/** Widths are rounded to this, which is the resolution of the graphics card's palette. */
const STEP_MM = 0.05;

export interface LayerLook {
  /** "#rrggbb" */
  readonly color: string;
  readonly widthMm: number;
}

interface LookInput {
  readonly planned: Planned;
  readonly settings: PageState["settings"];
}

/** By index in `drawnLayers`. */
export const layerLooks = (colorBy: ColorMode, { planned, settings }: LookInput): LayerLook[] => {
  const haveOwnColors =
    new Set(planned.drawnLayers.map(({ color }) => color)).size === planned.drawnLayers.length;
  return planned.drawnLayers.map((layer, index) => {
    const pen = penOf(settings, layer);
    const penMm = pen?.widthMm ?? DEFAULT_LINE_MM;
    // Thin, so that the planned line is visible beside it.
    if (colorBy === "swing") return { color: ASKED_COLOR, widthMm: SWING_LINE_MM };
    if (colorBy === "ink") {
      return { color: layer.color ?? INK_COLOR, widthMm: stepped(fileWidthMm(planned, layer) ?? penMm) };
    }
    if (colorBy === "pen") {
      return { color: pen?.color ?? layer.color ?? INK_COLOR, widthMm: stepped(penMm) };
    }
    // These looks show structure: a line is at most half as wide as the distance to the next one.
    return {
      // If two layers have the same colour, all layers get other colours.
      color: (haveOwnColors ? layer.color : null) ?? layerColor(index),
      widthMm: stepped(Math.min(penMm, planned.lineGapMm / 2)),
    };
  });
};

/** Width of the layer's lines on this paper by the file; null: the file has none. */
const fileWidthMm = ({ layers, pageToPaper }: Planned, layer: StrokeLayer): number | null => {
  const widthMm = layers.find(({ id }) => id === settingsIdOf(layer))?.strokeWidthMm ?? 0;
  return widthMm > 0 ? widthMm * meanScale(pageToPaper) : null;
};

const stepped = (mm: number): number => STEP_MM * Math.max(1, Math.round(mm / STEP_MM));

/** Whether lines are as wide as on paper. Otherwise the look shows structure, and lines are thinner when zoomed out. */
export const isTrueToWidth = (colorBy: ColorMode): boolean => colorBy === "ink" || colorBy === "pen";

/** A line of the legend. */
interface LegendEntry {
  readonly color: string;
  readonly label: string;
}

/** Layers, pens or inks with their colours, each once. */
export const legendEntries = (
  input: LookInput,
  colorBy: ColorMode,
  labelOf: (layer: StrokeLayer, look: LayerLook) => string,
): LegendEntry[] => {
  const looks = layerLooks(colorBy, input);
  const entries = input.planned.drawnLayers.map((layer, index) => ({
    color: looks[index].color,
    label: labelOf(layer, looks[index]),
  }));
  const keyOf = ({ color, label }: LegendEntry): string => `${color} ${label}`;
  return [...new Map(entries.map((entry) => [keyOf(entry), entry])).values()];
};
