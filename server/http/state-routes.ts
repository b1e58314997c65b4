/** /api/v1: the server's whole state, its event stream, the caller, the queue's settings, the API itself. */
import express, { Router } from "express";
import { z } from "zod";
import {
  historyRequestSchema,
  jobPageSchema,
  meSchema,
  queueSettingsSchema,
  snapshotSchema,
  type Snapshot,
} from "../../src/schema/index.js";
import type { PlotterRegistry } from "../../host/plotter/plotter-registry.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { Notices } from "../../host/queue/notices.js";
import type { Access } from "../security/access.js";
import type { OperatorLock } from "../security/operator-lock.js";
import type { MachineFiles } from "../storage/machine-files.js";
import { route, type ApiRoute } from "./api-route.js";
import { callerOf } from "./auth.js";
import type { Browsers } from "./browser.js";
import { parseWith } from "../../host/parse-with.js";
import { inSlices, type EventHub } from "./events.js";

export interface StateParts {
  readonly version: string;
  readonly queue: JobQueue;
  readonly registry: PlotterRegistry;
  readonly hub: EventHub;
  readonly operatorLock: OperatorLock;
  readonly notices: Notices;
  readonly access: Access;
  /** The server's mDNS name; null while it has none. */
  readonly localName: () => string | null;
  readonly machines: MachineFiles;
}

export const STATE_ROUTES: readonly ApiRoute[] = [
  route(
    "get",
    "/state",
    "Returns the state of the server: everything but older jobs of the history",
    snapshotSchema,
  ),
  route(
    "get",
    "/history",
    "Returns up to 50 ended jobs: those after the job ?after=ID of the history, or the newest ones, of all plotters or of ?plotterId=ID",
    jobPageSchema,
  ),
  route("get", "/events", "Streams a snapshot, then every change", "events"),
  route("get", "/me", "Returns the role and identity of the caller", meSchema),
  route("get", "/openapi.json", "Returns the OpenAPI description of this interface", z.looseObject({})),
  route("get", "/queue", "Returns the queue settings of the first plotter", queueSettingsSchema),
  route("patch", "/queue", "Changes the queue settings of the first plotter", queueSettingsSchema, {
    body: queueSettingsSchema,
  }),
];

/** `openApi`: the text of the OpenAPI document. */
export function stateRoutes(parts: StateParts, browsers: Browsers, openApi: () => Promise<string>): Router {
  const { queue, registry, operatorLock, hub } = parts;
  const router = Router();
  const snapshot = (): Snapshot => ({
    version: parts.version,
    plotters: registry.list(),
    plotterSettings: registry.settings(),
    queue: queue.settings(),
    queues: queue.allSettings(),
    operator: operatorLock.operator,
    serverNotices: parts.notices.list(),
    localName: parts.localName(),
    machines: parts.machines.list(),
    ...queue.recent(),
  });
  router.get("/openapi.json", async (_request, response) => {
    response.type("json").send(await openApi());
  });
  router.get("/state", (_request, response) => {
    const text = hub.snapshotText(snapshot);
    const slices = inSlices(text);
    response.on("close", () => slices.destroy());
    slices.pipe(response.type("json").set("Content-Length", String(text.length)));
  });
  router.get("/history", (request, response) => {
    response.json(queue.older(parseWith(historyRequestSchema, request.query)));
  });
  router.get("/events", (request, response) => {
    const browser = browsers.of(request);
    if (browser !== null) request.on("close", operatorLock.streamOpened(browser.id));
    hub.open(request, response, callerOf(request, parts.access)?.id ?? "", snapshot);
  });
  router.get("/me", (request, response) => {
    const { id = null, name = null } = browsers.of(request) ?? {};
    response.json({ role: callerOf(request, parts.access)?.role, id, name });
  });
  router.get("/queue", (_request, response) => {
    response.json(queue.settings());
  });
  router.patch("/queue", express.json({ limit: "10kb" }), (request, response) => {
    response.json(queue.saveSettings(parseWith(queueSettingsSchema, request.body)));
  });
  return router;
}
