/** The settings of paper, margins and sheets, and of the drawing's place on them. */
import type { SettingsTable } from "./setting.js";

const MIRROR_MODES = ["none", "leftRight", "upDown"] as const;
export type MirrorMode = (typeof MIRROR_MODES)[number];

const OUTSIDE_MODES = ["refuse", "cut", "move", "fit", "allow"] as const;
export type OutsideMode = (typeof OUTSIDE_MODES)[number];

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
  widthMm: { ...paperSide, label: "Width", default: 210 },
  heightMm: { ...paperSide, label: "Height", default: 297 },
} as const satisfies SettingsTable;

/** How many sheets the drawing is spread over, in one direction. */
const sheetCount = {
  kind: "number",
  group: "paper",
  default: 1,
  min: 1,
  max: 20,
  isWhole: true,
  unit: "",
  step: 1,
  digits: 0,
} as const;

/** The first rows of `PREPARE_TABLE`. */
export const PLACEMENT_ROWS = {
  landscape: {
    kind: "switch",
    label: "Landscape",
    aboutOff: "use a named paper size in portrait",
    flag: "--landscape",
    group: "paper",
    isCommon: true,
    default: true,
  },
  marginMm: {
    kind: "number",
    label: "Margin",
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
    flag: "--outside",
    group: "paper",
    isCommon: true,
    default: "refuse",
    choices: OUTSIDE_MODES,
  },
  rotateDeg: {
    kind: "number",
    label: "Rotate",
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
    flag: "--mirror",
    group: "paper",
    default: "none",
    choices: MIRROR_MODES,
  },
  clipToMargins: {
    kind: "switch",
    label: "Cut off what lies outside the margins",
    aboutOff: "draw over the margins",
    flag: "--clip",
    group: "paper",
    default: false,
  },
  cropToPage: {
    kind: "switch",
    label: "Cut off what lies outside the file’s page",
    flag: "--crop-to-page",
    group: "paper",
    default: false,
  },
  tileColumns: {
    ...sheetCount,
    label: "Sheets across",
    flag: "--tile-columns",
  },
  tileRows: {
    ...sheetCount,
    label: "Sheets down",
    flag: "--tile-rows",
  },
  tileOverlapMm: {
    kind: "number",
    label: "Overlap of the sheets",
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
    aboutOff: "draw no marks for cutting the sheets",
    flag: "--tile-marks",
    group: "paper",
    default: true,
  },
  tile: {
    kind: "number",
    label: "Sheets to plot",
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
} as const satisfies SettingsTable;

const { marginMm } = PLACEMENT_ROWS;

/** One margin per side. */
export const MARGINS_TABLE = {
  topMm: { ...marginMm },
  rightMm: { ...marginMm },
  bottomMm: { ...marginMm },
  leftMm: { ...marginMm },
} as const satisfies SettingsTable;
