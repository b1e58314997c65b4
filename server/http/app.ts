/** Assembles the express app: guards first, then the API, then the page. */
import express, { Router, type Express } from "express";
import helmet from "helmet";
import { queueSettingsSchema, type Pairing, type Snapshot } from "../../src/schema/index.js";
import type { MachineFiles } from "../machines/machine-files.js";
import { drawingBoxMm } from "../planning/drawing-box.js";
import { lane } from "../planning/lane.js";
import type { DrawingFiles } from "../queue/drawing-files.js";
import type { JobQueue } from "../queue/job-queue.js";
import type { Access } from "../security/access.js";
import type { OperatorLock } from "../security/operator-lock.js";
import type { Notices } from "../queue/notices.js";
import type { PlotterRegistry } from "../plotter-registry.js";
import type { SharedQueue } from "../shared/shared-queue.js";
import type { Webhooks } from "../webhooks/webhooks.js";
import { Browsers, requireOperator } from "./browser.js";
import { errorResponder, notFound, parseWith } from "./errors.js";
import { accessRoutes, limitRequests, pairRoutes, requireRole, roleOf } from "./auth.js";
import type { EventHub } from "./events.js";
import { guardHosts, guardPaths } from "./guard.js";
import { handMovesRoutes, type HandMoveParts } from "./hand-moves-routes.js";
import { jobsRoutes } from "./jobs-routes.js";
import { machinesRoutes } from "./machines-routes.js";
import { openApiText } from "./openapi.js";
import { plottersRoutes } from "./plotters-routes.js";
import { sharedRoutes } from "./shared-routes.js";
import { samplesRoutes } from "./samples.js";
import { studioRoutes } from "./studio-routes.js";

export interface AppParts {
  readonly version: string;
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
  readonly registry: PlotterRegistry;
  readonly hub: EventHub;
  readonly operatorLock: OperatorLock;
  readonly webhooks: Webhooks;
  readonly notices: Notices;
  /** The queue shared with other servers; null without one. */
  readonly shared: SharedQueue | null;
  /** Links that pair a device. */
  readonly pairing: () => Promise<Pairing>;
  /** The server's log so far. */
  readonly serverLog: () => string;
  /** Built-in and custom machine profiles. */
  readonly machines: MachineFiles;
  readonly allowedHosts: readonly string[];
  /** The server's mDNS name, which it accepts as Host; null while it has none. */
  readonly localName: () => string | null;
  /** Folders with the built page and with the samples. */
  readonly webDir: string;
  readonly samplesDir: string;
  /** Sessions and keys; normally required only of clients on other computers. */
  readonly access: Access;
  readonly log: (line: string) => void;
}

export function createApp(parts: AppParts): Express {
  const { access, queue, log } = parts;
  const browsers = new Browsers(access, parts.operatorLock.operator);
  const isRunning = (jobId: string): boolean => queue.isRunning(jobId);
  const app = express();
  app.disable("x-powered-by");
  app.use(securityHeaders());
  app.use(guardHosts(parts.allowedHosts, parts.localName, log));
  app.use(guardPaths(log));
  app.use(limitRequests(access));
  app.use(pairRoutes(access, log));
  app.use(browsers.routes());
  app.use("/api", requireRole(access, isRunning, log));
  app.use("/api", requireOperator(browsers, parts.operatorLock, isRunning));
  app.use("/api/v1", apiRoutes(parts, browsers));
  app.use("/api", notFound);
  app.use(pageRoutes(parts.webDir));
  app.use(notFound);
  app.use(errorResponder(parts.log));
  return app;
}

/** The routers of the API, each with its path below /api/v1. */
export function apiMounts(
  parts: AppParts,
  browsers = new Browsers(parts.access),
): readonly (readonly [string, Router])[] {
  const { queue, registry } = parts;
  const plotters = registry.ports;
  return [
    ["", stateRoutes(parts, browsers)],
    ["", studioRoutes({ ...parts, plotters, browsers })],
    ["", plottersRoutes(registry, queue, parts.log)],
    ["/access", accessRoutes(parts.access)],
    ["/jobs", jobsRoutes(queue, parts.files, parts.machines)],
    ["/machines", machinesRoutes(parts.machines)],
    ["/plotters", handMovesRoutes(handMoveParts(parts))],
    ["/shared-jobs", sharedRoutes(parts.shared)],
    ["/samples", samplesRoutes(parts.samplesDir)],
  ];
}

function handMoveParts({ registry, queue, machines }: AppParts): HandMoveParts {
  const turn = lane(2);
  return {
    plotters: registry.ports,
    queue,
    jobBoxMm: (id) => turn({ client: id }, () => drawingBoxMm(queue.drawingPath(id), queue.get(id).settings)),
    withMachine: (settings) => machines.withMachine(settings),
  };
}

function apiRoutes(parts: AppParts, browsers: Browsers): Router {
  const router = Router();
  router.use((_request, response, next) => {
    response.set("Cache-Control", "no-store");
    next();
  });
  for (const [path, routes] of apiMounts(parts, browsers)) router.use(path === "" ? "/" : path, routes);
  return router;
}

function stateRoutes(parts: AppParts, browsers: Browsers): Router {
  const { queue, registry, operatorLock } = parts;
  const router = Router();
  const snapshot = (): Snapshot => ({
    version: parts.version,
    plotters: registry.list(),
    queue: queue.settings(),
    queues: queue.allSettings(),
    operator: operatorLock.operator,
    serverNotices: parts.notices.list(),
    localName: parts.localName(),
    jobs: queue.list(),
  });
  router.get("/openapi.json", async (_request, response) => {
    response.type("json").send(await openApiText(parts.version));
  });
  router.get("/state", (_request, response) => {
    response.json(snapshot());
  });
  router.get("/events", (request, response) => {
    const browser = browsers.of(request);
    if (browser !== null) request.on("close", operatorLock.streamOpened(browser.id));
    parts.hub.open(request, response, snapshot);
  });
  router.get("/me", (request, response) => {
    const { id = null, name = null } = browsers.of(request) ?? {};
    response.json({ role: roleOf(request, parts.access), id, name });
  });
  router.get("/queue", (_request, response) => {
    response.json(queue.settings());
  });
  router.patch("/queue", express.json({ limit: "10kb" }), (request, response) => {
    response.json(queue.saveSettings(parseWith(queueSettingsSchema, request.body)));
  });
  return router;
}

/** Built files have a hash in their name and never change; the page itself is revalidated on each load. */
function pageRoutes(webDir: string): Router {
  const router = Router();
  router.use(
    "/assets",
    express.static(`${webDir}/assets`, { immutable: true, maxAge: "1y", index: false, redirect: false }),
  );
  router.use(
    express.static(webDir, {
      redirect: false,
      setHeaders: (response) => void response.setHeader("Cache-Control", "no-cache"),
    }),
  );
  return router;
}

/**
 * Scripts, workers and connections only from this server; no site may frame the page. No upgrade to https and
 * no HSTS: the server uses plain http on loopback, and either would lock its own users out.
 */
function securityHeaders(): express.RequestHandler {
  return helmet({
    contentSecurityPolicy: {
      useDefaults: false,
      directives: {
        defaultSrc: ["'self'"],
        scriptSrc: ["'self'"],
        scriptSrcAttr: ["'none'"],
        styleSrc: ["'self'"],
        // For style attributes in markup. React's style={…} sets properties and would not need this.
        styleSrcAttr: ["'unsafe-inline'"],
        // A camera image may come from any address; images can't run code.
        imgSrc: ["'self'", "data:", "blob:", "http:", "https:"],
        workerSrc: ["'self'", "blob:"],
        connectSrc: ["'self'"],
        objectSrc: ["'none'"],
        baseUri: ["'none'"],
        formAction: ["'self'"],
        frameAncestors: ["'none'"],
      },
    },
    strictTransportSecurity: false,
    referrerPolicy: { policy: "no-referrer" },
  });
}
