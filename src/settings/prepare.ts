import type { PaperSize } from "../drawing/paper.js";
import { defaultsOf, type NumberSetting, type SettingsTable } from "./setting.js";
import { PAPER_TABLE, PLACEMENT_ROWS, type PlacedBox, type ShiftMm } from "./placement.js";
import type { FourMargins, HatchSettings, PaperSettings, PrepareValues } from "./values.js";

export type { FourMargins, HatchSettings } from "./values.js";

const LAYER_MODES = ["group", "sublayer", "stroke", "all"] as const;
export type LayerMode = (typeof LAYER_MODES)[number];

export const ORDER_MODES = ["none", "fast", "best"] as const;

const SPREAD_MODES = ["none", "interleave", "shuffle"] as const;
export type SpreadMode = (typeof SPREAD_MODES)[number];

export const HATCH_TABLE = {
  spacingMm: {
    kind: "number",
    label: "Pen width",
    flag: "--hatch",
    isCommon: true,
    default: 0,
    min: 0,
    max: 100,
    unit: "mm",
    step: 0.05,
    slider: [0.1, 5],
  },
  angleDeg: {
    kind: "number",
    label: "Angle",
    flag: "--hatch-angle",
    default: 45,
    min: -360,
    max: 360,
    unit: "°",
    step: 5,
    slider: [0, 180],
  },
  cross: {
    kind: "switch",
    label: "Hatch in both directions",
    flag: "--hatch-cross",
    default: false,
  },
} as const satisfies SettingsTable;

/** Hatch settings of one layer. */
export interface LayerHatch extends HatchSettings {
  /** Layer id. */
  readonly layer: string;
}

/** The settings of `prepare` that are a single number, switch or choice, in the order of the page. */
export const PREPARE_TABLE = {
  ...PLACEMENT_ROWS,
  outlineFills: {
    kind: "switch",
    label: "Draw the outline of filled shapes",
    flag: "--outline-fills",
    group: "drawing",
    default: true,
  },
  hatchOutlines: {
    kind: "switch",
    label: "Fill closed outlines too",
    flag: "--hatch-outlines",
    group: "drawing",
    default: false,
  },
  hideCovered: {
    kind: "switch",
    label: "Hide lines under filled shapes",
    flag: "--hide-covered",
    group: "drawing",
    isCommon: true,
    default: false,
  },
  joinMm: {
    kind: "number",
    label: "Join ends closer than",
    flag: "--join",
    isCommon: true,
    panel: "lines",
    default: 0.1,
    min: 0,
    max: 50,
    unit: "mm",
    step: 0.05,
    digits: 3,
  },
  dropShorterMm: {
    kind: "number",
    label: "Skip strokes shorter than",
    flag: "--drop-shorter",
    panel: "lines",
    default: 0,
    min: 0,
    max: 1_000,
    unit: "mm",
    step: 0.1,
    digits: 3,
  },
  dropRepeatsMm: {
    kind: "number",
    label: "Leave out repeats within",
    flag: "--drop-repeats",
    panel: "lines",
    default: 0,
    min: 0,
    max: 5,
    unit: "mm",
    step: 0.05,
    digits: 3,
  },
  simplifyMm: {
    kind: "number",
    label: "Simplify within",
    flag: "--simplify",
    panel: "lines",
    default: 0,
    min: 0,
    max: 5,
    unit: "mm",
    step: 0.01,
    digits: 3,
  },
  flattenMm: {
    kind: "number",
    label: "Curve smoothness",
    flag: "--flatten",
    panel: "lines",
    default: 0.02,
    min: 0.001,
    max: 5,
    unit: "mm",
    step: 0.01,
    digits: 3,
  },
  smoothRounds: {
    kind: "number",
    label: "Smoothing, rounds",
    flag: "--smooth",
    panel: "lines",
    default: 0,
    min: 0,
    max: 5,
    isWhole: true,
    unit: "",
    step: 1,
    digits: 0,
  },
  reloop: {
    kind: "switch",
    label: "Begin closed lines at a random point",
    flag: "--reloop",
    panel: "lines",
    default: false,
  },
  order: {
    kind: "choice",
    label: "Order of strokes",
    flag: "--order",
    isCommon: true,
    default: "fast",
    choices: ORDER_MODES,
  },
  orderS: {
    kind: "number",
    label: "Search time",
    flag: "--order-s",
    default: 9,
    min: 0,
    max: 3_600,
    unit: "s",
    step: 1,
  },
  spread: {
    kind: "choice",
    label: "Let ink dry",
    flag: "--spread",
    default: "none",
    choices: SPREAD_MODES,
  },
  reinkMm: {
    kind: "number",
    label: "Take up ink every",
    flag: "--reink",
    default: 0,
    min: 0,
    max: 1_000_000,
    unit: "mm",
    step: 100,
  },
  layers: {
    kind: "choice",
    label: "Layers from",
    flag: "--layers",
    group: "drawing",
    default: "group",
    choices: LAYER_MODES,
  },
} as const satisfies SettingsTable;

/** How often a layer is drawn, in `layerRepeats`. */
export const LAYER_REPEATS = {
  kind: "number",
  label: "Draw it",
  default: 1,
  min: 1,
  max: 20,
  isWhole: true,
  unit: "times",
  step: 1,
} as const satisfies NumberSetting;

/** How the drawing is placed on the paper and turned into strokes. Start from `DEFAULT_PREPARE`. */
export interface PrepareSettings extends PrepareValues {
  /** Portrait size; `landscape` rotates it. */
  readonly paper: PaperSettings;
  /** Layer ids to leave out. */
  readonly hiddenLayers: readonly string[];
  /** Layers to draw although their name begins with "%". */
  readonly shownLayers: readonly string[];
  /** Layer ids to draw first, in this order; the rest follow in the file's order. */
  readonly layerOrder: readonly string[];
  /** By layer id: how many times to draw it (a whole number, 1 to 20). Default once. */
  readonly layerRepeats: Readonly<Record<string, number>>;
  /** By layer id: an offset, applied last, that aligns a pen mounted off-centre with the others. */
  readonly layerShifts?: Readonly<Record<string, ShiftMm>> | undefined;
  /** One margin per side; null: `marginMm` on all sides. */
  readonly margins: FourMargins | null;
  /** Position and size, after rotating and mirroring; overrides `fit`. Null: `fit` applies. */
  readonly layout: PlacedBox | null;
  /** The machine's travel from home: lines outside are cut off. Null: nothing is cut off. */
  readonly reach: PaperSize | null;
  /** How areas are filled with lines. */
  readonly hatch: HatchSettings;
  /** Layers with their own hatch settings. */
  readonly layerHatches: readonly LayerHatch[];
}

/** A4 in landscape; true size if the file's page fits on it, otherwise fitted inside margins of 15 mm; no hatching. */
export const DEFAULT_PREPARE: PrepareSettings = {
  ...defaultsOf(PREPARE_TABLE),
  paper: defaultsOf(PAPER_TABLE),
  hiddenLayers: [],
  shownLayers: [],
  layerOrder: [],
  layerRepeats: {},
  margins: null,
  layout: null,
  reach: null,
  hatch: defaultsOf(HATCH_TABLE),
  layerHatches: [],
};
