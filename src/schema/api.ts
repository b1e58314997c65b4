/**
 * The REST interface under /api/v1: bodies and responses. Every error is `{ error: { code, message } }` with
 * the HTTP status from ERROR_TABLE.
 *
 * GET /api/v1/openapi.json lists the routes; docs/api.md explains them.
 */
import { z } from "zod";
import { ERROR_CODES } from "../errors.js";
import { jobPlaceSchema, jobSchema } from "./job.js";
import { hasOneDrawing, ONE_DRAWING } from "./job-drawing.js";
import { listedMachineSchema } from "./machine.js";
import { nameSchema } from "./name.js";
import { plotterSettingsSchema } from "./plotter-settings.js";
import { givenMotionSchema, givenPenSchema, givenSettingsSchema } from "./given-settings.js";

/** Has either the text of a small drawing, or the id of a drawing uploaded before. */
export const newJobSchema = z
  .object({
    name: nameSchema(200),
    drawing: z.string().min(1).optional(),
    /** From POST /drawings. */
    drawingId: z.string().max(100).optional(),
    /** Laid over the plotter's settings; left out: these. */
    settings: givenSettingsSchema.optional(),
    plotterId: z.string().max(100).optional(),
    /** Number of jobs to create. */
    copies: z.int().min(1).max(100).optional(),
    /** Where to start; left out: at the beginning. When started, the job is held there until it is resumed. */
    from: jobPlaceSchema.optional(),
  })
  .refine(hasOneDrawing, ONE_DRAWING)
  .refine(({ from, copies = 1 }) => from === undefined || copies === 1, {
    path: ["copies"],
    message: "a job that starts in the middle has one copy",
  });
export type NewJob = z.infer<typeof newJobSchema>;

/** What may be sent with a drawing that is the body itself: in the query, or as fields of a form. */
export const fileFieldsSchema = z
  .object({
    /** Left out: that of the file, or drawing.svg. */
    name: nameSchema(200),
    /** As in `NewJob`, as JSON. */
    settings: z.string(),
    plotterId: z.string().max(100),
  })
  .partial();
export type FileFields = z.infer<typeof fileFieldsSchema>;

export const jobPatchSchema = z
  .object({
    name: nameSchema(200),
    /** Laid over the job's settings. */
    settings: givenSettingsSchema,
    /** Moves the job to another plotter's queue; only while queued. */
    plotterId: z.string().max(100),
  })
  .partial();
export type JobPatch = z.infer<typeof jobPatchSchema>;

/** Moves a queued job in front of another one, or to the end with null. */
export const moveJobSchema = z.object({ beforeId: z.string().nullable() });
export type MoveJob = z.infer<typeof moveJobSchema>;

/** While plotting or held; takes effect within a second and is stored with the job. Laid over the job's settings. */
export const jobChangeSchema = z
  .object({
    pen: givenPenSchema,
    motion: givenMotionSchema,
    speedPct: z.number().min(10).max(200),
  })
  .partial();
export type JobChange = z.infer<typeof jobChangeSchema>;

/** Forward, or back with negative values. */
export const movePlaceSchema = z
  .object({ strokes: z.int().min(-1_000_000).max(1_000_000), mm: z.number().min(-1e7).max(1e7) })
  .partial();
export type MovePlace = z.infer<typeof movePlaceSchema>;

/** As a query, which has texts. */
export const placeRequestSchema = z
  .object({
    strokes: z.coerce.number().int().min(-1_000_000).max(1_000_000),
    mm: z.coerce.number().min(-1e7).max(1e7),
  })
  .partial();
/** A place, and the point of the drawing there, mm from home. */
export const placeOnPaperSchema = jobPlaceSchema.extend({ xMm: z.number(), yMm: z.number() });
export type PlaceOnPaper = z.infer<typeof placeOnPaperSchema>;

/** Of a job that waits for another pen. */
export const jobPenSchema = z.object({ up: z.boolean() });

export const penRequestSchema = z.object({
  up: z.boolean(),
  heightPct: z.number().min(0).max(100).optional(),
  /** Heights and waits, laid over the plotter's settings. */
  settings: givenSettingsSchema.optional(),
});
export type PenRequest = z.infer<typeof penRequestSchema>;

export const plotterSchema = z.object({
  id: z.string(),
  /** The name given by the user. */
  name: z.string(),
  /** The name stored on the board (QT); null if it has none. */
  boardName: z.string().nullable().default(null),
  /** Serial number of its USB device; null if it has none. */
  boardSerialNumber: z.string().nullable().default(null),
  /** Id of the machine profile for manual moves; null: that of the last job. */
  machine: z.string().nullable().default(null),
  /** "virtual": no hardware, but the built-in board model. */
  kind: z.enum(["virtual", "serial"]),
  /** Serial path, for display; null for the virtual board. */
  device: z.string().nullable(),
  connection: z.enum(["absent", "connecting", "idle", "busy", "fault"]),
  /** Current activity; "held": a plot is waiting with the pen up. */
  activity: z.enum(["none", "plotting", "held", "moving"]).default("none"),
  firmware: z.string().nullable(),
  /** Max time that the motors keep running after an emergency stop, with this firmware and the last settings. */
  emergencyStopMs: z.number().nullable().default(null),
  /** What is wrong and what to do, or null. */
  message: z.string().nullable(),
  /** A board that the model does not fit: its name and version, and the kind of its controller. Null: none was found. */
  otherBoard: z.object({ answer: z.string(), controller: z.string() }).nullable().default(null),
  penUp: z.boolean().nullable(),
  /** The pen is still on its way up or down. */
  penMoving: z.boolean().default(false),
  /**
   * Its pen is moved by a Z axis, which counts from wherever the pen was when the controller was reset or switched on. A plot
   * that began before that must not be resumed until a user has turned the axis to the height at which the machine is
   * switched on: when it resumes, that is taken to be the height.
   */
  heightUnsure: z.boolean().default(false),
  motorsOn: z.boolean().nullable(),
  /** mm from home; null if unknown. */
  xMm: z.number().nullable(),
  yMm: z.number().nullable(),
});
export type Plotter = z.infer<typeof plotterSchema>;

/** What distinguishes a board from others. Many have neither a name nor a serial number. */
export const boardIdSchema = plotterSchema.pick({ boardName: true, boardSerialNumber: true, firmware: true });
export type BoardId = z.infer<typeof boardIdSchema>;

export const queueSettingsSchema = z.object({
  /**
   * False: the next job waits until a user has changed the paper and starts it. A sheet of a drawing that is spread over
   * several waits after another sheet in any case.
   */
  runOn: z.boolean(),
});
export type QueueSettings = z.infer<typeof queueSettingsSchema>;

/** The browser that may currently change things; all others may watch, and stop plots. */
export const operatorSchema = z.object({ id: z.string(), name: z.string() });
export type Operator = z.infer<typeof operatorSchema>;

/** A problem that was not caused by a request: for example a drawing in the watched folder that cannot be plotted. */
export const noticeSchema = z.object({ id: z.string(), at: z.string(), message: z.string() });
export type Notice = z.infer<typeof noticeSchema>;

const queuesSchema = z.record(z.string(), queueSettingsSchema);

/** A part of the jobs: first those of the queue in its order, then ended ones, newest first. */
export const jobPageSchema = z.object({
  jobs: z.array(jobSchema),
  /** There are older ended jobs: GET /history returns them. */
  hasOlderJobs: z.boolean().default(false),
});
export type JobPage = z.infer<typeof jobPageSchema>;

/**
 * GET /history: up to 50 ended jobs, those after the job `after` or else the newest, of one plotter or of all; with `name`,
 * those that have it in their name, in upper or lower case.
 */
export const historyRequestSchema = z
  .object({ after: z.string().max(100), plotterId: z.string().max(100), name: z.string().max(200) })
  .partial();
export type HistoryRequest = z.infer<typeof historyRequestSchema>;

/** Contains the whole queue, and the newest 50 jobs of the history. */
export const snapshotSchema = z.object({
  version: z.string(),
  /** Queue settings of the first plotter. */
  queue: queueSettingsSchema.default({ runOn: false }),
  /** Queue settings of every plotter, by its id. */
  queues: queuesSchema.default({}),
  /** Null: the first browser that acts becomes the operator. */
  operator: operatorSchema.nullable().default(null),
  serverNotices: z.array(noticeSchema).default([]),
  /** The server's name on the network, such as "plotwright.local"; null while it has none. */
  localName: z.string().nullable().default(null),
  plotters: z.array(plotterSchema),
  /** By plotter id; a plotter without settings is left out. */
  plotterSettings: z.record(z.string(), plotterSettingsSchema).default({}),
  /** Built-in and custom machines. */
  machines: z.array(listedMachineSchema).default([]),
  ...jobPageSchema.shape,
});
export type Snapshot = z.infer<typeof snapshotSchema>;

const penMomentSchema = z.object({
  /** Time in the job's trajectory, s, for the page's own copy of the plan. */
  planS: z.number(),
  xMm: z.number(),
  yMm: z.number(),
  penUp: z.boolean(),
  penMoving: z.boolean().default(false),
});

export const serverEventSchema = z.discriminatedUnion("type", [
  z.object({ type: z.literal("snapshot"), snapshot: snapshotSchema }),
  z.object({ type: z.literal("job"), job: jobSchema }),
  z.object({ type: z.literal("job-removed"), id: z.string() }),
  /** New Job.expectedS of waiting jobs, by id, after a plot of the same plotter has ended. */
  z.object({ type: z.literal("expected"), expectedS: z.record(z.string(), z.number()) }),
  /** Ids of the jobs of a snapshot, in its order. Older jobs of the history follow them. */
  z.object({ type: z.literal("order"), ids: z.array(z.string()) }),
  z.object({ type: z.literal("plotter"), plotter: plotterSchema }),
  /** A plotter was added, renamed or removed; contains all plotters. */
  z.object({ type: z.literal("plotters"), plotters: z.array(plotterSchema) }),
  z.object({
    type: z.literal("plotter-settings"),
    plotterId: z.string(),
    settings: plotterSettingsSchema,
  }),
  /** A custom machine was stored or removed; contains all machines. */
  z.object({ type: z.literal("machines"), machines: z.array(listedMachineSchema) }),
  /** Queue settings of the first plotter; a `queues` event with all of them follows. */
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
    ...penMomentSchema.shape,
    /** The host's time of this report, ms from an arbitrary start. */
    atMs: z.number(),
    /** How long the report waited before it was sent. */
    heldBackMs: z.number(),
    /** The pen every 20 ms from then: motion that the machine already has, and that only a stop can change. */
    ahead: z.array(penMomentSchema).readonly(),
  }),
]);
export type ServerEvent = z.infer<typeof serverEventSchema>;

/** The event in a line of the event stream; null for an unknown one, which a newer server may send. */
export const parseServerEvent = (data: string): ServerEvent | null => {
  try {
    const parsed = serverEventSchema.safeParse(JSON.parse(data));
    return parsed.success ? parsed.data : null;
  } catch {
    return null;
  }
};

export const apiErrorSchema = z.object({
  error: z.object({ code: z.enum(ERROR_CODES), message: z.string() }),
});
export type ApiError = z.infer<typeof apiErrorSchema>;
