/** /api/v1/jobs: add, change, order, run and remove jobs. */
import express, { Router } from "express";
import type { ZodType } from "zod";
import { isDrawingName } from "../../src/internal.js";
import {
  cleanName,
  jobChangeSchema,
  jobPatchSchema,
  jobSchema,
  moveJobSchema,
  movePlaceSchema,
  newJobSchema,
} from "../../src/schema/index.js";
import { jobActions } from "../../host/queue/job-actions.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import { okSchema, route, type ApiRoute } from "./api-route.js";
import { parseWith } from "../../host/parse-with.js";
import { addJob, requesterOf, type JobParts } from "./new-job.js";

/** Small enough to be parsed in this thread, which also streams to the board. */
const MAX_JSON_BYTES = 8_000_000;
const MAX_CHANGE_BYTES = 200_000;
const small = express.json({ limit: MAX_CHANGE_BYTES });

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

export function jobRoutes(parts: JobParts): Router {
  const router = Router();
  addJobRoutes(router, parts);
  addQueueRoutes(router, parts);
  addPlottingRoutes(router, parts.queue);
  return router;
}

/** Adds, returns, changes and removes jobs. */
function addJobRoutes(router: Router, parts: JobParts): void {
  const { queue, files } = parts;
  const limit = Math.min(MAX_JSON_BYTES, files.maxBytes);

  router.post("/", express.json({ limit }), async (request, response) => {
    const job = await addJob(parts, request, requesterOf(request, response));
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
    const patch = parseWith(jobPatchSchema, request.body);
    response.json(await queue.patch(request.params.id, patch, requesterOf(request, response)));
  });

  router.delete("/:id", async (request, response) => {
    await queue.remove(request.params.id);
    response.json({ ok: true });
  });
}

/** Orders the queue, and adds copies of jobs. */
function addQueueRoutes(router: Router, { queue }: JobParts): void {
  router.post("/:id/move", small, (request, response) => {
    queue.move(request.params.id, parseWith(moveJobSchema, request.body).beforeId);
    response.json({ ok: true });
  });

  router.post("/:id/duplicate", (request, response) => {
    response.status(201).json(queue.duplicate(request.params.id));
  });
}

/** Acts on jobs, and changes plots while they run. */
function addPlottingRoutes(router: Router, queue: JobQueue): void {
  for (const [name, act] of Object.entries(jobActions(queue))) {
    router.post(`/:id/${name}`, async (request, response) => {
      response.json(await act(request.params["id"]));
    });
  }

  router.post("/:id/change", small, async (request, response) => {
    response.json(await queue.change(request.params.id, parseWith(jobChangeSchema, request.body)));
  });

  router.post("/:id/place", small, (request, response) => {
    response.json(queue.movePlace(request.params.id, parseWith(movePlaceSchema, request.body)));
  });
}

/** A file name that is valid on every system. */
function fileName(name: string): string {
  const safe = cleanName(name).replace(/[<>:"/\\|?*\x00-\x1f]/g, "_");
  return isDrawingName(safe) ? safe : `${safe}.svg`;
}
