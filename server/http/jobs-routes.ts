/** /api/v1/jobs: add, change, order, run and remove jobs. */
import express, { Router, type Request, type Response } from "express";
import { basename } from "node:path";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { isDrawingName } from "../../src/internal.js";
import {
  DEFAULT_PLOT_SETTINGS,
  cleanName,
  jobChangeSchema,
  jobPatchSchema,
  moveJobSchema,
  movePlaceSchema,
  nameSchema,
  newJobSchema,
  plotSettingsSchema,
  type Job,
} from "../../src/schema/index.js";
import type { MachineFiles } from "../machines/machine-files.js";
import type { Requester } from "../planning/lane.js";
import { MAX_PARSED_BYTES } from "../planning/unpack.js";
import type { DrawingFiles } from "../queue/drawing-files.js";
import type { JobQueue } from "../queue/job-queue.js";
import { parseWith } from "./errors.js";

export function jobsRoutes(queue: JobQueue, files: DrawingFiles, machines: MachineFiles): Router {
  const router = Router();
  const small = express.json({ limit: MAX_PARSED_BYTES });

  router.post("/", (request, response, next) => {
    if (isSmall(request)) small(request, response, next);
    else next();
  });
  router.post("/", async (request, response) => {
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
    response.sendFile(queue.drawingPath(id), { dotfiles: "allow" }, (error) => {
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
    if (isSmall(request)) {
      const { drawing, copies, ...rest } = parseWith(newJobSchema, request.body);
      const settings = machines.withMachine(rest.settings);
      const stored = await files.add([Buffer.from(drawing, "utf8")]);
      const first = await queue.add({ ...rest, settings, drawing: stored }, requester);
      return withCopies(first, copies);
    }
    const { drawing, rest } = await files.addFromJson(bytesOf(request));
    try {
      const { copies, ...wanted } = parseWith(newJobSchema.omit({ drawing: true }), rest);
      const settings = machines.withMachine(wanted.settings);
      return withCopies(await queue.add({ ...wanted, settings, drawing }, requester), copies);
    } catch (error) {
      await files.remove(drawing.id);
      throw error;
    }
  }

  function withCopies(first: Job, copies = 1): Job {
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
    const drawing = await files.add(bytesOf(request));
    if (drawing.bytes === 0) {
      await files.remove(drawing.id);
      throw new PlotwrightError("bad-file", "The file is empty. Send the SVG as the request's body.");
    }
    return queue.add({ ...wanted, drawing }, requester);
  }
}

/** Small bodies are parsed here; larger ones are written to disk and parsed in a worker thread. */
function isSmall(request: Request): boolean {
  const bytes = request.headers["content-length"];
  return bytes !== undefined && Number(bytes) <= MAX_PARSED_BYTES;
}

/** Identifies the client; planning is aborted when it disconnects before the answer. */
function requesterOf(request: Request, response: Response): Requester {
  const gone = new AbortController();
  response.on("close", () => {
    if (!response.writableFinished) gone.abort();
  });
  return { client: request.socket.remoteAddress, signal: gone.signal };
}

/** Leaves the connection open when reading stops early, so that an error can still be sent. */
const bytesOf = (request: Request): AsyncIterable<Uint8Array> =>
  request.iterator({ destroyOnReturn: false }) as AsyncIterable<Uint8Array>;

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
