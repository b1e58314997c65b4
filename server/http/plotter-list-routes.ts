/** /api/v1: which plotters there are, and how the queue of each runs. */
import express, { Router } from "express";
import { newPlotterSchema, plotterPatchSchema, queueSettingsSchema } from "../../src/schema/index.js";
import type { PlotterRegistry, PlotterUse } from "../plotter-registry.js";
import type { JobQueue } from "../queue/job-queue.js";
import { plotterOf } from "../queue/plot-runs.js";
import { parseWith } from "./errors.js";

export function plotterListRoutes(
  registry: PlotterRegistry,
  queue: JobQueue,
  log: (line: string) => void,
): Router {
  const router = Router();
  const small = express.json({ limit: "10kb" });
  const use: PlotterUse = {
    isBusy: (id) => queue.isPlotterBusy(id),
    liveJobCount: (id) => queue.liveJobCount(id),
  };

  router.get("/devices", async (_request, response) => {
    response.json({ devices: await registry.devices() });
  });

  router.post("/plotters", small, (request, response) => {
    const plotter = registry.add(parseWith(newPlotterSchema, request.body));
    log(`plotter "${plotter.name}" added`);
    response.status(201).location(`/api/v1/plotters/${plotter.id}`).json(plotter);
  });

  router.patch("/plotters/:id", small, async (request, response) => {
    const patch = parseWith(plotterPatchSchema, request.body);
    response.json(await registry.patch(request.params.id, patch, use));
  });

  router.delete("/plotters/:id", async (request, response) => {
    await registry.remove(request.params.id, use);
    log(`plotter ${request.params.id} removed`);
    response.json({ ok: true });
  });

  router.get("/plotters/:id/queue", (request, response) => {
    const { id } = plotterOf({ plotters: registry.ports }, request.params.id);
    response.json(queue.settings(id));
  });

  router.patch("/plotters/:id/queue", small, (request, response) => {
    const settings = parseWith(queueSettingsSchema, request.body);
    response.json(queue.saveSettings(settings, request.params.id));
  });

  return router;
}
