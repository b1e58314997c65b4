/** A job in the queue, as stored by the server and shown in every browser. */
import { z } from "zod";
import { plotSettingsSchema, type PlotSettings } from "./settings.js";

/**
 *   queued ──start──> plotting ──finish──> done
 *                       │  ^ └──fail──> failed ──requeue──> queued (also from done, cancelled, interrupted)
 *                 pause v  │ resume
 *                      paused ──cancel──> cancelled      (also from queued, plotting, interrupted)
 *
 *   plotting, paused ──board or server lost──> interrupted ──recover──> paused at the place it had reached
 *                                              cancelled ──recover──> paused there, if part of it is drawn
 */
export const JOB_STATES = [
  "queued",
  "plotting",
  "paused",
  "interrupted",
  "done",
  "failed",
  "cancelled",
] as const;
export const jobStateSchema = z.enum(JOB_STATES);
export type JobState = z.infer<typeof jobStateSchema>;

/** Final states: the job is history. */
export const ENDED_STATES: readonly JobState[] = ["done", "failed", "cancelled"];

const statsPenSchema = z.object({
  /** Of the pen, or of the layer if it has none. */
  name: z.string(),
  color: z.string().nullable(),
});

/** The pens of a job, as far as they are assigned to layers. */
export const jobPensSchema = z.object({
  /** That of the first and of the last stroke; null: none is assigned, so any pen may be in the holder. */
  first: statsPenSchema.nullable(),
  last: statsPenSchema.nullable(),
  /** Where the plot waits for another pen, up to the first 20. */
  stops: z.array(
    statsPenSchema.extend({
      strokeIndex: z.int().min(0),
      /** Seconds of the plan. */
      atS: z.number(),
    }),
  ),
});
export type JobPens = z.infer<typeof jobPensSchema>;

export const jobStatsSchema = z.object({
  /** The drawing's size on the paper, and its scale: 1 is the size in the file. */
  size: z.object({
    widthMm: z.number(),
    heightMm: z.number(),
    scaleX: z.number(),
    scaleY: z.number(),
    /** By how much it was turned to fit the paper. */
    turnedDeg: z.number(),
  }),
  strokeCount: z.number(),
  pointCount: z.number(),
  drawMm: z.number(),
  travelMm: z.number(),
  penLiftCount: z.number(),
  durationS: z.number(),
  /** Left out for jobs that were planned by an older version. */
  pens: jobPensSchema.optional(),
});
export type JobStats = z.infer<typeof jobStatsSchema>;

/** A place in the drawing that the pen has reached. */
export const jobPlaceSchema = z.object({
  strokeIndex: z.int().min(0),
  /** mm along that stroke. */
  alongMm: z.number().min(0),
});
export type JobPlace = z.infer<typeof jobPlaceSchema>;

/** A stop made by the plot itself, until a user resumes it. */
export const plotWaitSchema = z.object({
  /** Another pen must be inserted. */
  kind: z.literal("pen"),
  layerName: z.string(),
  /** Null: no pen is assigned to the layer. */
  penName: z.string().nullable(),
  /** CSS colour of the pen, or else of the layer's first line; null if there is none. */
  color: z.string().nullable(),
});
export type PlotWait = z.infer<typeof plotWaitSchema>;

/** With the type of its own, which has the docstrings. */
const settingsSchema: z.ZodType<PlotSettings> = plotSettingsSchema;

/** Who added a job, if that may only submit jobs. */
export const submitterSchema = z.object({
  /** That of its session or key. */
  id: z.string(),
  /** The key's name, or the browser and its address. */
  name: z.string(),
});
export type Submitter = z.infer<typeof submitterSchema>;

export const jobSchema = z.object({
  id: z.string(),
  plotterId: z.string(),
  name: z.string(),
  state: jobStateSchema,
  settings: settingsSchema,
  /** Null until it is planned: that of a live drawing, when it has ended. */
  stats: jobStatsSchema.nullable(),
  /** Parts of the drawing that are left out, and changes by the planner. Plain text. */
  warnings: z.array(z.string()),
  /** Share of the plot's time, 0 … 1. */
  progress: z.number(),
  elapsedS: z.number(),
  remainingS: z.number().nullable(),
  /** What is happening or what went wrong, for the user; null if there is nothing to report. */
  message: z.string().nullable(),
  /** Where it starts, or resumes when held, interrupted or cancelled; null if at the beginning, or while plotting. */
  place: jobPlaceSchema.nullable().default(null),
  /** Percent of the set speeds, changed while plotting. */
  speedPct: z.number().default(100),
  /** Actual duration in seconds of all its parts, holds excluded; null until it is done or has stopped in the middle. */
  plottedS: z.number().nullable().default(null),
  /**
   * Expected duration on its plotter: the plan's time, corrected by this plotter's earlier plots. Not updated
   * after the start, so that it can be compared with plottedS; null until the job is planned.
   */
  expectedS: z.number().nullable().default(null),
  /** What a job that is not moving waits for; null if for nothing. A cancelled job waits for it again once it is recovered. */
  wait: plotWaitSchema.nullable().default(null),
  /** Held by an emergency stop, until it is resumed. */
  stopped: z.boolean().default(false),
  /** Left out: an operator added it. */
  submittedBy: submitterSchema.optional(),
  createdAt: z.string(),
  startedAt: z.string().nullable(),
  endedAt: z.string().nullable(),
});
export type Job = z.infer<typeof jobSchema>;

/** Its strokes are still being received, while they are drawn. */
export const isLiveJob = ({ state, stats }: Pick<Job, "state" | "stats">): boolean =>
  stats === null && (state === "plotting" || state === "paused");
