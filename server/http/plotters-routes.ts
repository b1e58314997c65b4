/** /api/v1/plotters: moves by hand, while no job is plotting. */
import express, { Router } from "express";
import { PlotwrightError } from "../../src/index.js";
import { penRequestSchema } from "../../src/schema/index.js";
import type { JobQueue } from "../queue/job-queue.js";
import type { PlotterPort } from "../queue/plotter-port.js";
import { parseWith } from "./errors.js";

export function plottersRoutes(plotters: ReadonlyMap<string, PlotterPort>, queue: JobQueue): Router {
  const router = Router();
  router.use(express.json({ limit: "100kb" }));

  const find = (id: string): PlotterPort => {
    const plotter = plotters.get(id);
    if (plotter === undefined) throw new PlotwrightError("not-found", `There is no plotter ${id}.`);
    return plotter;
  };
  const findFree = (id: string): PlotterPort => {
    const plotter = find(id);
    if (queue.isPlotterBusy(id)) {
      throw new PlotwrightError("busy", "A job is on the plotter. Cancel it first, or wait for its end.");
    }
    return plotter;
  };

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
