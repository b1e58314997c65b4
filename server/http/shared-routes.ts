/** /api/v1/shared-jobs: the queue that several servers share. */
import express, { Router } from "express";
import { PlotwrightError } from "../../src/index.js";
import { newSharedJobSchema } from "../../src/schema/index.js";
import type { SharedQueue } from "../shared/shared-queue.js";
import { parseWith } from "./errors.js";

export function sharedRoutes(shared: SharedQueue | null): Router {
  const router = Router();
  const present = (): SharedQueue => {
    if (shared !== null) return shared;
    throw new PlotwrightError(
      "not-found",
      "This server has no shared queue. Start it with serve --shared-queue to use one.",
    );
  };
  // Check before the body is read, since it may be large.
  router.use((_request, _response, next) => {
    present();
    next();
  });
  router.get("/", async (_request, response) => {
    response.json({ jobs: await present().list() });
  });
  router.post("/", express.json({ limit: "50mb", inflate: false }), async (request, response) => {
    const id = await present().send(parseWith(newSharedJobSchema, request.body));
    response.status(201).json({ id });
  });
  router.post("/:id/give-back", async (request, response) => {
    await present().giveBack(request.params.id);
    response.json({ ok: true });
  });
  router.delete("/:id", async (request, response) => {
    await present().withdraw(request.params.id);
    response.json({ ok: true });
  });
  return router;
}
