/** /api/v1/jobs: add, change, order, run and remove jobs. */
import express, { Router, type Request, type Response } from "express";
import { basename } from "node:path";
import { z, type ZodType } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { isDrawingName } from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  cleanName,
  jobChangeSchema,
  jobPatchSchema,
  jobSchema,
  moveJobSchema,
  movePlaceSchema,
  nameSchema,
  newJobSchema,
  plotSettingsSchema,
  type Job,
} from "../../src/schema/index.js";
import type { MachineFiles } from "../storage/machine-files.js";
import type { Requester } from "../../host/planning/lane.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { UploadedDrawings } from "../storage/uploaded-drawings.js";
import { okSchema, route, type ApiRoute } from "./api-route.js";
import { bytesOf } from "./drawing-routes.js";
import { parseWith } from "./errors.js";

export interface JobParts {
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
  readonly uploads: UploadedDrawings;
  readonly machines: MachineFiles;
}

/** Small enough to be parsed in this thread, which also streams to the board. */
const MAX_JSON_BYTES = 8_000_000;
const MAX_CHANGE_BYTES = 200_000;

const action = (name: string, about: string, body?: ZodType): ApiRoute =>
  route("post", `/jobs/:id/${name}`, about, jobSchema, body === undefined ? {} : { body });

export const JOB_ROUTES: readonly ApiRoute[] = [
  route(
    "post",
    "/jobs",
    "Adds a job from JSON with an uploaded drawing's id or, up to 8 MB, with its text; or from the file itself as the body with ?name=",
    jobSchema,
    { body: newJobSchema, status: 201 },
  ),
  route("get", "/jobs/:id", "Returns a job", jobSchema),
  route("get", "/jobs/:id/drawing", "Returns the uploaded file", "text"),
  route("patch", "/jobs/:id", "Changes name, settings or plotter of a job", jobSchema, {
    body: jobPatchSchema,
  }),
  route("post", "/jobs/:id/move", "Moves a job in the queue", okSchema, { body: moveJobSchema }),
  action("start", "Starts plotting"),
  action("pause", "Slows down to a stop and lifts the pen"),
  action("resume", "Resumes a paused job"),
  action("cancel", "Cancels a job: the pen lifts and goes home"),
  action("requeue", "Queues an ended job again"),
  action("recover", "Continues an interrupted or cancelled job, paused at first"),
  action("emergency-stop", "Stops at once, without slowing down"),
  action("change", "Changes pen heights and speeds while plotting", jobChangeSchema),
  action("place", "Moves the place from which a paused job resumes", movePlaceSchema),
  action("check-place", "Moves to the place where a paused job resumes, with the pen up"),
  route("post", "/jobs/:id/duplicate", "Queues a copy of a job", jobSchema, { status: 201 }),
  route("delete", "/jobs/:id", "Removes a job", okSchema),
];

export function jobRoutes({ queue, files, uploads, machines }: JobParts): Router {
  const router = Router();
  const small = express.json({ limit: MAX_CHANGE_BYTES });

  const limit = Math.min(MAX_JSON_BYTES, files.maxBytes);

  router.post("/", express.json({ limit }), async (request, response) => {
    const requester = requesterOf(request, response);
    const job = await (request.is("json") !== false
      ? addFromJson(request, requester)
      : addFromFile(request, requester));
    response.status(201).location(`/api/v1/jobs/${job.id}`).json(job);
  });

  router.get("/:id", (request, response) => {
    response.json(queue.get(request.params.id));
  });

  // Sent as a plain-text attachment: a browser must never run scripts of an uploaded SVG.
  router.get("/:id/drawing", (request, response, next) => {
    const { id } = request.params;
    response.attachment(fileName(queue.get(id).name));
    response.type("text/plain; charset=utf-8");
    response.sendFile(files.path(queue.drawingOf(id)), { dotfiles: "allow" }, (error) => {
      if (error !== undefined && error !== null) next(error);
    });
  });

  router.patch("/:id", small, async (request, response) => {
    const { settings, ...patch } = parseWith(jobPatchSchema, request.body);
    const whole = settings === undefined ? {} : { settings: machines.withMachine(settings) };
    const requester = requesterOf(request, response);
    response.json(await queue.patch(request.params.id, { ...patch, ...whole }, requester));
  });

  router.post("/:id/move", small, (request, response) => {
    queue.move(request.params.id, parseWith(moveJobSchema, request.body).beforeId);
    response.json({ ok: true });
  });

  const actions: Readonly<Record<string, (id: string) => Job>> = {
    pause: (id) => queue.pause(id),
    resume: (id) => queue.resume(id),
    cancel: (id) => queue.cancel(id),
    requeue: (id) => queue.requeue(id),
  };
  for (const [name, act] of Object.entries(actions)) {
    router.post(`/:id/${name}`, (request, response) => {
      response.json(act(request.params.id));
    });
  }

  // Shortly after its start the server is still looking for boards, so wait for that.
  const onBoard: Readonly<Record<string, (id: string) => Job | Promise<Job>>> = {
    start: (id) => queue.start(id),
    recover: (id) => queue.recover(id),
  };
  for (const [name, act] of Object.entries(onBoard)) {
    router.post(`/:id/${name}`, async (request, response) => {
      await queue.plotterSettled(request.params["id"]);
      response.json(await act(request.params["id"]));
    });
  }

  router.post("/:id/duplicate", (request, response) => {
    response.status(201).json(queue.duplicate(request.params.id));
  });

  router.post("/:id/emergency-stop", async (request, response) => {
    response.json(await queue.emergencyStop(request.params.id));
  });

  router.post("/:id/change", small, async (request, response) => {
    response.json(await queue.change(request.params.id, parseWith(jobChangeSchema, request.body)));
  });

  router.post("/:id/place", small, (request, response) => {
    response.json(queue.movePlace(request.params.id, parseWith(movePlaceSchema, request.body)));
  });

  router.post("/:id/check-place", async (request, response) => {
    response.json(await queue.checkPlace(request.params.id));
  });

  router.delete("/:id", async (request, response) => {
    await queue.remove(request.params.id);
    response.json({ ok: true });
  });

  return router;

  async function addFromJson(request: Request, requester: Requester): Promise<Job> {
    const { drawing, drawingId, copies = 1, ...rest } = parseWith(newJobSchema, request.body);
    const settings = machines.withMachine(rest.settings);
    const stored =
      drawingId === undefined
        ? await files.add([Buffer.from(drawing ?? "", "utf8")])
        : uploads.claim(drawingId);
    const first = await queue.add({ ...rest, settings, drawing: stored }, requester);
    for (let copy = 1; copy < copies; copy++) queue.duplicate(first.id);
    return first;
  }

  /** The body is the file: `curl --data-binary @x.svg '…/jobs?name=x.svg'`. */
  async function addFromFile(request: Request, requester: Requester): Promise<Job> {
    const { name, settings, plotterId } = request.query;
    const wanted = {
      name:
        typeof name === "string"
          ? parseWith(z.object({ name: nameSchema(200) }), { name: basename(name.trim()).slice(0, 200) }).name
          : "drawing.svg",
      settings:
        settings === undefined
          ? DEFAULT_PLOT_SETTINGS
          : machines.withMachine(parseWith(plotSettingsSchema, asJson(settings))),
      ...(typeof plotterId === "string" ? { plotterId } : {}),
    };
    const drawing = await files.addFile(bytesOf(request));
    return queue.add({ ...wanted, drawing }, requester);
  }
}

/** Identifies the client; planning is aborted when it disconnects before the answer. */
function requesterOf(request: Request, response: Response): Requester {
  const gone = new AbortController();
  response.on("close", () => {
    if (!response.writableFinished) gone.abort();
  });
  return { client: request.socket.remoteAddress, signal: gone.signal };
}

function asJson(value: unknown): unknown {
  try {
    return JSON.parse(String(value)) as unknown;
  } catch (cause) {
    throw new PlotwrightError("bad-setting", "settings: not valid JSON.", { cause });
  }
}

/** A file name that is valid on every system. */
function fileName(name: string): string {
  const safe = cleanName(name).replace(/[<>:"/\\|?*\x00-\x1f]/g, "_");
  return isDrawingName(safe) ? safe : `${safe}.svg`;
}
