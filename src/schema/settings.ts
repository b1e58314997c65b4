/** Settings as they cross a wire, a disk or a file: parsed here, typed as what the library takes. */
import { z } from "zod";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  MOTION_MODES,
  type MotionSettings,
  type PenSettings,
} from "../plan/settings.js";
import { DEFAULT_PREPARE, LAYER_MODES, ORDER_MODES, type PrepareSettings } from "../prepare/settings.js";

const positive = (max: number) => z.number().gt(0).max(max);
const nonNegative = (max: number) => z.number().min(0).max(max);

export const prepareSettingsSchema = z.object({
  paper: z.object({ widthMm: positive(5_000), heightMm: positive(5_000) }),
  landscape: z.boolean(),
  marginMm: nonNegative(1_000),
  fit: z.boolean(),
  rotateDeg: z.number().min(-360).max(360),
  clipToMargins: z.boolean(),
  flattenMm: z.number().min(0.001).max(5),
  joinMm: nonNegative(50),
  dropShorterMm: nonNegative(1_000),
  simplifyMm: nonNegative(5),
  layers: z.enum(LAYER_MODES),
  hiddenLayers: z.array(z.string().max(500)).max(10_000),
  order: z.enum(ORDER_MODES),
}) satisfies z.ZodType<PrepareSettings>;

const motionLimitsSchema = z.object({
  speedMmPerS: positive(1_000),
  accelMmPerS2: positive(50_000),
  cornerMm: positive(10),
  jerkMmPerS3: positive(10_000_000),
});

export const motionSettingsSchema = z.object({
  mode: z.enum(MOTION_MODES),
  draw: motionLimitsSchema,
  travel: motionLimitsSchema,
}) satisfies z.ZodType<MotionSettings>;

export const penSettingsSchema = z.object({
  upPct: nonNegative(100),
  downPct: nonNegative(100),
  liftMs: nonNegative(10_000),
  dropMs: nonNegative(10_000),
}) satisfies z.ZodType<PenSettings>;

/** Everything that decides what a job puts on paper. Kept whole with every job. */
export const plotSettingsSchema = z.object({
  machine: z.string().min(1).max(100),
  prepare: prepareSettingsSchema,
  motion: motionSettingsSchema,
  pen: penSettingsSchema,
});
export type PlotSettings = z.infer<typeof plotSettingsSchema>;

export const DEFAULT_PLOT_SETTINGS: PlotSettings = {
  machine: "axidraw-v3",
  prepare: { ...DEFAULT_PREPARE, hiddenLayers: [] },
  motion: DEFAULT_MOTION,
  pen: DEFAULT_PEN,
};
