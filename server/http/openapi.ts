/** The interface as an OpenAPI 3.1 document, made from the schemas that check it. A test holds it to the routes. */
import { z, type ZodType } from "zod";
import {
  accessEntrySchema,
  apiErrorSchema,
  commandAnswerSchema,
  commandRequestSchema,
  frameRequestSchema,
  handMoveRequestSchema,
  jobChangeSchema,
  jobPatchSchema,
  jobSchema,
  jogRequestSchema,
  machineListSchema,
  machineProfileSchema,
  meSchema,
  moveJobSchema,
  movePlaceSchema,
  newJobSchema,
  newKeySchema,
  penRequestSchema,
  plotterSchema,
  queueSettingsSchema,
  serverEventSchema,
  servoRequestSchema,
  snapshotSchema,
  squareRequestSchema,
  walkRequestSchema,
} from "../../src/schema/index.js";
import { STUDIO_ROUTES } from "./studio-api.js";

export interface ApiRoute {
  readonly method: "get" | "post" | "put" | "patch" | "delete";
  /** Below /api/v1, with express's :names. */
  readonly path: string;
  readonly about: string;
  readonly body?: ZodType;
  readonly answer: ZodType | "text" | "events";
  readonly status?: number;
}

const okSchema = z.object({ ok: z.literal(true) });
const route = (
  method: ApiRoute["method"],
  path: string,
  about: string,
  answer: ApiRoute["answer"],
  more: Pick<ApiRoute, "body" | "status"> = {},
): ApiRoute => ({ method, path, about, answer, ...more });
const handMove = (name: string, about: string, body: ZodType): ApiRoute =>
  route("post", `/plotters/:id/${name}`, about, plotterSchema, { body });
const jobAction = (name: string, about: string, body?: ZodType): ApiRoute =>
  route("post", `/jobs/:id/${name}`, about, jobSchema, body === undefined ? {} : { body });

export const API_ROUTES: readonly ApiRoute[] = [
  route("get", "/state", "Everything at once", snapshotSchema),
  route("get", "/events", "What changes, a snapshot first", "events"),
  route("get", "/me", "What the caller may do", meSchema),
  route("get", "/openapi.json", "This document", z.looseObject({})),
  route("get", "/queue", "How the queue runs", queueSettingsSchema),
  route("patch", "/queue", "Changes how the queue runs", queueSettingsSchema, { body: queueSettingsSchema }),
  route("post", "/jobs", "Adds a job: JSON, or the file as the body with ?name=", jobSchema, {
    body: newJobSchema,
    status: 201,
  }),
  route("get", "/jobs/:id", "One job", jobSchema),
  route("get", "/jobs/:id/drawing", "The uploaded file", "text"),
  route("patch", "/jobs/:id", "Changes a job", jobSchema, { body: jobPatchSchema }),
  route("post", "/jobs/:id/move", "Changes its place in the queue", okSchema, { body: moveJobSchema }),
  jobAction("start", "Begins to plot"),
  jobAction("pause", "Comes to rest and lifts the pen"),
  jobAction("resume", "Goes on"),
  jobAction("cancel", "Lifts the pen and goes home"),
  jobAction("requeue", "Queues an ended job again"),
  jobAction("recover", "Takes an interrupted job up, held"),
  jobAction("emergency-stop", "Stops at once"),
  jobAction("change", "Heights and speeds on the way", jobChangeSchema),
  jobAction("place", "Moves the place of a held job", movePlaceSchema),
  jobAction("check-place", "Walks to the place with the pen up"),
  route("post", "/jobs/:id/duplicate", "Queues a copy", jobSchema, { status: 201 }),
  route("delete", "/jobs/:id", "Removes a job", okSchema),
  route("get", "/plotters/:id", "One plotter", plotterSchema),
  route("get", "/plotters/:id/log", "Commands and replies", "text"),
  route("post", "/plotters/:id/pen", "Lifts or drops the pen", plotterSchema, { body: penRequestSchema }),
  route("post", "/plotters/:id/motors-off", "Lets the carriage be moved by hand", plotterSchema),
  handMove(
    "home",
    "Lifts the pen and walks home, to the switches where there are some",
    handMoveRequestSchema,
  ),
  handMove("walk", "Pen up, to a place in mm from home", walkRequestSchema),
  handMove("jog", "Pen up, by so many mm", jogRequestSchema),
  handMove("set-home", "Where the carriage stands is home", handMoveRequestSchema),
  handMove("cycle-pen", "Pen down and up again", handMoveRequestSchema),
  handMove("frame", "Around a job's drawing or a box with the pen up, and back", frameRequestSchema),
  handMove("test-patch", "Draws a small pattern where the carriage stands", handMoveRequestSchema),
  handMove("square", "Draws a square to be measured", squareRequestSchema),
  handMove("servo", "A raw servo position", servoRequestSchema),
  route("post", "/plotters/:id/command", "One line to the board", commandAnswerSchema, {
    body: commandRequestSchema,
  }),
  route("get", "/machines", "Plotters as data", machineListSchema),
  route("put", "/machines/:id", "Keeps a machine of your own", machineProfileSchema, {
    body: machineProfileSchema,
  }),
  route("delete", "/machines/:id", "Removes one", okSchema),
  route("get", "/access", "Sessions and keys", z.object({ entries: z.array(accessEntrySchema) })),
  route("post", "/access/keys", "Makes a key", z.object({ entry: accessEntrySchema, secret: z.string() }), {
    body: newKeySchema,
    status: 201,
  }),
  route("delete", "/access/:id", "Revokes a session or key", okSchema),
  route(
    "get",
    "/samples",
    "Drawings that come with plotwright",
    z.object({ samples: z.array(z.object({ name: z.string(), title: z.string() })) }),
  ),
  route("get", "/samples/:name", "One of them", "text"),
  ...STUDIO_ROUTES,
];

/**
 * As JSON. Made once, route by route: all at once it would take so long that a plot under way, which the same
 * thread streams to the board, would run dry.
 */
export function openApiText(version: string): Promise<string> {
  text ??= makeText(version);
  return text;
}

let text: Promise<string> | null = null;

async function makeText(version: string): Promise<string> {
  const paths: Record<string, Record<string, object>> = {};
  for (const one of API_ROUTES) {
    const path = `/api/v1${one.path.replace(/:(\w+)/g, "{$1}")}`;
    paths[path] = { ...paths[path], [one.method]: operation(one) };
    await new Promise((resolve) => setImmediate(resolve));
  }
  return JSON.stringify({ openapi: "3.1.0", info: { title: "plotwright", version }, paths });
}

function operation({ path, about, body, answer, status = 200 }: ApiRoute): object {
  const names = [...path.matchAll(/:(\w+)/g)].map((match) => match[1]);
  return {
    summary: about,
    ...(names.length === 0
      ? {}
      : {
          parameters: names.map((name) => ({ name, in: "path", required: true, schema: { type: "string" } })),
        }),
    ...(body === undefined
      ? {}
      : {
          requestBody: {
            required: true,
            content: { "application/json": { schema: jsonSchema(body, "input") } },
          },
        }),
    responses: {
      [status]: { description: about, content: contentOf(answer) },
      default: {
        description: "What went wrong",
        content: { "application/json": { schema: jsonSchema(apiErrorSchema, "output") } },
      },
    },
  };
}

function contentOf(answer: ApiRoute["answer"]): object {
  if (answer === "text") return { "text/plain": { schema: { type: "string" } } };
  if (answer === "events")
    return { "text/event-stream": { schema: jsonSchema(serverEventSchema, "output") } };
  return { "application/json": { schema: jsonSchema(answer, "output") } };
}

const jsonSchema = (schema: ZodType, io: "input" | "output"): object =>
  z.toJSONSchema(schema, { io, unrepresentable: "any" });
