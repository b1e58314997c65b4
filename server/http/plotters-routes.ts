/** /api/v1/plotters: a plotter, its log, its pen and motors; moves are in hand-moves-routes.ts. */
import express, { Router } from "express";
import { penRequestSchema } from "../../src/schema/index.js";
import type { JobQueue } from "../queue/job-queue.js";
import type { PlotterPort } from "../queue/plotter-port.js";
import { parseWith } from "./errors.js";
import { findFreePlotter, findPlotter } from "./find-plotter.js";

export function plottersRoutes(plotters: ReadonlyMap<string, PlotterPort>, queue: JobQueue): Router {
  const router = Router();
  router.use(express.json({ limit: "100kb" }));

  const find = (id: string): PlotterPort => findPlotter(plotters, id);
  const findFree = (id: string): PlotterPort => findFreePlotter(plotters, queue, id);

  router.get("/:id", (request, response) => {
    response.json(find(request.params.id).snapshot());
  });

  router.get("/:id/log", (request, response) => {
    const plotter = find(request.params.id);
    response.attachment(`plotwright-${plotter.id}.log`).type("text/plain; charset=utf-8").send(plotter.log());
  });

  router.post("/:id/pen", async (request, response) => {
    const { up, heightPct } = parseWith(penRequestSchema, request.body);
    const plotter = findFree(request.params.id);
    await plotter.pen(up, heightPct);
    response.json(plotter.snapshot());
  });

  router.post("/:id/motors-off", async (request, response) => {
    const plotter = findFree(request.params.id);
    await plotter.motorsOff();
    response.json(plotter.snapshot());
  });

  return router;
}
