/**
 * The REST interface under /api/v1: bodies and answers. Every error is `{ error: { code, message } }`
 * with the status of ERROR_TABLE.
 *
 *   GET    /api/v1/state                      → Snapshot
 *   GET    /api/v1/events                     → text/event-stream of ServerEvent (first: snapshot)
 *   POST   /api/v1/jobs                       NewJob (JSON), or the file itself as the body with ?name=… → 201 Job
 *   GET    /api/v1/jobs/:id                   → Job
 *   GET    /api/v1/jobs/:id/drawing           → the uploaded file as text/plain attachment
 *   PATCH  /api/v1/jobs/:id                   JobPatch → Job (settings only while queued)
 *   POST   /api/v1/jobs/:id/move              MoveJob → { ok: true }
 *   POST   /api/v1/jobs/:id/(start|pause|resume|cancel|requeue)  → Job
 *   POST   /api/v1/jobs/:id/emergency-stop    stops at once, then held → Job
 *   POST   /api/v1/jobs/:id/change            JobChange → Job (heights, speeds: while plotting or held)
 *   POST   /api/v1/jobs/:id/recover           an interrupted job, held at its place, nothing drawn yet → Job
 *   POST   /api/v1/jobs/:id/place             MovePlace: moves the place of a held job → Job
 *   POST   /api/v1/jobs/:id/check-place       walks to the place with the pen up → Job
 *   POST   /api/v1/jobs/:id/duplicate         a queued copy, right behind it or last → 201 Job
 *   GET    /api/v1/queue                      → QueueSettings
 *   PATCH  /api/v1/queue                      QueueSettings → QueueSettings
 *   DELETE /api/v1/jobs/:id                   → { ok: true }  (not while plotting or paused)
 *   POST   /api/v1/plotters/:id/pen           { up: boolean, heightPct? } → Plotter
 *   POST   /api/v1/plotters/:id/motors-off    → Plotter
 *   POST   /api/v1/plotters/:id/home          walks to home, pen up; to the switches where there are some → Plotter
 *   POST   /api/v1/plotters/:id/walk          WalkRequest → Plotter      pen up, to a place in mm from home
 *   POST   /api/v1/plotters/:id/jog           JogRequest → Plotter       pen up, by so many mm
 *   POST   /api/v1/plotters/:id/set-home      HandMoveRequest → Plotter  where the carriage stands
 *   POST   /api/v1/plotters/:id/cycle-pen     HandMoveRequest → Plotter  down and up again
 *   POST   /api/v1/plotters/:id/frame         FrameRequest → Plotter     around a drawing, pen up, and back
 *   POST   /api/v1/plotters/:id/test-patch    HandMoveRequest → Plotter  a small pattern where the carriage stands
 *   POST   /api/v1/plotters/:id/square        SquareRequest → Plotter    a square to be measured
 *   POST   /api/v1/plotters/:id/servo         ServoRequest → Plotter     a raw servo position
 *   POST   /api/v1/plotters/:id/command       CommandRequest → CommandAnswer  one line to the board
 *   GET    /api/v1/machines                   → MachineList
 *   PUT    /api/v1/machines/:id               MachineProfile → MachineProfile (of the user's own)
 *   DELETE /api/v1/machines/:id               → { ok: true }
 *   GET    /api/v1/plotters/:id/log           commands and replies of this connection, as text
 *   GET    /api/v1/access                     → { entries: AccessEntry[] }: sessions and keys
 *   POST   /api/v1/access/keys                NewKey → 201 { entry, secret }
 *   DELETE /api/v1/access/:id                 → { ok: true }
 *   GET    /api/v1/me                         → Me
 *   POST   /api/v1/operator/take              the calling browser becomes the operator → { operator }
 *   GET    /api/v1/devices                    → { devices: Device[] }: boards that are plugged in
 *   POST   /api/v1/plotters                   NewPlotter → 201 Plotter
 *   PATCH  /api/v1/plotters/:id               PlotterPatch → Plotter
 *   DELETE /api/v1/plotters/:id               → { ok: true }  (not with queued or running jobs, nor the last one)
 *   GET    /api/v1/plotters/:id/queue         → QueueSettings of one plotter
 *   PATCH  /api/v1/plotters/:id/queue         QueueSettings → QueueSettings
 *   GET    /api/v1/webhooks                   → { webhooks: Webhook[] }
 *   POST   /api/v1/webhooks                   NewWebhook → 201 { webhook, secret }
 *   DELETE /api/v1/webhooks/:id               → { ok: true }
 *   POST   /api/v1/pairing                    from this computer only → Pairing
 *   DELETE /api/v1/notices/:id                → { ok: true }: read
 *   GET    /api/v1/logs                       → what happened, as text to be sent to whoever helps
 *   GET    /api/v1/samples                    → { samples: [{ name, title }] }
 *   GET    /api/v1/samples/:name              → SVG text
 */
import { z } from "zod";
import { ERROR_CODES } from "../errors.js";
import { jobSchema } from "./job.js";
import { nameSchema } from "./name.js";
import { motionSettingsSchema, penSettingsSchema, plotSettingsSchema } from "./settings.js";

export const newJobSchema = z.object({
  name: nameSchema(200),
  drawing: z.string().min(1),
  settings: plotSettingsSchema,
  plotterId: z.string().max(100).optional(),
  /** So many jobs, one after the other. */
  copies: z.int().min(1).max(100).optional(),
});
export type NewJob = z.infer<typeof newJobSchema>;

export const jobPatchSchema = z
  .object({
    name: nameSchema(200),
    settings: plotSettingsSchema,
    /** To another plotter's queue; only while queued. */
    plotterId: z.string().max(100),
  })
  .partial();
export type JobPatch = z.infer<typeof jobPatchSchema>;

/** Moves a queued job to stand before another, or to the end with null. */
export const moveJobSchema = z.object({ beforeId: z.string().nullable() });
export type MoveJob = z.infer<typeof moveJobSchema>;

/** While plotting or held; takes effect within a second, and is kept with the job. */
export const jobChangeSchema = z
  .object({
    pen: penSettingsSchema,
    motion: motionSettingsSchema,
    speedPct: z.number().min(10).max(200),
  })
  .partial();
export type JobChange = z.infer<typeof jobChangeSchema>;

/** Forward, or back with less than 0. */
export const movePlaceSchema = z
  .object({ strokes: z.int().min(-1_000_000).max(1_000_000), mm: z.number().min(-1e7).max(1e7) })
  .partial();
export type MovePlace = z.infer<typeof movePlaceSchema>;

export const penRequestSchema = z.object({
  up: z.boolean(),
  heightPct: z.number().min(0).max(100).optional(),
});
export type PenRequest = z.infer<typeof penRequestSchema>;

export const plotterSchema = z.object({
  id: z.string(),
  /** The user's. */
  name: z.string(),
  /** The board's own name (QT), which it keeps; null where it has none. */
  boardName: z.string().nullable().default(null),
  /** Id of the machine profile taken for moves by hand; null: that of the last job. */
  machine: z.string().nullable().default(null),
  /** "virtual": no hardware, the built-in model. */
  kind: z.enum(["virtual", "serial"]),
  /** Serial path, for people; null for the virtual board. */
  device: z.string().nullable(),
  connection: z.enum(["absent", "connecting", "idle", "busy", "fault"]),
  /** What it is busy with; "held": a plot that waits, pen up. */
  activity: z.enum(["none", "plotting", "held", "moving"]).default("none"),
  firmware: z.string().nullable(),
  /** How long the motors may still run after an emergency stop, with this firmware and the last settings. */
  emergencyStopMs: z.number().nullable().default(null),
  /** What is wrong and what to do, or null. */
  message: z.string().nullable(),
  penUp: z.boolean().nullable(),
  motorsOn: z.boolean().nullable(),
  /** mm from home; null when not known. */
  xMm: z.number().nullable(),
  yMm: z.number().nullable(),
});
export type Plotter = z.infer<typeof plotterSchema>;

export const queueSettingsSchema = z.object({
  /** False: after a job the next one waits until somebody has changed the paper and starts it. */
  runOn: z.boolean(),
});
export type QueueSettings = z.infer<typeof queueSettingsSchema>;

/** The browser that may change things now; everybody may watch and stop. */
export const operatorSchema = z.object({ id: z.string(), name: z.string() });
export type Operator = z.infer<typeof operatorSchema>;

/** Something that went wrong with nobody asking: a drawing in the watched folder that can't be plotted. */
export const noticeSchema = z.object({ id: z.string(), at: z.string(), message: z.string() });
export type Notice = z.infer<typeof noticeSchema>;

const queuesSchema = z.record(z.string(), queueSettingsSchema);

/** Jobs: queue order first, then history, newest first. */
export const snapshotSchema = z.object({
  version: z.string(),
  /** Of the first plotter. */
  queue: queueSettingsSchema.default({ runOn: false }),
  /** Of every plotter, by its id. */
  queues: queuesSchema.default({}),
  /** Null: whoever acts first becomes it. */
  operator: operatorSchema.nullable().default(null),
  serverNotices: z.array(noticeSchema).default([]),
  /** The server's name on the network, as "plotwright.local"; null while it has none. */
  localName: z.string().nullable().default(null),
  plotters: z.array(plotterSchema),
  jobs: z.array(jobSchema),
});
export type Snapshot = z.infer<typeof snapshotSchema>;

export const serverEventSchema = z.discriminatedUnion("type", [
  z.object({ type: z.literal("snapshot"), snapshot: snapshotSchema }),
  z.object({ type: z.literal("job"), job: jobSchema }),
  z.object({ type: z.literal("job-removed"), id: z.string() }),
  /** Job.expectedS of waiting jobs, by id, where it has changed: a plot of the same plotter has ended. */
  z.object({ type: z.literal("expected"), expectedS: z.record(z.string(), z.number()) }),
  /** Ids of all jobs, in the order of Snapshot.jobs. */
  z.object({ type: z.literal("order"), ids: z.array(z.string()) }),
  z.object({ type: z.literal("plotter"), plotter: plotterSchema }),
  /** A plotter was added, changed its name, or was removed: all of them. */
  z.object({ type: z.literal("plotters"), plotters: z.array(plotterSchema) }),
  /** Of the first plotter; `queues` follows with those of all. */
  z.object({ type: z.literal("queue"), queue: queueSettingsSchema }),
  z.object({ type: z.literal("queues"), queues: queuesSchema }),
  z.object({ type: z.literal("operator"), operator: operatorSchema.nullable() }),
  z.object({ type: z.literal("local-name"), localName: z.string().nullable() }),
  z.object({ type: z.literal("notice"), notice: noticeSchema }),
  z.object({ type: z.literal("notice-removed"), id: z.string() }),
  /** Several times a second while plotting. */
  z.object({
    type: z.literal("progress"),
    jobId: z.string(),
    plotterId: z.string(),
    progress: z.number(),
    elapsedS: z.number(),
    remainingS: z.number(),
    /** Seconds along the job's trajectory, for the page's own copy of the plan. */
    planS: z.number(),
    xMm: z.number(),
    yMm: z.number(),
    penUp: z.boolean(),
  }),
]);
export type ServerEvent = z.infer<typeof serverEventSchema>;

export const apiErrorSchema = z.object({
  error: z.object({ code: z.enum(ERROR_CODES), message: z.string() }),
});
export type ApiError = z.infer<typeof apiErrorSchema>;
