/** The routes of the API, made from the table of operations and their handlers. */
import express, { Router, type Request, type RequestHandler, type Response } from "express";
import { PlotwrightError } from "../../src/index.js";
import {
  API_PATH,
  JOB_PATH,
  OPERATIONS,
  PICTURE_TYPES,
  type Operation,
  type OperationGroup,
  type OperationHandlers,
  type OperationTable,
  type Submitter,
  pictureKindOf,
} from "../../src/schema/index.js";
import { performOperation } from "../../host/operations/host-operations.js";
import type { Requester } from "../../host/planning/lane.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import { callerIn } from "./auth.js";
import { deviceName } from "./browser.js";

/** The handlers of operations that a server offers. */
export type ServerHandlers = OperationHandlers<Requester>;

/**
 * Operations that need more of HTTP than their body, or that stream. A responder sends the answer itself, or calls `next`
 * to leave it to the operation's handler.
 */
export type Responders = {
  readonly [Group in OperationGroup]?: Partial<
    Record<keyof (typeof OPERATIONS)[Group], RequestHandler<Record<string, string>>>
  >;
};

interface RouteParts {
  readonly handlers: ServerHandlers;
  readonly responders: Responders;
  /** No JSON is larger than a drawing may be. */
  readonly maxBytes: number;
  /** Throws `not-allowed` for requests of other computers. */
  readonly requireLocal: RequestHandler<Record<string, string>>;
  /** Throws `not-found` for a submitter's requests about jobs of others. */
  readonly requireOwnJob: RequestHandler<Record<string, string>>;
}

type HandlerOf = Readonly<Record<string, (...args: never[]) => unknown>>;
type ResponderOf = Readonly<Record<string, RequestHandler<Record<string, string>>>>;

/** The groups of which this server has handlers. Those of plug-ins that are not loaded are missing. */
export const offeredOperations = ({ handlers, responders }: Pick<RouteParts, "handlers" | "responders">) =>
  Object.fromEntries(
    Object.entries(OPERATIONS).filter(([group]) => group in handlers || group in responders),
  ) as Partial<OperationTable>;

export function operationRoutes(parts: RouteParts): Router {
  const router = Router();
  for (const [group, operations] of Object.entries(offeredOperations(parts))) {
    const handlers = (parts.handlers as Readonly<Record<string, HandlerOf>>)[group] ?? {};
    const responders = (parts.responders as Readonly<Record<string, ResponderOf>>)[group] ?? {};
    for (const [name, one] of Object.entries(operations ?? {})) {
      const steps = stepsOf(one, handlers[name], responders[name], parts);
      if (steps.length === 0) throw new Error(`Nothing performs the operation ${name} of ${group}.`);
      router[one.method](one.path, ...steps);
    }
  }
  return router;
}

function stepsOf(
  one: Operation,
  handler: HandlerOf[string] | undefined,
  responder: ResponderOf[string] | undefined,
  { maxBytes, requireLocal, requireOwnJob }: RouteParts,
): RequestHandler<Record<string, string>>[] {
  const performers = [
    ...(responder === undefined ? [] : [responder]),
    ...(handler === undefined ? [] : [performer(one, handler)]),
  ];
  if (performers.length === 0) return [];
  const hasJson = one.body !== undefined && one.body !== "file";
  return [
    ...(one.role === "local" ? [requireLocal] : []),
    ...(one.path.startsWith(JOB_PATH) ? [requireOwnJob] : []),
    ...(hasJson ? [express.json({ limit: Math.min(one.maxBodyBytes, maxBytes) })] : []),
    ...performers,
  ];
}

const performer =
  (one: Operation, handler: HandlerOf[string]): RequestHandler<Record<string, string>> =>
  async (request, response) => {
    const id = Object.values(request.params)[0];
    const sent: unknown = one.query === undefined ? request.body : request.query;
    const answer = await performOperation(one, handler, { id, sent }, requesterOf(request, response));
    if (one.attachment !== undefined) response.attachment(one.attachment.replace(":id", id ?? ""));
    if (one.answer === "picture") sendPicture(response, answer as ArrayBuffer);
    else if (one.answer === "text") response.type("text/plain; charset=utf-8").send(answer);
    else sendJson(response, one, answer);
  };

/** A picture that is kept never changes. */
function sendPicture(response: Response, picture: ArrayBuffer): void {
  const bytes = Buffer.from(picture);
  const kind = pictureKindOf(bytes);
  response.type(kind === null ? "application/octet-stream" : PICTURE_TYPES[kind]);
  response.set("Cache-Control", "private, max-age=86400, immutable").send(bytes);
}

/** The answer to a new item says where it is, if there is an operation that returns it. */
function sendJson(response: Response, { path, status }: Operation, answer: unknown): void {
  const { id } = (answer ?? {}) as { readonly id?: string };
  const isNewItem = status === 201 && id !== undefined && ITEM_PATHS.has(`${path}/:id`);
  if (isNewItem) response.location(`${API_PATH}${path}/${id}`);
  response.status(status).json(answer);
}

const ITEM_PATHS: ReadonlySet<string> = new Set(
  Object.values<Readonly<Record<string, Operation>>>(OPERATIONS)
    .flatMap((group) => Object.values(group))
    .filter(({ method }) => method === "get")
    .map(({ path }) => path),
);

/** The operations on a job, which has its id in their path. */
export const requireOwnJob =
  (queue: Pick<JobQueue, "get">): RequestHandler<Record<string, string>> =>
  (request, response, next) => {
    const submitter = submitterOf(request, response);
    if (submitter !== undefined) queue.get(request.params["id"], submitter.id);
    next();
  };

/** Undefined: the caller may see all jobs. */
export function submitterOf(
  request: Request<Record<string, string>>,
  response: Response,
): Submitter | undefined {
  const { id, role, keyName } = callerIn(response);
  return role === "submit" ? { id, name: keyName ?? deviceName(request) } : undefined;
}

/** Identifies the client; planning is aborted when it disconnects before the answer. */
export function requesterOf(request: Request<Record<string, string>>, response: Response): Requester {
  const disconnected = new AbortController();
  response.on("close", () => {
    if (!response.writableFinished) disconnected.abort();
  });
  const submitter = submitterOf(request, response);
  return { client: request.socket.remoteAddress, signal: disconnected.signal, submitter };
}

/** Leaves the connection open when reading stops early, so that an error can still be sent. */
export const bytesOf = (request: Request<Record<string, string>>): AsyncIterable<Uint8Array> =>
  request.iterator({ destroyOnReturn: false }) as AsyncIterable<Uint8Array>;

/** Messages for the operations of plug-ins that are not loaded, by the beginning of their paths. */
const WITHOUT_PLUGIN: Readonly<Record<string, readonly [group: OperationGroup, message: string]>> = {
  "/shared-jobs": [
    "sharedJobs",
    "This server has no shared queue. Start it with serve --shared-queue to use one.",
  ],
  "/webhooks": ["webhooks", "Webhooks are switched off on this server."],
};

export function missingPlugins(handlers: ServerHandlers): Router {
  const router = Router();
  for (const [path, [group, message]] of Object.entries(WITHOUT_PLUGIN)) {
    if (group in handlers) continue;
    router.use(path, () => {
      throw new PlotwrightError("not-found", message);
    });
  }
  return router;
}
