/** The pen's settings. Heights are percent of the servo's range, 100 = highest. */
import { defaultsOf, type NumberSetting, type SettingsTable } from "./setting.js";
import type { LayerPen, PenRates, PenValues } from "./values.js";

export type { LayerPen } from "./values.js";

const height = { kind: "number", min: 0, max: 100, unit: "%", step: 1 } as const;
const extraWait = { kind: "number", default: 0, min: -500, max: 10_000, unit: "ms", step: 10 } as const;
const rate = {
  kind: "number",
  min: 0,
  minExcluded: true,
  max: 10_000,
  unit: "%/s",
  step: 5,
  slider: [10, 400],
} as const;

export const PEN_TABLE = {
  upPct: {
    ...height,
    label: "Height up",
    flag: "--pen-up",
    isCommon: true,
    default: 60,
    slider: [0, 100],
  },
  downPct: {
    ...height,
    label: "Height down",
    flag: "--pen-down",
    isCommon: true,
    default: 30,
    slider: [0, 100],
  },
  /** Added to the times of the machine's servo (src/machines/pen-servo.ts). Negative: the servo is faster by so much. */
  extraLiftMs: {
    ...extraWait,
    label: "Extra wait after lifting",
    flag: "--pen-extra-lift-ms",
  },
  extraDropMs: {
    ...extraWait,
    label: "Extra wait after lowering",
    flag: "--pen-extra-drop-ms",
  },
} as const satisfies SettingsTable;

/** Rates of lift and drop, if set. The default is the page's initial value. */
export const LIFT_RATE = {
  ...rate,
  label: "Lifting speed",
  default: 60,
} as const satisfies NumberSetting;
export const DROP_RATE = {
  ...rate,
  label: "Lowering speed",
  default: 60,
} as const satisfies NumberSetting;

export const PEN_OVERLAPS = ["off", "safe", "fast"] as const;
export type PenOverlap = (typeof PEN_OVERLAPS)[number];

/** Whether the carriage moves during pen moves (src/plan/pen/pen-flight.ts). */
export const OVERLAP_TABLE = {
  overlap: {
    kind: "choice",
    label: "Move while the pen lifts",
    flag: "--pen-overlap",
    default: "safe",
    choices: PEN_OVERLAPS,
  },
  /** Percent of the distance from down to up. */
  contactPct: {
    ...height,
    label: "Tip touches at",
    flag: "--pen-contact",
    default: 50,
    slider: [0, 100],
  },
  fullHeightMm: {
    kind: "number",
    label: "Full lift for travels from",
    flag: "--pen-full-height",
    default: 20,
    min: 0,
    max: 1_000,
    unit: "mm",
    step: 1,
  },
} as const satisfies SettingsTable;

/** A wait with the pen up before a layer's first stroke. */
export const LAYER_WAIT = {
  kind: "number",
  label: "Wait before the layer",
  default: 0,
  min: 0,
  max: 60_000,
  unit: "ms",
  step: 500,
} as const satisfies NumberSetting;

/** Pen heights, and what the carriage waits for the pen beside its servo's time. Start from `DEFAULT_PEN`. */
export interface PenSettings extends PenValues, PenRates {
  /** By layer id: heights and waits of that layer. */
  readonly layers?: Readonly<Record<string, LayerPen>> | undefined;
}

/** 60 % up, 30 % down, and the times of the machine's servo. */
export const DEFAULT_PEN: PenSettings = { ...defaultsOf(PEN_TABLE), ...defaultsOf(OVERLAP_TABLE) };

const offset = { kind: "number", default: 0, min: -100, max: 100, unit: "mm", step: 0.05 } as const;

/** A pen of the user's list: its line width, and its offset from the first pen. */
export const PLOT_PEN_TABLE = {
  widthMm: {
    kind: "number",
    label: "Line width",
    default: 0.4,
    min: 0,
    minExcluded: true,
    max: 50,
    unit: "mm",
    step: 0.05,
  },
  offsetXMm: { ...offset, label: "Draws too far right by" },
  offsetYMm: { ...offset, label: "Draws too far down by" },
} as const satisfies SettingsTable;
