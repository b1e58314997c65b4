/** The API as an OpenAPI 3.1 document, generated from the zod schemas. A test compares it with the routes. */
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
import type { ApiRoute } from "./api-route.js";
import { STUDIO_ROUTES } from "./studio-api.js";

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
  route("get", "/state", "Returns the whole state of the server", snapshotSchema),
  route("get", "/events", "Streams a snapshot, then every change", "events"),
  route("get", "/me", "Returns the role and identity of the caller", meSchema),
  route("get", "/openapi.json", "Returns this document", z.looseObject({})),
  route("get", "/queue", "Returns the queue settings of the first plotter", queueSettingsSchema),
  route("patch", "/queue", "Changes the queue settings of the first plotter", queueSettingsSchema, {
    body: queueSettingsSchema,
  }),
  route("post", "/jobs", "Adds a job from JSON, or from the file itself as the body with ?name=", jobSchema, {
    body: newJobSchema,
    status: 201,
  }),
  route("get", "/jobs/:id", "Returns a job", jobSchema),
  route("get", "/jobs/:id/drawing", "Returns the uploaded file", "text"),
  route("patch", "/jobs/:id", "Changes name, settings or plotter of a job", jobSchema, {
    body: jobPatchSchema,
  }),
  route("post", "/jobs/:id/move", "Moves a job in the queue", okSchema, { body: moveJobSchema }),
  jobAction("start", "Starts plotting"),
  jobAction("pause", "Slows down to a stop and lifts the pen"),
  jobAction("resume", "Resumes a paused job"),
  jobAction("cancel", "Cancels a job: the pen lifts and goes home"),
  jobAction("requeue", "Queues an ended job again"),
  jobAction("recover", "Continues an interrupted or cancelled job, paused at first"),
  jobAction("emergency-stop", "Stops at once, without slowing down"),
  jobAction("change", "Changes pen heights and speeds while plotting", jobChangeSchema),
  jobAction("place", "Moves the place from which a paused job resumes", movePlaceSchema),
  jobAction("check-place", "Moves to the place where a paused job resumes, with the pen up"),
  route("post", "/jobs/:id/duplicate", "Queues a copy of a job", jobSchema, { status: 201 }),
  route("delete", "/jobs/:id", "Removes a job", okSchema),
  route("get", "/plotters/:id", "Returns a plotter", plotterSchema),
  route("get", "/plotters/:id/log", "Returns the commands and replies of the connection", "text"),
  route("post", "/plotters/:id/pen", "Raises or lowers the pen", plotterSchema, { body: penRequestSchema }),
  route(
    "post",
    "/plotters/:id/motors-off",
    "Switches the motors off, so that the carriage can be pushed by hand",
    plotterSchema,
  ),
  handMove(
    "home",
    "Raises the pen and moves home, to the limit switches if the machine has them",
    handMoveRequestSchema,
  ),
  handMove("walk", "Moves to a position in mm from home, pen up", walkRequestSchema),
  handMove("jog", "Moves by a distance in mm, pen up", jogRequestSchema),
  handMove("set-home", "Makes the current position home", handMoveRequestSchema),
  handMove("cycle-pen", "Lowers the pen and raises it again", handMoveRequestSchema),
  handMove("frame", "Moves around a job's drawing or a box and back, pen up", frameRequestSchema),
  handMove("test-patch", "Draws a small test pattern at the current position", handMoveRequestSchema),
  handMove("square", "Draws a square for measuring", squareRequestSchema),
  handMove("servo", "Sets a raw servo position", servoRequestSchema),
  route("post", "/plotters/:id/command", "Sends one line to the board", commandAnswerSchema, {
    body: commandRequestSchema,
  }),
  route("get", "/machines", "Lists the machine profiles", machineListSchema),
  route("put", "/machines/:id", "Stores a custom machine profile", machineProfileSchema, {
    body: machineProfileSchema,
  }),
  route("delete", "/machines/:id", "Removes a custom machine profile", okSchema),
  route("get", "/access", "Lists sessions and keys", z.object({ entries: z.array(accessEntrySchema) })),
  route("post", "/access/keys", "Creates a key", z.object({ entry: accessEntrySchema, secret: z.string() }), {
    body: newKeySchema,
    status: 201,
  }),
  route("delete", "/access/:id", "Revokes a session or key", okSchema),
  route(
    "get",
    "/samples",
    "Lists the sample drawings",
    z.object({ samples: z.array(z.object({ name: z.string(), title: z.string() })) }),
  ),
  route("get", "/samples/:name", "Returns a sample drawing", "text"),
  ...STUDIO_ROUTES,
];

/**
 * The document as JSON. It is generated once, route by route: this thread also streams to the board, and
 * generating everything in one go would take so long that a running plot would underrun.
 */
export function openApiText(version: string): Promise<string> {
  text ??= makeText(version);
  return text;
}

let text: Promise<string> | null = null;

async function makeText(version: string): Promise<string> {
  const paths: Record<string, Record<string, object>> = {};
  for (const apiRoute of API_ROUTES) {
    const path = `/api/v1${apiRoute.path.replace(/:(\w+)/g, "{$1}")}`;
    paths[path] = { ...paths[path], [apiRoute.method]: operation(apiRoute) };
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
        description: "The error",
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
