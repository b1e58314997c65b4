/** Settings as they cross a wire, a disk or a file: parsed here, typed as what the library takes. */
import { z } from "zod";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  MOTION_MODES,
  type MotionSettings,
  type PenSettings,
} from "../plan/settings.js";
import {
  DEFAULT_PREPARE,
  LAYER_MODES,
  MIRROR_MODES,
  ORDER_MODES,
  SPREAD_MODES,
  type PrepareSettings,
} from "../prepare/settings.js";
import { NO_PENS, PEN_STOP_MODES, type PlotPen } from "../prepare/pens.js";
import { machineProfileSchema } from "./machine.js";

const positive = (max: number) => z.number().gt(0).max(max);
const nonNegative = (max: number) => z.number().min(0).max(max);

const anywhere = z.number().min(-100_000).max(100_000);
const paperSizeSchema = z.object({ widthMm: positive(5_000), heightMm: positive(5_000) });
const layerId = z.string().max(500);
const layerIds = z.array(layerId).max(10_000);
const byLayer = <T extends z.ZodType>(value: T) => z.record(layerId, value);
const hatchSchema = z.object({
  spacingMm: nonNegative(100),
  angleDeg: z.number().min(-360).max(360),
  cross: z.boolean(),
});

// Fields that came after the first release have defaults, so that stored jobs and presets stay readable.
export const prepareSettingsSchema = z.object({
  paper: paperSizeSchema,
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
  hiddenLayers: layerIds,
  shownLayers: layerIds.default([]),
  layerOrder: layerIds.default([]),
  layerRepeats: byLayer(z.int().min(1).max(20)).default({}),
  order: z.enum(ORDER_MODES),
  orderS: nonNegative(3_600).default(DEFAULT_PREPARE.orderS),
  margins: z
    .object({
      topMm: nonNegative(1_000),
      rightMm: nonNegative(1_000),
      bottomMm: nonNegative(1_000),
      leftMm: nonNegative(1_000),
    })
    .nullable()
    .default(null),
  mirror: z.enum(MIRROR_MODES).default(DEFAULT_PREPARE.mirror),
  place: z
    .object({
      xMm: anywhere,
      yMm: anywhere,
      widthMm: positive(100_000).nullable(),
      heightMm: positive(100_000).nullable(),
      turnDeg: z.number().min(-360).max(360).optional(),
    })
    .nullable()
    .default(null),
  cropToPage: z.boolean().default(DEFAULT_PREPARE.cropToPage),
  reach: paperSizeSchema.nullable().default(null),
  hatch: hatchSchema.default(DEFAULT_PREPARE.hatch),
  layerHatches: z
    .array(hatchSchema.extend({ layer: z.string().max(500) }))
    .max(10_000)
    .default([]),
  outlineFills: z.boolean().default(DEFAULT_PREPARE.outlineFills),
  hideCovered: z.boolean().default(DEFAULT_PREPARE.hideCovered),
  dropRepeatsMm: nonNegative(5).default(DEFAULT_PREPARE.dropRepeatsMm),
  smoothRounds: z.int().min(0).max(5).default(DEFAULT_PREPARE.smoothRounds),
  reloop: z.boolean().default(DEFAULT_PREPARE.reloop),
  spread: z.enum(SPREAD_MODES).default(DEFAULT_PREPARE.spread),
  reinkMm: nonNegative(1_000_000).default(DEFAULT_PREPARE.reinkMm),
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
  fit: z
    .object({ toleranceMm: z.number().min(0.001).max(1), floorMs: nonNegative(200) })
    .nullable()
    .optional(),
  ease: z
    .object({ lengthMm: positive(1_000), speedMmPerS: positive(1_000) })
    .nullable()
    .optional(),
  motorAccelStepsPerS2: positive(100_000_000).nullable().optional(),
  layers: z.record(z.string().max(500), motionLimitsSchema.partial()).optional(),
}) satisfies z.ZodType<MotionSettings>;

const layerPenSchema = z
  .object({
    upPct: nonNegative(100),
    downPct: nonNegative(100),
    liftMs: nonNegative(10_000),
    dropMs: nonNegative(10_000),
    beforeMs: nonNegative(60_000),
  })
  .partial();

export const penSettingsSchema = z.object({
  upPct: nonNegative(100),
  downPct: nonNegative(100),
  liftMs: nonNegative(10_000),
  dropMs: nonNegative(10_000),
  liftPctPerS: positive(10_000).nullable().optional(),
  dropPctPerS: positive(10_000).nullable().optional(),
  clearPct: nonNegative(100).optional(),
  hop: z
    .object({ longestMm: positive(1_000), upPct: nonNegative(100) })
    .nullable()
    .optional(),
  layers: z.record(z.string().max(500), layerPenSchema).optional(),
}) satisfies z.ZodType<PenSettings>;

export const plotPenSchema = z.object({
  id: z.string().min(1).max(100),
  name: z.string().max(200),
  color: z
    .string()
    .regex(/^#[0-9a-f]{6}$/)
    .nullable(),
  widthMm: positive(50),
  offsetXMm: z.number().min(-100).max(100),
  offsetYMm: z.number().min(-100).max(100),
}) satisfies z.ZodType<PlotPen>;

/** Everything that decides what a job puts on paper. Kept whole with every job. */
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
   * Motion that the board is sent ahead of the pen. A board with a queue of one (before firmware 3) plays all of it
   * after an emergency stop; less than 300 ms stops sooner, but then the pen stands still where the computer is busy
   * for longer than that.
   */
  sendAheadMs: z.int().min(100).max(1_000).default(300),
  /** The whole profile of a machine that plotwright does not know by itself; counts when `machine` is its id. */
  customMachine: machineProfileSchema.nullable().default(null),
});
export type PlotSettings = z.infer<typeof plotSettingsSchema>;

export const DEFAULT_PLOT_SETTINGS: PlotSettings = {
  machine: "axidraw-v3",
  prepare: {
    ...DEFAULT_PREPARE,
    hiddenLayers: [],
    shownLayers: [],
    layerOrder: [],
    layerRepeats: {},
    layerHatches: [],
  },
  motion: DEFAULT_MOTION,
  pen: DEFAULT_PEN,
  ...NO_PENS,
  pens: [],
  layerPens: {},
  layerStops: {},
  sendAheadMs: 300,
  customMachine: null,
};
