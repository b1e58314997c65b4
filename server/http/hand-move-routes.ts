/** /api/v1/plotters/:id/…: manual moves and the board's console, while no job is plotting. */
import express, { Router } from "express";
import type { ZodType } from "zod";
import {
  commandAnswerSchema,
  commandRequestSchema,
  frameRequestSchema,
  handMoveRequestSchema,
  handMoveSchema,
  jogRequestSchema,
  plotterSchema,
  servoRequestSchema,
  squareRequestSchema,
  walkRequestSchema,
  type BoxMm,
  type HandMove,
  type HandMoveRequest,
} from "../../src/schema/index.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";
import { route, type ApiRoute } from "./api-route.js";
import { parseWith } from "../../host/parse-with.js";
import { findFreePlotter } from "../../host/queue/find-plotter.js";

export interface HandMoveParts {
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly queue: JobQueue;
  /** The box of a job's drawing as its settings place it on the machine. */
  readonly jobBoxMm: (jobId: string) => Promise<BoxMm>;
}

/** Each manual move by its kind: what it does, and the body of its route. */
const MOVES = {
  home: [
    "Lifts the pen and moves home, to the limit switches if the machine has them",
    handMoveRequestSchema,
  ],
  walk: ["Moves to a position in mm from home, pen up", walkRequestSchema],
  jog: ["Moves by a distance in mm, pen up", jogRequestSchema],
  "set-home": ["Makes the current position home", handMoveRequestSchema],
  "cycle-pen": ["Lowers the pen and lifts it again", handMoveRequestSchema],
  frame: ["Moves around a job's drawing or a box and back, pen up", frameRequestSchema],
  "test-line": ["Draws a line of 20 mm near the current position", handMoveRequestSchema],
  "test-patch": ["Draws a small test pattern at the current position", handMoveRequestSchema],
  square: ["Draws a square for measuring", squareRequestSchema],
  servo: ["Sets a raw servo position", servoRequestSchema],
} as const satisfies Record<HandMove["kind"], readonly [about: string, body: ZodType]>;

export const HAND_MOVE_ROUTES: readonly ApiRoute[] = [
  ...Object.entries(MOVES).map(([kind, [about, body]]) =>
    route("post", `/plotters/:id/${kind}`, about, plotterSchema, { body }),
  ),
  route("post", "/plotters/:id/command", "Sends one line to the board", commandAnswerSchema, {
    body: commandRequestSchema,
  }),
];

export function handMoveRoutes(parts: HandMoveParts): Router {
  const router = Router();
  router.use(express.json({ limit: "1mb" }));

  const findFree = (id: string): PlotterPort => findFreePlotter(parts.plotters, parts.queue, id);

  for (const kind of Object.keys(MOVES)) {
    router.post(`/:id/${kind}`, async (request, response) => {
      // The body may be missing for moves without required fields.
      const body: unknown = request.body ?? {};
      const { move, how } = await (kind === "frame" ? frameIn(body, parts) : moveIn(kind, body));
      const plotter = findFree(request.params["id"]);
      await plotter.move(move, parts.queue.handSettings(plotter.id, how));
      response.json(plotter.snapshot());
    });
  }

  router.post("/:id/command", async (request, response) => {
    const { line } = parseWith(commandRequestSchema, request.body);
    response.json(await findFree(request.params.id).command(line));
  });

  return router;
}

interface Wanted {
  readonly move: HandMove;
  readonly how: HandMoveRequest;
}

function moveIn(kind: string, body: unknown): Wanted {
  const { settings, profile, ...fields } = parseWith(handMoveRequestSchema.loose(), body);
  return { move: parseWith(handMoveSchema, { ...fields, kind }), how: { settings, profile } };
}

async function frameIn(body: unknown, { jobBoxMm, queue }: HandMoveParts): Promise<Wanted> {
  const frame = parseWith(frameRequestSchema, body);
  const { settings, profile } = frame;
  if ("boxMm" in frame) return { move: { kind: "frame", boxMm: frame.boxMm }, how: { settings, profile } };
  const boxMm = await jobBoxMm(frame.jobId);
  const how = { settings: settings ?? queue.get(frame.jobId).settings, profile };
  return { move: { kind: "frame", boxMm }, how };
}
