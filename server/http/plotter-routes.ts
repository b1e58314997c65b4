/**
 * /api/v1/plotters and /devices: plotters, their queues, pens, motors and logs; moves are in
 * hand-move-routes.ts.
 */
import express, { Router } from "express";
import { z } from "zod";
import {
  deviceSchema,
  newPlotterSchema,
  penRequestSchema,
  plotterPatchSchema,
  plotterSchema,
  plotterSettingsSchema,
  queueSettingsSchema,
} from "../../src/schema/index.js";
import type { PlotterRegistry, PlotterUse } from "../../host/plotter/plotter-registry.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";
import { okSchema, route, type ApiRoute } from "./api-route.js";
import { parseWith } from "../../host/parse-with.js";
import { findFreePlotter, findPlotter } from "../../host/queue/find-plotter.js";

export const PLOTTER_ROUTES: readonly ApiRoute[] = [
  route(
    "get",
    "/devices",
    "Lists the boards that are plugged in",
    z.object({ devices: z.array(deviceSchema) }),
  ),
  route("post", "/plotters", "Adds a plotter", plotterSchema, { body: newPlotterSchema, status: 201 }),
  route("get", "/plotters/:id", "Returns a plotter", plotterSchema),
  route("patch", "/plotters/:id", "Changes name, device or machine of a plotter", plotterSchema, {
    body: plotterPatchSchema,
  }),
  route("delete", "/plotters/:id", "Removes a plotter without jobs", okSchema),
  route("get", "/plotters/:id/queue", "Returns the queue settings of a plotter", queueSettingsSchema),
  route("patch", "/plotters/:id/queue", "Changes the queue settings of a plotter", queueSettingsSchema, {
    body: queueSettingsSchema,
  }),
  route(
    "get",
    "/plotters/:id/settings",
    "Returns heights, pens and presets of a plotter; null if nothing was set",
    plotterSettingsSchema.nullable(),
  ),
  route(
    "put",
    "/plotters/:id/settings",
    "Stores heights, pens and presets of a plotter",
    plotterSettingsSchema,
    {
      body: plotterSettingsSchema,
    },
  ),
  route("get", "/plotters/:id/log", "Returns the commands and replies of the connection", "text"),
  route("post", "/plotters/:id/pen", "Lifts or lowers the pen", plotterSchema, { body: penRequestSchema }),
  route(
    "post",
    "/plotters/:id/motors-off",
    "Switches the motors off, so that the carriage can be pushed by hand",
    plotterSchema,
  ),
];

export function plotterRoutes(
  registry: PlotterRegistry,
  queue: JobQueue,
  log: (line: string) => void,
): Router {
  const router = Router();
  const small = express.json({ limit: "10kb" });
  const find = (id: string): PlotterPort => findPlotter(registry.ports, id);
  const findFree = (id: string): PlotterPort => findFreePlotter(registry.ports, queue, id);
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

  router.get("/plotters/:id", (request, response) => {
    response.json(find(request.params.id).snapshot());
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
    const { id } = find(request.params.id);
    response.json(queue.settings(id));
  });

  router.patch("/plotters/:id/queue", small, (request, response) => {
    const settings = parseWith(queueSettingsSchema, request.body);
    response.json(queue.saveSettings(settings, request.params.id));
  });

  router.get("/plotters/:id/settings", (request, response) => {
    const { id } = find(request.params.id);
    response.json(registry.settings()[id] ?? null);
  });

  router.put("/plotters/:id/settings", express.json({ limit: "2mb" }), (request, response) => {
    const settings = parseWith(plotterSettingsSchema, request.body);
    response.json(registry.saveSettings(request.params.id, settings));
  });

  router.get("/plotters/:id/log", (request, response) => {
    const plotter = find(request.params.id);
    response.attachment(`plotwright-${plotter.id}.log`).type("text/plain; charset=utf-8").send(plotter.log());
  });

  router.post("/plotters/:id/pen", small, async (request, response) => {
    const { up, heightPct, settings } = parseWith(penRequestSchema, request.body);
    const plotter = findFree(request.params.id);
    await plotter.pen(up, heightPct, queue.handSettings(plotter.id, { settings }));
    response.json(plotter.snapshot());
  });

  router.post("/plotters/:id/motors-off", async (request, response) => {
    const plotter = findFree(request.params.id);
    await plotter.motorsOff();
    response.json(plotter.snapshot());
  });

  return router;
}
