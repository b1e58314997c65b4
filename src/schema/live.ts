/**
 * Messages of a live drawing: over the WebSocket of the operation `liveDrawings.draw`, and between a page and its own host. The
 * sender begins, then adds strokes. Points are in mm from home, which is the corner of the paper.
 *
 *   sender                                    plotter
 *   { begin: { name, settings } }     ──>
 *                                     <──     { type: "begun", job, room }
 *   { lineTo: [x, y] } …  { penUp: true }  ──>
 *                                     <──     { type: "progress", taken, room, … }   ten times a second while it changes
 *   { undo: true }                    ──>
 *                                     <──     { type: "undone", takenBack, left }
 *   { end: true }                     ──>
 *                                     <──     { type: "ended", job }
 *
 * Of the points that it has sent, the sender keeps at most `room` ahead of `taken`.
 */
import { z } from "zod";
import { ERROR_CODES } from "../errors.js";
import { givenSettingsSchema } from "./given-settings.js";
import { jobPlaceSchema, jobSchema } from "./job.js";
import { nameSchema } from "./name.js";

/** Most points in one message. A longer stroke is sent in parts, as one that grows. */
export const LIVE_POINTS_MAX = 2_000;
/** Most bytes in one message. */
export const LIVE_MESSAGE_BYTES = 200_000;
export const MAX_LIFT_AFTER_MS = 60_000;

const yes = z.literal(true);
const pointSchema = z.tuple([z.number(), z.number()]);
const pointsSchema = z.array(pointSchema).min(1).max(LIVE_POINTS_MAX);

export const liveBeginSchema = z.object({
  /** The name of the job. */
  name: nameSchema(200).optional(),
  /** Laid over the plotter's settings. Those of how a drawing is laid out do not apply. */
  settings: givenSettingsSchema.optional(),
  /** When points are late, the pen rests on the line for this time, ms, before it is lifted. */
  liftAfterMs: z.number().min(0).max(MAX_LIFT_AFTER_MS).optional(),
});
export type LiveBegin = z.infer<typeof liveBeginSchema>;

/** From the sender. */
export const liveMessageSchema = z.union([
  /** The next point of the stroke that grows, or several. */
  z.strictObject({ lineTo: z.union([pointSchema, pointsSchema]) }),
  z.strictObject({ stroke: pointsSchema }),
  z.strictObject({ penUp: yes }),
  /** Takes back the last stroke, as far as it is not yet sent to the motors. */
  z.strictObject({ undo: yes }),
  /** The drawing is complete. */
  z.strictObject({ end: yes }),
  z.strictObject({ begin: liveBeginSchema }),
]);
export type LiveMessage = z.infer<typeof liveMessageSchema>;

/** What an undo has taken back. */
export const liveUndoneSchema = z.object({
  /** How many points, of the end of the last stroke. */
  takenBack: z.int().min(0),
  /** How many points of that stroke are left, because they are drawn or about to be. 0: it is gone. */
  left: z.int().min(0),
});
export type LiveUndone = z.infer<typeof liveUndoneSchema>;

/** How far a live drawing is. Points that repeat the one before are not counted, except in `taken`. */
export const liveProgressSchema = z.object({
  /** Points received so far. */
  taken: z.int().min(0),
  /** How many more points there is room for. */
  room: z.int().min(0),
  /** Points of the drawing: received, and not taken back. */
  points: z.int().min(0),
  /** Points that are drawn. */
  drawn: z.int().min(0),
  /** The first place that is not drawn. */
  drawnTo: jobPlaceSchema,
  /** How long ago the pen's point was received, ms; 0 when everything is drawn. */
  lagMs: z.number().min(0),
  /** "waiting": everything is drawn. */
  state: z.enum(["waiting", "drawing", "paused"]),
});
export type LiveProgress = z.infer<typeof liveProgressSchema>;

const faultSchema = z.object({ code: z.enum(ERROR_CODES), message: z.string() });

/** To the sender. */
export const liveReportSchema = z.discriminatedUnion("type", [
  z.object({ type: z.literal("begun"), job: jobSchema, room: z.int().min(0) }),
  liveProgressSchema.extend({ type: z.literal("progress") }),
  liveUndoneSchema.extend({ type: z.literal("undone") }),
  /** A stroke or a point that can't be drawn, and is left out. */
  faultSchema.extend({ type: z.literal("refused") }),
  /** The last message: the job has ended, in its history, or was interrupted. */
  z.object({ type: z.literal("ended"), job: jobSchema }),
  /** The last message: the drawing has not begun, or the sender has broken a rule. */
  faultSchema.extend({ type: z.literal("error") }),
]);
export type LiveReport = z.infer<typeof liveReportSchema>;

/** In the query, when the strokes are sent as the body of a request. */
export const liveFieldsSchema = z
  .object({
    name: nameSchema(200),
    /** As in `LiveBegin`, as JSON. */
    settings: z.string(),
    liftAfterMs: z.coerce.number().min(0).max(MAX_LIFT_AFTER_MS),
  })
  .partial();

/** The answer to such a request. */
export const liveSentSchema = z.object({
  job: jobSchema,
  /** The lines that could not be drawn, and why: the first 20. */
  refused: z.array(z.object({ line: z.int().min(1), message: z.string() })),
});
