/** Settings as sent, stored or written to a file: parsed here, with the types that the library takes. */
import { z } from "zod";
import {
  AXIS_TABLE,
  DEFAULT_MOTION,
  DRAW_TABLE,
  EASE_TABLE,
  FIT_TABLE,
  MOTION_TABLE,
  MOTOR_ACCEL,
  SHAPERS,
  SPEED_FACTOR,
  TRAVEL_TABLE,
  type MotionSettings,
} from "../settings/motion.js";
import {
  DEFAULT_PEN,
  DROP_RATE,
  LAYER_WAIT,
  LIFT_RATE,
  OVERLAP_TABLE,
  PEN_TABLE,
  PLOT_PEN_TABLE,
  type PenSettings,
} from "../settings/pen.js";
import {
  DEFAULT_PREPARE,
  HATCH_TABLE,
  LAYER_REPEATS,
  PREPARE_TABLE,
  type PrepareSettings,
} from "../settings/prepare.js";
import { MARGINS_TABLE, PAPER_TABLE } from "../settings/placement.js";
import { STREAM_TABLE } from "../settings/machine.js";
import type { StreamValues } from "../settings/values.js";
import type { JobSettings } from "../drivers/machine-job.js";
import type { MachineProfile } from "../machines/profile.js";
import type { MachineChoice } from "../machines/profiles.js";
import { NO_PENS, PEN_STOP_MODES, type PenSetup, type PlotPen } from "../prepare/layers/pens.js";
import { machineProfileSchema } from "./machine.js";
import { numberSchema, shapeOf, shapeWithDefaults } from "./setting.js";

const positive = (max: number) => z.number().gt(0).max(max);

const anywhere = z.number().min(-100_000).max(100_000);
const paperSizeSchema = z.object(shapeOf(PAPER_TABLE));
const layerId = z.string().max(500);
/** Keeps the size of requests bounded. */
const MAX_LAYERS = 10_000;
const layerIds = z.array(layerId).max(MAX_LAYERS);
const byLayer = <T extends z.ZodType>(value: T) =>
  z
    .record(layerId, value)
    .refine((record) => Object.keys(record).length <= MAX_LAYERS, `at most ${MAX_LAYERS} layers`);
const hatchSchema = z.object(shapeWithDefaults(HATCH_TABLE));

// Every field has a default, so that a caller may leave it out.
export const prepareSettingsSchema = z.object({
  ...shapeWithDefaults(PREPARE_TABLE),
  paper: paperSizeSchema.default(DEFAULT_PREPARE.paper),
  hiddenLayers: layerIds.default([]),
  shownLayers: layerIds.default([]),
  layerOrder: layerIds.default([]),
  layerRepeats: byLayer(numberSchema(LAYER_REPEATS)).default({}),
  margins: z.object(shapeOf(MARGINS_TABLE)).nullable().default(null),
  layout: z
    .object({
      xMm: anywhere.default(0),
      yMm: anywhere.default(0),
      widthMm: positive(100_000).nullable().default(null),
      heightMm: positive(100_000).nullable().default(null),
      /** Turns the box clockwise about its middle, after placing it. */
      turnDeg: numberSchema(PREPARE_TABLE.rotateDeg).optional(),
    })
    .nullable()
    .default(null),
  reach: paperSizeSchema.nullable().default(null),
  hatch: hatchSchema.default(DEFAULT_PREPARE.hatch),
  layerHatches: z
    .array(hatchSchema.extend({ layer: layerId }))
    .max(MAX_LAYERS)
    .default([]),
}) satisfies z.ZodType<PrepareSettings>;

export const motionSettingsSchema = z.object({
  ...shapeWithDefaults(MOTION_TABLE),
  shaper: z.enum(SHAPERS).optional(),
  draw: z.object(shapeWithDefaults(DRAW_TABLE)),
  travel: z.object(shapeWithDefaults(TRAVEL_TABLE)),
  fit: z.object(shapeWithDefaults(FIT_TABLE)).nullable().optional(),
  ease: z.object(shapeWithDefaults(EASE_TABLE)).nullable().optional(),
  motorAccelStepsPerS2: numberSchema(MOTOR_ACCEL).nullable().optional(),
  speedXMmPerS: numberSchema(AXIS_TABLE.speedXMmPerS).nullable().optional(),
  speedYMmPerS: numberSchema(AXIS_TABLE.speedYMmPerS).nullable().optional(),
  accelXMmPerS2: numberSchema(AXIS_TABLE.accelXMmPerS2).nullable().optional(),
  accelYMmPerS2: numberSchema(AXIS_TABLE.accelYMmPerS2).nullable().optional(),
  layers: byLayer(
    z.object({ ...shapeOf(DRAW_TABLE), speedFactor: numberSchema(SPEED_FACTOR) }).partial(),
  ).optional(),
}) satisfies z.ZodType<MotionSettings>;

const penShape = {
  ...shapeWithDefaults(PEN_TABLE),
  ...shapeWithDefaults(OVERLAP_TABLE),
  liftPctPerS: numberSchema(LIFT_RATE).nullable().optional(),
  dropPctPerS: numberSchema(DROP_RATE).nullable().optional(),
  layers: byLayer(
    z.object({ ...shapeOf(PEN_TABLE), beforeMs: numberSchema(LAYER_WAIT) }).partial(),
  ).optional(),
};

export const penSettingsSchema = z.object(penShape) satisfies z.ZodType<PenSettings>;

/** Without the heights of single layers, which belong to a drawing. */
export const plotterPenSchema = penSettingsSchema.omit({ layers: true });

export const plotPenSchema = z.object({
  id: z.string().min(1).max(100),
  name: z.string().max(200),
  color: z
    .string()
    .regex(/^#[0-9a-f]{6}$/)
    .nullable(),
  ...shapeOf(PLOT_PEN_TABLE),
}) satisfies z.ZodType<PlotPen>;

/** Everything that determines what a job puts on paper. Stored completely with every job. */
export const plotSettingsSchema = z.object({
  machine: z.string().min(1).max(100),
  prepare: prepareSettingsSchema,
  motion: motionSettingsSchema,
  pen: penSettingsSchema,
  pens: z.array(plotPenSchema).max(1_000).default([]),
  layerPens: byLayer(z.string().max(100)).default({}),
  penStops: z.enum(PEN_STOP_MODES).default(NO_PENS.penStops),
  layerStops: byLayer(z.boolean()).default({}),
  /**
   * How much motion is sent to the board ahead of the pen. A board with a queue of one command (before firmware 3)
   * still plays all of it after an emergency stop. With less than 300 ms it stops sooner, but the pen pauses whenever
   * the computer is busy for longer than that.
   */
  ...shapeWithDefaults(STREAM_TABLE),
  /** The complete profile of a machine that is not built in; used if `machine` is its id. */
  customMachine: machineProfileSchema.nullable().default(null),
}) satisfies z.ZodType<PlotSettings>;

/** All settings of a job. */
export interface PlotSettings extends JobSettings, MachineChoice, PenSetup, StreamValues {
  /** Paper, placing, hatching, order of strokes … */
  readonly prepare: PrepareSettings;
  /** A custom profile, used if its id is `machine`. */
  readonly customMachine: MachineProfile | null;
}

/** Every setting that is left out here has its default. */
export const DEFAULT_PLOT_SETTINGS: PlotSettings = plotSettingsSchema.parse({
  machine: "axidraw-v3",
  prepare: {},
  motion: DEFAULT_MOTION,
  pen: DEFAULT_PEN,
});
