/**
 * The one table of operations: everything that clients can ask of a server, or a page of its own host. The server's
 * routes and guards, the OpenAPI document, docs/http-reference.md and the clients of page and command line are made
 * from it. The handlers are in host/operations/ and, for what only a server has, in server/.
 *
 * To add an operation: its row here, its handler, and the code that calls it.
 */
import { z, type ZodType } from "zod";
import {
  accessEntrySchema,
  meSchema,
  newKeySchema,
  askedDeviceSchema,
  deviceSchema,
  newPlotterSchema,
  newWebhookSchema,
  pairingSchema,
  plotterPatchSchema,
  webhookSchema,
} from "./sharing.js";
import {
  fileFieldsSchema,
  historyRequestSchema,
  jobChangeSchema,
  jobPageSchema,
  jobPenSchema,
  jobPatchSchema,
  moveJobSchema,
  movePlaceSchema,
  newJobSchema,
  operatorSchema,
  penRequestSchema,
  placeOnPaperSchema,
  placeRequestSchema,
  plotterSchema,
  queueSettingsSchema,
  snapshotSchema,
} from "./api.js";
import {
  commandAnswerSchema,
  commandRequestSchema,
  frameRequestSchema,
  handMoveRequestSchema,
  jogRequestSchema,
  servoRequestSchema,
  squareRequestSchema,
  moveToRequestSchema,
} from "./hand-moves.js";
import { cameraSchema, cameraStateSchema, keptPicturesSchema, pictureRequestSchema } from "./camera.js";
import { jobSchema } from "./job.js";
import { LIBRARY_OPERATIONS } from "./library.js";
import { liveFieldsSchema, liveSentSchema } from "./live.js";
import { machineListSchema, machineProfileSchema } from "./machine.js";
import { okSchema, operation, type ClientOf, type HandlersOf } from "./operation.js";
import { plotterDefaultsSchema, plotterSettingsSchema } from "./plotter-settings.js";
import { newSharedJobSchema, sharedJobSchema } from "./shared.js";

const idSchema = z.object({ id: z.string() });

/** A change of a job or plotter. */
const CHANGE = { maxBodyBytes: 200_000 } as const;
/** What those who submit jobs may do with their own. */
const SUBMIT = { role: "submit" } as const;
/** Small enough to be parsed in the server's thread, which also streams to the board. */
const NEW_JOB = { maxBodyBytes: 8_000_000, status: 201 } as const;

/** An action on a job that needs no further data. */
const action = <const Name extends string, const More extends { readonly role?: "stop" | "submit" }>(
  name: Name,
  about: string,
  more?: More,
) => operation("post", `/jobs/:id/${name}`, about, jobSchema, more);

const move = <const Kind extends string, Body extends ZodType>(kind: Kind, about: string, body: Body) =>
  operation("post", `/plotters/:id/${kind}`, about, plotterSchema, {
    body,
    isBodyOptional: true,
    maxBodyBytes: 1_048_576,
  });

export const OPERATIONS = {
  state: {
    get: operation(
      "get",
      "/state",
      "Returns the state of the server: everything but older jobs of the history",
      snapshotSchema,
    ),
    history: operation(
      "get",
      "/history",
      "Returns up to 50 ended jobs: those after the job ?after=ID of the history, or the newest ones, of all plotters or of ?plotterId=ID, all or those with ?name=PART in their name",
      jobPageSchema,
      { query: historyRequestSchema },
    ),
    events: operation("get", "/events", "Streams a snapshot, then every change", "events"),
    me: operation("get", "/me", "Returns the role and identity of the caller", meSchema),
    openApi: operation(
      "get",
      "/openapi.json",
      "Returns the OpenAPI description of this interface",
      z.looseObject({}),
    ),
    queue: operation("get", "/queue", "Returns the queue settings of the first plotter", queueSettingsSchema),
    setQueue: operation(
      "patch",
      "/queue",
      "Changes the queue settings of the first plotter",
      queueSettingsSchema,
      { body: queueSettingsSchema },
    ),
  },

  drawings: {
    upload: operation(
      "post",
      "/drawings",
      "Uploads a drawing, the file as the body; use its id in POST /jobs within ten minutes",
      idSchema,
      { body: "file", status: 201, ...SUBMIT },
    ),
  },

  jobs: {
    add: operation(
      "post",
      "/jobs",
      "Adds a job from JSON with an uploaded drawing's id or, up to 8 MB, with its text; from the file itself as the body with ?name=; or from a form with the file",
      jobSchema,
      { body: newJobSchema, fileFields: fileFieldsSchema, ...NEW_JOB, ...SUBMIT },
    ),
    get: operation("get", "/jobs/:id", "Returns a job", jobSchema),
    drawing: operation("get", "/jobs/:id/drawing", "Returns the uploaded file", "file"),
    patch: operation("patch", "/jobs/:id", "Changes name, settings or plotter of a job", jobSchema, {
      body: jobPatchSchema,
      ...CHANGE,
      ...SUBMIT,
    }),
    move: operation("post", "/jobs/:id/move", "Moves a job in the queue", okSchema, {
      body: moveJobSchema,
      ...CHANGE,
    }),
    start: action("start", "Starts plotting"),
    pause: action("pause", "Slows down to a stop and lifts the pen", { role: "stop" }),
    resume: action("resume", "Resumes a paused job"),
    cancel: action("cancel", "Cancels a job: the pen lifts and goes home", { role: "stop" }),
    requeue: action("requeue", "Queues an ended job again", SUBMIT),
    recover: action("recover", "Continues an interrupted or cancelled job, paused at first"),
    "emergency-stop": action("emergency-stop", "Stops at once, without slowing down", { role: "stop" }),
    change: operation(
      "post",
      "/jobs/:id/change",
      "Changes pen heights and speeds while plotting",
      jobSchema,
      { body: jobChangeSchema, ...CHANGE },
    ),
    place: operation(
      "post",
      "/jobs/:id/place",
      "Moves the place from which a paused job resumes",
      jobSchema,
      { body: movePlaceSchema, ...CHANGE },
    ),
    placeAfter: operation(
      "get",
      "/jobs/:id/place",
      "Returns where moving that place by ?strokes= and ?mm= would lead, and where that is on the paper",
      placeOnPaperSchema,
      { query: placeRequestSchema, role: "watch" },
    ),
    "check-place": action("check-place", "Moves to the place where a paused job resumes, with the pen up"),
    pen: operation(
      "post",
      "/jobs/:id/pen",
      "Lifts or lowers the pen of a job that waits for another pen, so that the new one can be set on the paper",
      jobSchema,
      { body: jobPenSchema, ...CHANGE },
    ),
    duplicate: operation("post", "/jobs/:id/duplicate", "Queues a copy of a job", jobSchema, {
      status: 201,
      ...SUBMIT,
    }),
    remove: operation("delete", "/jobs/:id", "Removes a job", okSchema, SUBMIT),
  },

  plotters: {
    devices: operation(
      "get",
      "/devices",
      "Lists the boards that are plugged in, and devices that may be one",
      z.object({ devices: z.array(deviceSchema) }),
    ),
    ask: operation(
      "post",
      "/devices/ask",
      "Asks them what they are; some devices restart when their port is opened",
      z.object({ devices: z.array(askedDeviceSchema) }),
    ),
    add: operation("post", "/plotters", "Adds a plotter", plotterSchema, {
      body: newPlotterSchema,
      status: 201,
    }),
    get: operation("get", "/plotters/:id", "Returns a plotter", plotterSchema),
    patch: operation(
      "patch",
      "/plotters/:id",
      "Changes name, device or machine of a plotter",
      plotterSchema,
      { body: plotterPatchSchema },
    ),
    remove: operation("delete", "/plotters/:id", "Removes a plotter without jobs", okSchema),
    queue: operation(
      "get",
      "/plotters/:id/queue",
      "Returns the queue settings of a plotter",
      queueSettingsSchema,
    ),
    setQueue: operation(
      "patch",
      "/plotters/:id/queue",
      "Changes the queue settings of a plotter",
      queueSettingsSchema,
      { body: queueSettingsSchema },
    ),
    settings: operation(
      "get",
      "/plotters/:id/settings",
      "Returns heights, pens and presets of a plotter; null if nothing was set",
      plotterSettingsSchema.nullable(),
    ),
    saveSettings: operation(
      "put",
      "/plotters/:id/settings",
      "Stores heights, pens and presets of a plotter",
      plotterSettingsSchema,
      { body: plotterSettingsSchema, maxBodyBytes: 2_097_152 },
    ),
    defaults: operation(
      "get",
      "/plotters/:id/defaults",
      "Returns the settings from which jobs of a plotter start, and its presets as settings to give with a job",
      plotterDefaultsSchema,
    ),
    log: operation("get", "/plotters/:id/log", "Returns the commands and replies of the connection", "text", {
      role: "watch",
      attachment: "plotwright-:id.log",
    }),
    pen: operation("post", "/plotters/:id/pen", "Lifts or lowers the pen", plotterSchema, {
      body: penRequestSchema,
    }),
    motorsOff: operation(
      "post",
      "/plotters/:id/motors-off",
      "Switches the motors off, so that the carriage can be pushed by hand",
      plotterSchema,
    ),
    stop: operation(
      "post",
      "/plotters/:id/stop",
      "Stops a move by hand at once and lifts the pen",
      plotterSchema,
      {
        role: "stop",
      },
    ),
  },

  liveDrawings: {
    draw: operation(
      "get",
      "/plotters/:id/live",
      "Opens a WebSocket for a live drawing: strokes are drawn while they are made",
      "socket",
      { role: "operate" },
    ),
    send: operation(
      "post",
      "/plotters/:id/live",
      "Draws the lines of the body while they come: a point x y on each, up to lift the pen, or a whole stroke; answers when all is drawn",
      liveSentSchema,
      { body: "file", fileFields: liveFieldsSchema },
    ),
  },

  /** The names are the kinds of `HandMove`. */
  moves: {
    home: move(
      "home",
      "Lifts the pen and moves home; a machine with limit switches finds it with them",
      handMoveRequestSchema,
    ),
    "move-to": move("move-to", "Moves to a position in mm from home, pen up", moveToRequestSchema),
    jog: move("jog", "Moves by a distance in mm, pen up", jogRequestSchema),
    "set-home": move("set-home", "Makes the current position home", handMoveRequestSchema),
    "cycle-pen": move("cycle-pen", "Lowers the pen and lifts it again", handMoveRequestSchema),
    frame: move("frame", "Moves around a job's drawing or a box and back, pen up", frameRequestSchema),
    "test-line": move("test-line", "Draws a line of 20 mm near the current position", handMoveRequestSchema),
    "test-patch": move(
      "test-patch",
      "Draws a small test pattern at the current position",
      handMoveRequestSchema,
    ),
    square: move("square", "Draws a square for measuring", squareRequestSchema),
    servo: move("servo", "Sets a raw servo position", servoRequestSchema),
  },

  console: {
    command: operation("post", "/plotters/:id/command", "Sends one line to the board", commandAnswerSchema, {
      body: commandRequestSchema,
      maxBodyBytes: 1_048_576,
    }),
  },

  machines: {
    list: operation("get", "/machines", "Lists the machine profiles", machineListSchema),
    save: operation("put", "/machines/:id", "Stores a custom machine profile", machineProfileSchema, {
      body: machineProfileSchema,
      maxBodyBytes: 102_400,
    }),
    remove: operation("delete", "/machines/:id", "Removes a custom machine profile", okSchema),
  },

  samples: {
    list: operation(
      "get",
      "/samples",
      "Lists the sample drawings",
      z.object({ samples: z.array(z.object({ name: z.string(), title: z.string() })) }),
    ),
    get: operation("get", "/samples/:name", "Returns a sample drawing", "text"),
  },

  operator: {
    take: operation(
      "post",
      "/operator/take",
      "Makes the calling browser the operator",
      z.object({ operator: operatorSchema }),
    ),
    dismissNotice: operation("delete", "/notices/:id", "Dismisses a notice", okSchema),
    // Anyone with such a link gets access.
    pairing: operation(
      "post",
      "/pairing",
      "Returns the links that pair a device; only on the server's computer",
      pairingSchema,
      { role: "local" },
    ),
    logs: operation("get", "/logs", "Returns all logs as one text, for a bug report", "text", {
      role: "operate",
      attachment: "plotwright-logs.txt",
    }),
  },

  access: {
    list: operation(
      "get",
      "/access",
      "Lists sessions and keys",
      z.object({ entries: z.array(accessEntrySchema) }),
      { role: "operate" },
    ),
    addKey: operation(
      "post",
      "/access/keys",
      "Creates a key",
      z.object({ entry: accessEntrySchema, secret: z.string() }),
      { body: newKeySchema, status: 201 },
    ),
    revoke: operation("delete", "/access/:id", "Revokes a session or key", okSchema),
  },

  webhooks: {
    list: operation(
      "get",
      "/webhooks",
      "Lists the webhooks",
      z.object({ webhooks: z.array(webhookSchema) }),
      { role: "operate" },
    ),
    add: operation(
      "post",
      "/webhooks",
      "Adds a webhook; its secret is returned only here",
      z.object({ webhook: webhookSchema, secret: z.string() }),
      { body: newWebhookSchema, status: 201 },
    ),
    remove: operation("delete", "/webhooks/:id", "Removes a webhook", okSchema),
  },

  cameras: {
    get: operation(
      "get",
      "/plotters/:id/camera",
      "Returns the camera that the server reads while this plotter plots, with its address",
      cameraStateSchema,
      { role: "operate" },
    ),
    set: operation(
      "put",
      "/plotters/:id/camera",
      "Sets that camera, and tries it: the server keeps a picture every few seconds of a plot",
      cameraStateSchema,
      { body: cameraSchema },
    ),
    remove: operation(
      "delete",
      "/plotters/:id/camera",
      "Removes that camera; pictures that were taken stay with their jobs",
      okSchema,
    ),
    pictures: operation(
      "get",
      "/jobs/:id/pictures",
      "Lists the pictures that were taken while a job was plotted, oldest first",
      keptPicturesSchema,
    ),
    picture: operation("get", "/jobs/:id/picture", "Returns one of these pictures: ?at=TIME", "picture", {
      query: pictureRequestSchema,
    }),
  },

  library: LIBRARY_OPERATIONS,

  sharedJobs: {
    list: operation(
      "get",
      "/shared-jobs",
      "Lists the jobs of the shared queue, newest first",
      z.object({ jobs: z.array(sharedJobSchema) }),
      { role: "watch" },
    ),
    add: operation(
      "post",
      "/shared-jobs",
      "Adds a job to the shared queue, for a plotter's name or a machine",
      idSchema,
      { body: newSharedJobSchema, status: 201, maxBodyBytes: 1_048_576 },
    ),
    giveBack: operation(
      "post",
      "/shared-jobs/:id/give-back",
      "Gives back a job that an unreachable server took but did not start, so that another server can take it",
      okSchema,
    ),
    withdraw: operation("delete", "/shared-jobs/:id", "Withdraws a job that no server has taken", okSchema),
  },
} as const;

export type Operations = typeof OPERATIONS;
export type OperationGroup = keyof Operations;
export type OperationClient = ClientOf<Operations>;
export type OperationHandlers<Context> = HandlersOf<Operations, Context>;
