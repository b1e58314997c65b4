/** /api/v1/plotters/:id/…: manual moves and the board's console, while no job is plotting. */
import express, { Router, type Request } from "express";
import type { ZodType } from "zod";
import {
  commandAnswerSchema,
  commandRequestSchema,
  frameRequestSchema,
  handMoveRequestSchema,
  jogRequestSchema,
  plotterSchema,
  servoRequestSchema,
  squareRequestSchema,
  walkRequestSchema,
  type BoxMm,
  type PlotSettings,
} from "../../src/schema/index.js";
import type { HandMove } from "../../host/plotter/hand-moves.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";
import { route, type ApiRoute } from "./api-route.js";
import { parseWith } from "./errors.js";
import { findFreePlotter } from "./find-plotter.js";

export interface HandMoveParts {
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly queue: JobQueue;
  /** The box of a job's drawing as its settings place it on the machine. */
  readonly jobBoxMm: (jobId: string) => Promise<BoxMm>;
  /** Adds the profile when the settings name a custom machine. */
  readonly withMachine: (settings: PlotSettings) => PlotSettings;
}

interface Wanted {
  readonly move: HandMove;
  readonly settings: PlotSettings | undefined;
}

const move = (name: string, about: string, body: ZodType): ApiRoute =>
  route("post", `/plotters/:id/${name}`, about, plotterSchema, { body });

export const HAND_MOVE_ROUTES: readonly ApiRoute[] = [
  move(
    "home",
    "Lifts the pen and moves home, to the limit switches if the machine has them",
    handMoveRequestSchema,
  ),
  move("walk", "Moves to a position in mm from home, pen up", walkRequestSchema),
  move("jog", "Moves by a distance in mm, pen up", jogRequestSchema),
  move("set-home", "Makes the current position home", handMoveRequestSchema),
  move("cycle-pen", "Lowers the pen and lifts it again", handMoveRequestSchema),
  move("frame", "Moves around a job's drawing or a box and back, pen up", frameRequestSchema),
  move("test-line", "Draws a line of 20 mm near the current position", handMoveRequestSchema),
  move("test-patch", "Draws a small test pattern at the current position", handMoveRequestSchema),
  move("square", "Draws a square for measuring", squareRequestSchema),
  move("servo", "Sets a raw servo position", servoRequestSchema),
  route("post", "/plotters/:id/command", "Sends one line to the board", commandAnswerSchema, {
    body: commandRequestSchema,
  }),
];

export function handMoveRoutes(parts: HandMoveParts): Router {
  const router = Router();
  router.use(express.json({ limit: "1mb" }));

  const findFree = (id: string): PlotterPort => findFreePlotter(parts.plotters, parts.queue, id);

  for (const [name, wantedOf] of Object.entries(MOVES)) {
    router.post(`/:id/${name}`, async (request, response) => {
      const { move, settings } = await wantedOf(request, parts);
      const plotter = findFree(request.params["id"]);
      await plotter.move(move, settings === undefined ? undefined : parts.withMachine(settings));
      response.json(plotter.snapshot());
    });
  }

  router.post("/:id/command", async (request, response) => {
    const { line } = parseWith(commandRequestSchema, request.body);
    response.json(await findFree(request.params.id).command(line));
  });

  return router;
}

type WantedOf = (request: Request, parts: HandMoveParts) => Wanted | Promise<Wanted>;

const plain =
  (kind: "home" | "set-home" | "cycle-pen" | "test-line" | "test-patch"): WantedOf =>
  (request) => ({ move: { kind }, settings: bodyOf(request, handMoveRequestSchema).settings });

const MOVES: Readonly<Record<string, WantedOf>> = {
  walk: (request) => {
    const { xMm, yMm, settings } = bodyOf(request, walkRequestSchema);
    return { move: { kind: "walk", xMm, yMm }, settings };
  },
  jog: (request) => {
    const { dxMm, dyMm, settings } = bodyOf(request, jogRequestSchema);
    return { move: { kind: "jog", dxMm, dyMm }, settings };
  },
  home: plain("home"),
  "set-home": plain("set-home"),
  "cycle-pen": plain("cycle-pen"),
  "test-line": plain("test-line"),
  "test-patch": plain("test-patch"),
  frame: async (request, parts) => {
    const body = bodyOf(request, frameRequestSchema);
    if ("boxMm" in body) return { move: { kind: "frame", boxMm: body.boxMm }, settings: body.settings };
    const boxMm = await parts.jobBoxMm(body.jobId);
    return {
      move: { kind: "frame", boxMm },
      settings: body.settings ?? parts.queue.get(body.jobId).settings,
    };
  },
  square: (request) => {
    const { sizeMm, settings } = bodyOf(request, squareRequestSchema);
    return { move: { kind: "square", sizeMm }, settings };
  },
  servo: (request) => {
    const { pos, settings } = bodyOf(request, servoRequestSchema);
    return { move: { kind: "servo", pos }, settings };
  },
};

/** The body may be missing for moves without required fields. */
const bodyOf = <T>(request: Request, schema: ZodType<T>): T => parseWith(schema, request.body ?? {});
