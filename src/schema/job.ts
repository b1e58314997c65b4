/** A job of the queue, as the server keeps it and every browser sees it. */
import { z } from "zod";
import { plotSettingsSchema } from "./settings.js";

/**
 *   queued ──start──> plotting ──> done
 *     ^                │  ^  └──> failed           board or server lost in mid-plot:
 *     │        pause   v  │ resume                 plotting, paused ──> interrupted ──recover──> paused
 *     └─(requeue)─── paused ──cancel──> cancelled                          at the place it had come to
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

/** States that a job never leaves: it is history then. */
export const ENDED_STATES: readonly JobState[] = ["done", "failed", "cancelled"];

export const jobStatsSchema = z.object({
  strokeCount: z.number(),
  pointCount: z.number(),
  drawMm: z.number(),
  travelMm: z.number(),
  penLiftCount: z.number(),
  durationS: z.number(),
});
export type JobStats = z.infer<typeof jobStatsSchema>;

/** A place in the drawing, as far as the pen has come. */
export const jobPlaceSchema = z.object({
  strokeIndex: z.int().min(0),
  /** mm along that stroke. */
  alongMm: z.number().min(0),
});
export type JobPlace = z.infer<typeof jobPlaceSchema>;

/** A stop that the plot has made by itself, until somebody resumes it. */
export const plotWaitSchema = z.object({
  /** Another pen has to be put in. */
  kind: z.literal("pen"),
  layerName: z.string(),
  /** Null: no pen has been named for the layer. */
  penName: z.string().nullable(),
  /** CSS colour of the pen, else of the layer's first line; null when there is none. */
  color: z.string().nullable(),
});
export type PlotWait = z.infer<typeof plotWaitSchema>;

export const jobSchema = z.object({
  id: z.string(),
  plotterId: z.string(),
  name: z.string(),
  state: jobStateSchema,
  settings: plotSettingsSchema,
  /** Null until the server has planned it. */
  stats: jobStatsSchema.nullable(),
  /** What of the file is not drawn, and what the planner had to change. Plain text. */
  warnings: z.array(z.string()),
  /** Of the plot's time, 0 … 1. */
  progress: z.number(),
  elapsedS: z.number(),
  remainingS: z.number().nullable(),
  /** What is happening or what went wrong, for the user; null when there is nothing to say. */
  message: z.string().nullable(),
  /** Where it goes on when held or interrupted; null when it begins at the beginning, or is plotting. */
  place: jobPlaceSchema.nullable().default(null),
  /** Percent of the set speeds, changed while plotting. */
  speedPct: z.number().default(100),
  /** Seconds that it really took, holds left out; null until it is done. */
  plottedS: z.number().nullable().default(null),
  /** What it is likely to take on its plotter: the plan's time, corrected by the plots that this plotter has
   *  ended. Kept as it was at the start, to be compared with plottedS; null until the job is planned. */
  expectedS: z.number().nullable().default(null),
  /** What a paused or interrupted job waits for; null when it is held for another reason. */
  wait: plotWaitSchema.nullable().default(null),
  createdAt: z.string(),
  startedAt: z.string().nullable(),
  endedAt: z.string().nullable(),
});
export type Job = z.infer<typeof jobSchema>;
