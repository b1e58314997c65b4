import { MIN_SPEED_FACTOR } from "../drawing/drawing.js";
import { defaultsOf, type NumberSetting, type SettingsTable } from "./setting.js";
import type {
  AxisLimits,
  EaseSettings,
  FitSettings,
  LayerMotion,
  MotionLimits,
  MotionValues,
  TravelLimits,
} from "./values.js";

export type { AxisLimits, EaseSettings, FitSettings, LayerMotion, MotionLimits } from "./values.js";

/**
 * The motion settings: one set of limits with the pen down (`draw`), one with the pen up (`travel`).
 *
 * `CORNER_RULES` has the page's words for the corner rules, and whether the line is rounded at corners;
 * src/plan/run-writer.ts has their planners.
 */
export const CORNER_RULES = {
  junction: {
    label: "Exact",
    hint: "Slows down for every corner and turns exactly at its point. The line is exactly the file’s.",
    isRounded: false,
  },
  blend: {
    label: "Rounded",
    hint: "Draws corners as tiny curves: faster, quieter, and the pen never jerks.",
    isRounded: true,
  },
  scurve: {
    label: "Gentle",
    hint: "Like Rounded, and also speeds up and slows down softly. Best for brush pens and tall machines.",
    isRounded: true,
  },
} as const satisfies Record<string, { label: string; hint: string; isRounded: boolean }>;
/** How corners are taken: at once, rounded, or rounded with limited jerk. */
export type MotionMode = keyof typeof CORNER_RULES;
export const MOTION_MODES = Object.keys(CORNER_RULES) as readonly MotionMode[];

/** Input shapers against the swinging of the machine (src/plan/shaping/shapers.ts). */
export const SHAPERS = ["none", "zv", "mzv", "zvd", "ei"] as const;
/** Input shapers against the swinging of the machine. */
export type Shaper = (typeof SHAPERS)[number];

const speed = {
  kind: "number",
  label: "Speed",
  min: 0,
  minExcluded: true,
  max: 1_000,
  unit: "mm/s",
  step: 1,
} as const;
const accel = {
  kind: "number",
  label: "Acceleration",
  min: 0,
  minExcluded: true,
  max: 50_000,
  unit: "mm/s²",
  step: 10,
} as const;
const corner = {
  kind: "number",
  label: "Corner rounding",
  min: 0,
  minExcluded: true,
  max: 10,
  unit: "mm",
  step: 0.01,
  digits: 3,
  slider: [0.01, 0.5],
} as const;
const jerk = {
  kind: "number",
  label: "Softness",
  min: 0,
  minExcluded: true,
  max: 10_000_000,
  unit: "mm/s³",
  step: 500,
  slider: [1_000, 100_000],
} as const;

/** Limits with the pen down. */
export const DRAW_TABLE = {
  speedMmPerS: {
    ...speed,
    flag: "--speed",
    isCommon: true,
    default: 50,
    slider: [5, 200],
  },
  accelMmPerS2: {
    ...accel,
    flag: "--accel",
    default: 500,
    slider: [50, 3_000],
  },
  /**
   * δ: max deviation of the line from the drawing (blend). In junction mode the line does not deviate, but δ sets the
   * corner speed.
   */
  cornerMm: {
    ...corner,
    flag: "--corner",
    default: 0.025,
  },
  jerkMmPerS3: {
    ...jerk,
    flag: "--jerk",
    default: 10_000,
  },
} as const satisfies SettingsTable;

/** Limits with the pen up. */
export const TRAVEL_TABLE = {
  speedMmPerS: {
    ...speed,
    flag: "--travel-speed",
    isCommon: true,
    default: 150,
    slider: [10, 400],
  },
  accelMmPerS2: {
    ...accel,
    flag: "--travel-accel",
    default: 1_000,
    slider: [50, 5_000],
  },
  cornerMm: { ...corner, default: 0.5 },
  jerkMmPerS3: {
    ...jerk,
    flag: "--travel-jerk",
    default: 20_000,
  },
} as const satisfies SettingsTable;

export const MOTION_TABLE = {
  mode: {
    kind: "choice",
    label: "Corners",
    flag: "--mode",
    default: "blend",
    choices: MOTION_MODES,
  },
  shaper: {
    kind: "choice",
    label: "Reduce ringing",
    flag: "--shaper",
    default: "none",
    choices: SHAPERS,
  },
} as const satisfies SettingsTable;

/** Limits of one axis, pen down and up, for machines that are heavier along one of them. None unless set. */
export const AXIS_TABLE = {
  speedXMmPerS: {
    ...speed,
    label: "Speed along x",
    flag: "--speed-x",
    default: 100,
    slider: [5, 400],
  },
  speedYMmPerS: {
    ...speed,
    label: "Speed along y",
    flag: "--speed-y",
    default: 100,
    slider: [5, 400],
  },
  accelXMmPerS2: {
    ...accel,
    label: "Acceleration along x",
    flag: "--accel-x",
    default: 1_000,
    slider: [50, 5_000],
  },
  accelYMmPerS2: {
    ...accel,
    label: "Acceleration along y",
    flag: "--accel-y",
    default: 1_000,
    slider: [50, 5_000],
  },
} as const satisfies SettingsTable;

export const FIT_TABLE = {
  toleranceMm: {
    kind: "number",
    label: "Tolerance",
    default: 0.02,
    min: 0.001,
    max: 1,
    unit: "mm",
    step: 0.005,
    digits: 3,
  },
  floorMs: {
    kind: "number",
    label: "Commands of at least",
    default: 15,
    min: 0,
    max: 200,
    unit: "ms",
    step: 1,
  },
} as const satisfies SettingsTable;

export const EASE_TABLE = {
  lengthMm: {
    kind: "number",
    label: "Length",
    default: 1.5,
    min: 0,
    minExcluded: true,
    max: 1_000,
    unit: "mm",
    step: 0.5,
  },
  speedMmPerS: { ...speed, label: "Speed", default: 10 },
} as const satisfies SettingsTable;

/** Limit of one motor; matters on mixed machines, where a diagonal loads one motor more. */
export const MOTOR_ACCEL = {
  kind: "number",
  label: "motor acceleration",
  default: 100_000,
  min: 0,
  minExcluded: true,
  max: 100_000_000,
  unit: "steps/s²",
  step: 1_000,
} as const satisfies NumberSetting;

/** For a layer or stroke that is drawn slower: its share of the usual speed. */
export const SPEED_FACTOR = {
  kind: "number",
  label: "Share of the speed",
  default: 1,
  min: MIN_SPEED_FACTOR,
  max: 1,
  unit: "",
  step: 0.05,
} as const satisfies NumberSetting;

/** How the pen moves. Start from `DEFAULT_MOTION`. The formulas are in docs/motion.md. */
export interface MotionSettings extends MotionValues, AxisLimits {
  /** Limits with the pen down. */
  readonly draw: MotionLimits;
  /** Limits with the pen up. */
  readonly travel: TravelLimits;
  /** Merges blocks into fewer, longer ones; null or left out: no merging. */
  readonly fit?: FitSettings | null | undefined;
  /** Slow start and end of every stroke; null or left out: none. */
  readonly ease?: EaseSettings | null | undefined;
  /** By layer id: limits with the pen down. */
  readonly layers?: Readonly<Record<string, LayerMotion>> | undefined;
}

export const DEFAULT_FIT: FitSettings = defaultsOf(FIT_TABLE);

/** Mode `blend`, moderate speeds that suit an AxiDraw, merged commands. */
export const DEFAULT_MOTION: MotionSettings = {
  ...defaultsOf(MOTION_TABLE),
  draw: defaultsOf(DRAW_TABLE),
  travel: defaultsOf(TRAVEL_TABLE),
  fit: DEFAULT_FIT,
};

/**
 * Quality is not stored as a setting: choosing one sets several other settings (src/plan/quality.ts), and each of
 * those can still be changed.
 */
export const QUALITIES = ["fine", "normal", "fast"] as const;
export type Quality = (typeof QUALITIES)[number];

export const QUALITY_TABLE = {
  quality: {
    kind: "choice",
    label: "Quality",
    flag: "--quality",
    group: "motion",
    isCommon: true,
    default: "normal",
    choices: QUALITIES,
  },
} as const satisfies SettingsTable;
