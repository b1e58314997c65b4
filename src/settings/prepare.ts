import type { PaperSize } from "../drawing/paper.js";
import { defaultsOf, type NumberSetting, type SettingsTable } from "./setting.js";
import type { FourMargins, HatchSettings, PaperSettings, PrepareValues } from "./values.js";

export type { FourMargins, HatchSettings } from "./values.js";

const LAYER_MODES = ["group", "sublayer", "stroke", "all"] as const;
export type LayerMode = (typeof LAYER_MODES)[number];

export const ORDER_MODES = ["none", "fast", "best"] as const;

const MIRROR_MODES = ["none", "leftRight", "upDown"] as const;
export type MirrorMode = (typeof MIRROR_MODES)[number];

const OUTSIDE_MODES = ["refuse", "cut", "move", "fit", "allow"] as const;
export type OutsideMode = (typeof OUTSIDE_MODES)[number];

const SPREAD_MODES = ["none", "interleave", "shuffle"] as const;
export type SpreadMode = (typeof SPREAD_MODES)[number];

/** Where the drawing's bounding box is placed, mm from the paper's top left corner. */
export interface PlacedBox {
  /** From the left edge. */
  readonly xMm: number;
  /** From the top edge. */
  readonly yMm: number;
  /** If one is null, the drawing keeps its proportions. If both are null, it has its true size. */
  readonly widthMm: number | null;
  readonly heightMm: number | null;
  /** A clockwise rotation about the box's centre, applied last. */
  readonly turnDeg?: number | undefined;
}

/** An offset on the paper, mm. */
export interface ShiftMm {
  /** To the right. */
  readonly xMm: number;
  /** Down. */
  readonly yMm: number;
}

const paperSide = { kind: "number", min: 1, max: 5_000, unit: "mm", step: 1 } as const;

/** Custom paper size, portrait. */
export const PAPER_TABLE = {
  widthMm: { ...paperSide, label: "Width", about: "width of the paper in portrait", default: 210 },
  heightMm: { ...paperSide, label: "Height", about: "height of the paper in portrait", default: 297 },
} as const satisfies SettingsTable;

export const HATCH_TABLE = {
  spacingMm: {
    kind: "number",
    label: "Pen width",
    about: "fill areas with lines this far apart; 0 leaves them empty",
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
    about: "direction of the hatch lines, clockwise from the x axis",
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
    about: "hatch in both directions",
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
  landscape: {
    kind: "switch",
    label: "Landscape",
    words: "portrait, orientation",
    about: "use a named paper size in landscape",
    aboutOff: "use a named paper size in portrait",
    flag: "--landscape",
    group: "paper",
    isCommon: true,
    default: true,
  },
  marginMm: {
    kind: "number",
    label: "Margin",
    words: "border, edge, padding",
    about: "free edge around the drawing",
    flag: "--margin",
    group: "paper",
    isCommon: true,
    default: 15,
    min: 0,
    max: 1_000,
    unit: "mm",
    step: 1,
    slider: [0, 60],
  },
  fit: {
    kind: "switch",
    label: "Fit paper",
    words: "scale, size, zoom, fit to page, true size",
    about: "scale the drawing to the paper inside the margins",
    aboutOff: "draw at true size, page corner on paper corner",
    aboutAuto: "true size if the file's page fits the paper, otherwise fitted",
    flag: "--fit",
    group: "paper",
    isCommon: true,
    default: "auto",
  },
  pxPerInch: {
    kind: "number",
    label: "Resolution of the file",
    words: "dpi, ppi, px per inch, pixels, scale",
    about: "size of the px of a file whose page is given in px",
    aboutAuto: "guessed from the program that wrote the file, otherwise 96",
    flag: "--px-per-inch",
    group: "paper",
    default: "auto",
    min: 1,
    max: 10_000,
    unit: "px/in",
    step: 1,
  },
  outside: {
    kind: "choice",
    label: "What lies outside the paper",
    words: "crop, clip, overflow",
    about:
      "if the drawing leaves the paper: plot nothing, cut it off at the edge, move it onto the paper, fit it to the paper, or draw it",
    flag: "--outside",
    group: "paper",
    isCommon: true,
    default: "refuse",
    choices: OUTSIDE_MODES,
  },
  rotateDeg: {
    kind: "number",
    label: "Rotate",
    words: "turn, angle",
    about: "turn the drawing clockwise about its middle, before fitting",
    aboutAuto: "90 if the file's page fits the paper only that way, otherwise 0",
    flag: "--rotate",
    group: "paper",
    isCommon: true,
    default: "auto",
    min: -360,
    max: 360,
    unit: "°",
    step: 1,
  },
  mirror: {
    kind: "choice",
    label: "Mirror",
    words: "flip, reflect, reverse",
    about: "mirror the drawing",
    flag: "--mirror",
    group: "paper",
    default: "none",
    choices: MIRROR_MODES,
  },
  clipToMargins: {
    kind: "switch",
    label: "Cut off what lies outside the margins",
    words: "clip, crop, mask",
    about: "cut off what lies outside the margins",
    aboutOff: "draw over the margins",
    flag: "--clip",
    group: "paper",
    default: false,
  },
  cropToPage: {
    kind: "switch",
    label: "Cut off what lies outside the file’s page",
    words: "clip, crop, artboard",
    about: "cut off what lies outside the file's own page",
    flag: "--crop-to-page",
    group: "paper",
    default: false,
  },
  tileColumns: {
    kind: "number",
    label: "Sheets across",
    words: "tiles, tiling, poster, large, several sheets, columns",
    about: "spread the drawing over this many sheets beside each other",
    flag: "--tile-columns",
    group: "paper",
    default: 1,
    min: 1,
    max: 20,
    isWhole: true,
    unit: "",
    step: 1,
    digits: 0,
  },
  tileRows: {
    kind: "number",
    label: "Sheets down",
    words: "tiles, tiling, poster, large, several sheets, rows",
    about: "spread the drawing over this many sheets below each other",
    flag: "--tile-rows",
    group: "paper",
    default: 1,
    min: 1,
    max: 20,
    isWhole: true,
    unit: "",
    step: 1,
    digits: 0,
  },
  tileOverlapMm: {
    kind: "number",
    label: "Overlap of the sheets",
    words: "tiles, glue",
    about: "how much of the drawing neighbouring sheets share",
    flag: "--tile-overlap",
    group: "paper",
    default: 10,
    min: 0,
    max: 500,
    unit: "mm",
    step: 1,
  },
  tileMarks: {
    kind: "switch",
    label: "Marks for cutting the sheets",
    words: "tiles, crop marks, registration",
    about: "with several sheets: draw marks in the margins that show where to cut",
    aboutOff: "draw no marks for cutting the sheets",
    flag: "--tile-marks",
    group: "paper",
    default: true,
  },
  tile: {
    kind: "number",
    label: "Sheets to plot",
    words: "tiles, one sheet again",
    about: "which of several sheets is plotted, counted row by row; 0: all of them, one after the other",
    flag: "--tile",
    group: "paper",
    default: 0,
    min: 0,
    max: 400,
    isWhole: true,
    unit: "",
    step: 1,
    digits: 0,
  },
  outlineFills: {
    kind: "switch",
    label: "Draw the outline of filled shapes",
    words: "stroke, border",
    about: "draw the outline of shapes that are only filled",
    flag: "--outline-fills",
    group: "drawing",
    default: true,
  },
  hatchOutlines: {
    kind: "switch",
    label: "Fill closed outlines too",
    about: "when hatching: fill closed lines too, not only filled shapes",
    flag: "--hatch-outlines",
    group: "drawing",
    default: false,
  },
  hideCovered: {
    kind: "switch",
    label: "Hide lines under filled shapes",
    words: "occlusion, hidden lines, overlap",
    about: "leave out lines under shapes that are painted later",
    flag: "--hide-covered",
    group: "drawing",
    isCommon: true,
    default: false,
  },
  joinMm: {
    kind: "number",
    label: "Join ends closer than",
    words: "merge lines, connect, weld",
    about: "join ends that are closer than this",
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
    words: "filter, tiny, dots, remove short",
    about: "leave out strokes shorter than this; 0 keeps dots too",
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
    words: "duplicates, double lines, deduplicate",
    about: "leave out lines already drawn within this distance; 0 keeps all",
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
    words: "reduce points, optimise, optimize",
    about: "drop points closer than this to the line (Douglas–Peucker)",
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
    words: "flatten, resolution, segments, tolerance",
    about: "maximum gap between a curve and its chords, on paper",
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
    words: "soften",
    about: "rounds of corner cutting (Chaikin); each round doubles the number of points",
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
    about: "begin closed strokes at a random point",
    flag: "--reloop",
    panel: "lines",
    default: false,
  },
  order: {
    kind: "choice",
    label: "Order of strokes",
    words: "sort, optimise, optimize, travel, reorder",
    about: "order of strokes",
    flag: "--order",
    isCommon: true,
    default: "fast",
    choices: ORDER_MODES,
  },
  orderS: {
    kind: "number",
    label: "Search time",
    about: "how long the search for the best order may take",
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
    words: "shuffle, smear, bleed",
    about: "draw neighbouring strokes at different times, so that ink dries",
    flag: "--spread",
    default: "none",
    choices: SPREAD_MODES,
  },
  reinkMm: {
    kind: "number",
    label: "Take up ink every",
    words: "refill, dip, brush, paint",
    about: "stop after this length of drawing, to take up ink; 0: never",
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
    words: "groups, colours, colors, sublayers",
    about: "what makes a layer",
    flag: "--layers",
    group: "drawing",
    default: "group",
    choices: LAYER_MODES,
  },
} as const satisfies SettingsTable;

const { marginMm } = PREPARE_TABLE;

/** One margin per side. */
export const MARGINS_TABLE = {
  topMm: { ...marginMm, about: "free edge at the top of the paper" },
  rightMm: { ...marginMm, about: "free edge at the right of the paper" },
  bottomMm: { ...marginMm, about: "free edge at the bottom of the paper" },
  leftMm: { ...marginMm, about: "free edge at the left of the paper" },
} as const satisfies SettingsTable;

/** How often a layer is drawn, in `layerRepeats`. */
export const LAYER_REPEATS = {
  kind: "number",
  label: "Draw it",
  about: "how often the layer is drawn",
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
