/** /api/v1/shared-jobs: the queue that several servers share. */
import express, { Router } from "express";
import { z } from "zod";
import { PlotwrightError } from "../../../src/index.js";
import { newSharedJobSchema, sharedJobSchema } from "../../../src/schema/index.js";
import { okSchema, route, type ApiRoute } from "../../http/api-route.js";
import { parseWith } from "../../../host/parse-with.js";
import { readDrawing } from "../../planning/read-drawing.js";
import type { DrawingFiles } from "../../storage/drawing-files.js";
import type { UploadedDrawings } from "../../storage/uploaded-drawings.js";
import type { SharedQueue } from "./shared-queue.js";

/** The database keeps the whole drawing in one row. */
const MAX_DRAWING_BYTES = 50_000_000;

export const SHARED_ROUTES: readonly ApiRoute[] = [
  route(
    "get",
    "/shared-jobs",
    "Lists the jobs of the shared queue, newest first",
    z.object({ jobs: z.array(sharedJobSchema) }),
  ),
  route(
    "post",
    "/shared-jobs",
    "Adds a job to the shared queue, for a plotter's name or a machine",
    z.object({ id: z.string() }),
    { body: newSharedJobSchema, status: 201 },
  ),
  route(
    "post",
    "/shared-jobs/:id/give-back",
    "Gives back a job that an unreachable server took but did not start, so that another server can take it",
    okSchema,
  ),
  route("delete", "/shared-jobs/:id", "Withdraws a job that no server has taken", okSchema),
];

export function sharedRoutes(shared: SharedQueue, files: DrawingFiles, uploads: UploadedDrawings): Router {
  const router = Router();
  router.get("/", async (_request, response) => {
    response.json({ jobs: await shared.list() });
  });
  router.post("/", express.json({ limit: "1mb" }), async (request, response) => {
    const { drawing, drawingId, ...job } = parseWith(newSharedJobSchema, request.body);
    const text = drawingId === undefined ? (drawing ?? "") : await takeText(drawingId);
    response.status(201).json({ id: await shared.send({ ...job, drawing: text }) });
  });
  router.post("/:id/give-back", async (request, response) => {
    await shared.giveBack(request.params.id);
    response.json({ ok: true });
  });
  router.delete("/:id", async (request, response) => {
    await shared.withdraw(request.params.id);
    response.json({ ok: true });
  });
  return router;

  /** The text of an uploaded drawing, which is then removed: the database has it. */
  async function takeText(drawingId: string): Promise<string> {
    const { id, bytes } = uploads.claim(drawingId);
    try {
      if (bytes <= MAX_DRAWING_BYTES) return readDrawing(files.path(id));
      throw new PlotwrightError(
        "too-large",
        `The file is larger than ${MAX_DRAWING_BYTES / 1e6} MB, the limit of the shared queue. Simplify the drawing, or add it to the server that has the plotter.`,
      );
    } finally {
      await files.remove(id);
    }
  }
}
