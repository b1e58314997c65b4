/**
 * What the colours of the strokes in the preview mean. A view mode is one record here: the buttons, the legend, the
 * renderers, and what the browser remembers follow from it.
 */
import type { ComponentType } from "react";
import {
  listColor,
  meanScale,
  penOf,
  rampColor,
  settingsIdOf,
  type PlotPen,
  type StrokeLayer,
} from "../../src/internal.js";
import { ASKED_COLOR, INK_COLOR, type Frame, type Picture } from "../scene/renderer.js";
import { usualSpeeds, withSpeeds, withTimes, type Scene, type SpeedRange } from "../scene/scene.js";
import type { PageState } from "../state/store.js";
import { formatDuration, formatNumber } from "../ui/format.js";
import { lazyPart } from "../ui/lazy-part.js";
import type { Planned } from "../worker/protocol.js";
import { ListLegend, Ramp, scaleLabels } from "./legends/legend.js";

export interface ViewMode {
  /** Remembered by the browser. */
  readonly id: string;
  readonly label: string;
  /** What gives a piece its colour: its two values or its time, both on the colour ramp, or its layer. */
  readonly colorBy: Frame["colorBy"];
  /** Moves with the pen up are always shown. */
  readonly showsTravel?: boolean;
  /** Lines are as wide as on paper. Otherwise the mode shows structure, and lines are thinner when zoomed out. */
  readonly isTrueToWidth: boolean;
  /** Colours and line widths of the layers, by index in `drawnLayers`. */
  readonly layerLooks: (shown: ModeInput) => LineLook[];
  /**
   * The pieces, if their values are not their speeds. Null while they are computed: the planned pieces are shown
   * in the colours of `layerLooks`.
   */
  readonly picture?: (state: PageState) => Picture | null;
  /** Says what the colours mean. */
  readonly Legend: ComponentType<ModeInput>;
}

/** What is drawn in a view mode. */
export interface ModeInput {
  readonly planned: Planned;
  readonly settings: PageState["settings"];
}

interface LineLook {
  /** "#rrggbb" */
  readonly color: string;
  readonly widthMm: number;
}

/** Line width if neither the file nor a pen has one. */
const DEFAULT_LINE_MM = 0.35;
/** Widths are rounded to this, which is the resolution of the graphics card's palette. */
const STEP_MM = 0.05;

/** The looks of all layers; `penMm` is the width of the layer's pen. */
const looksOf = (
  { planned, settings }: ModeInput,
  lookOf: (layer: StrokeLayer, index: number, pen: PlotPen | null, penMm: number) => LineLook,
): LineLook[] =>
  planned.drawnLayers.map((layer, index) => {
    const pen = penOf(settings, layer);
    const { color, widthMm } = lookOf(layer, index, pen, pen?.widthMm ?? DEFAULT_LINE_MM);
    return { color, widthMm: STEP_MM * Math.max(1, Math.round(widthMm / STEP_MM)) };
  });

/** Shows structure: a line is at most half as wide as the distance to the next one. */
const structureLooks = (shown: ModeInput): LineLook[] => {
  const { drawnLayers, lineGapMm } = shown.planned;
  const haveOwnColors = new Set(drawnLayers.map(({ color }) => color)).size === drawnLayers.length;
  return looksOf(shown, ({ color }, index, _pen, penMm) => ({
    // If two layers have the same colour, all layers get other colours.
    color: (haveOwnColors ? color : null) ?? listColor(index),
    widthMm: Math.min(penMm, lineGapMm / 2),
  }));
};

/** The legend of a mode that colours by layer. `labelOf` gets the layer and its line's width as text. */
const layerLegend = (
  title: string,
  layerLooks: ViewMode["layerLooks"],
  labelOf: (layer: StrokeLayer, widthMm: string, settings: ModeInput["settings"]) => string,
): ComponentType<ModeInput> =>
  function LayerLegend(shown) {
    const looks = layerLooks(shown);
    const entries = shown.planned.drawnLayers.map((layer, index) => {
      const { color, widthMm } = looks[index];
      return { color, label: labelOf(layer, formatNumber(widthMm, 2), shown.settings) };
    });
    return <ListLegend title={title} entries={entries} />;
  };

const SPEED: ViewMode = {
  id: "speed",
  label: "Speed",
  colorBy: "value",
  isTrueToWidth: false,
  layerLooks: structureLooks,
  picture: ({ planned }) => planned && speedsOf(planned.scene).picture,
  Legend: ({ planned }) => <SpeedLegend scene={planned.scene} />,
};

interface Speeds {
  readonly range: SpeedRange;
  readonly picture: Picture;
}
const speeds = new WeakMap<Scene, Speeds>();

const speedsOf = (scene: Scene): Speeds => {
  const known = speeds.get(scene);
  if (known) return known;
  const range = usualSpeeds(scene);
  const found = { range, picture: withSpeeds(scene, range) };
  speeds.set(scene, found);
  return found;
};

const STOPS = 17;

/** `data-stops` is the scale as JSON, for programs that read the page. */
const SpeedLegend = ({ scene }: { scene: Scene }) => {
  const { from, to } = speedsOf(scene).range;
  const [lowest, highest] = [from * scene.topDrawMmPerS, to * scene.topDrawMmPerS];
  const stops = Array.from({ length: STOPS }, (_, i) => {
    const share = i / (STOPS - 1);
    return { mmPerS: Number((lowest + share * (highest - lowest)).toFixed(3)), color: rampColor(share) };
  });
  const labels = scaleLabels(lowest, highest, highest < 10 ? 1 : 0);
  // What is slower or faster has the colours of the ends.
  if (from > 0) labels[0] = `≤ ${labels[0]}`;
  if (to < 1) labels[labels.length - 1] = `≥ ${labels.at(-1)}`;
  return (
    <figure className="legend" role="img" aria-label="Speed legend" data-stops={JSON.stringify(stops)}>
      <Ramp title="Speed with the pen down" unit="mm/s" labels={labels} />
    </figure>
  );
};

const timePictures = new WeakMap<Scene, Picture>();

/** Where the minutes go, and what would save some of them. */
const TIME: ViewMode = {
  id: "time",
  label: "Time",
  colorBy: "value",
  showsTravel: true,
  isTrueToWidth: false,
  layerLooks: structureLooks,
  picture: ({ planned }) => {
    if (!planned) return null;
    const picture = timePictures.get(planned.scene) ?? withTimes(planned.scene);
    timePictures.set(planned.scene, picture);
    return picture;
  },
  Legend: lazyPart<ModeInput>(async () => (await import("./legends/time-legend.js")).TimeLegend),
};

const fileLooks = (shown: ModeInput): LineLook[] =>
  looksOf(shown, (layer, _index, _pen, penMm) => ({
    color: layer.color ?? INK_COLOR,
    widthMm: fileWidthMm(shown.planned, layer) ?? penMm,
  }));

/** Width of the layer's lines on this paper by the file; null: the file has none. */
const fileWidthMm = ({ layers, pageToPaper }: Planned, layer: StrokeLayer): number | null => {
  const widthMm = layers.find(({ id }) => id === settingsIdOf(layer))?.strokeWidthMm ?? 0;
  return widthMm > 0 ? widthMm * meanScale(pageToPaper) : null;
};

const INK: ViewMode = {
  id: "ink",
  label: "Ink",
  colorBy: "layer",
  isTrueToWidth: true,
  layerLooks: fileLooks,
  Legend: layerLegend("Colours and widths of the file", fileLooks, ({ color }, mm) =>
    ofWidth(color ?? "No colour", mm),
  ),
};

const LAYER: ViewMode = {
  id: "layer",
  label: "Layer",
  colorBy: "layer",
  isTrueToWidth: false,
  layerLooks: structureLooks,
  Legend: layerLegend("Layers, in the order they are drawn", structureLooks, ({ name }) => name),
};

const ORDER: ViewMode = {
  id: "order",
  label: "Order",
  colorBy: "time",
  isTrueToWidth: false,
  layerLooks: structureLooks,
  Legend: ({ planned: { scene } }) => (
    <figure className="legend">
      <Ramp title={`Order, first to last over ${formatDuration(scene.totalS)}`} labels={["first", "last"]} />
    </figure>
  ),
};

/** The colours and widths of the pens. */
export const penLooks = (shown: ModeInput): LineLook[] =>
  looksOf(shown, (layer, _index, pen, penMm) => ({
    color: pen?.color ?? layer.color ?? INK_COLOR,
    widthMm: penMm,
  }));

const PEN: ViewMode = {
  id: "pen",
  label: "Pen",
  colorBy: "layer",
  isTrueToWidth: true,
  layerLooks: penLooks,
  Legend: layerLegend("Colours and widths of your pens", penLooks, (layer, mm, settings) => {
    const pen = penOf(settings, layer);
    return pen ? ofWidth(pen.name, mm) : `No pen for ${layer.name}`;
  }),
};

/** The line that a pen on a swinging machine draws, coloured by its distance from the planned line. */
const SWING: ViewMode = {
  id: "swing",
  label: "Pen (simulated)",
  colorBy: "value",
  isTrueToWidth: false,
  // Thin, so that the planned line is visible beside it.
  layerLooks: (shown) => looksOf(shown, () => ({ color: ASKED_COLOR, widthMm: 0.1 })),
  picture: ({ swing, planned }) => (swing !== null && swing.of === planned ? swing.picture : null),
  Legend: lazyPart<ModeInput>(async () => (await import("./legends/swing-legend.js")).SwingLegend),
};

const ofWidth = (name: string, mm: string): string => `${name}, ${mm} mm`;

/** In the order of their buttons. The first is shown on a first visit. */
export const VIEW_MODES: readonly ViewMode[] = [INK, SPEED, TIME, ORDER, LAYER, PEN, SWING];

/** A browser may remember a mode that this version does not have. */
export const viewModeOf = ({ view }: PageState): ViewMode =>
  VIEW_MODES.find(({ id }) => id === view.viewMode) ?? VIEW_MODES[0];
