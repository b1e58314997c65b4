/**
 * Assembles the express app: guards first, then the API, then the page. The limit of requests is the first guard, so that
 * also those that the others refuse are counted.
 */
import express, { Router, type Express } from "express";
import helmet from "helmet";
import { PlotwrightError } from "../../src/index.js";
import type { Pairing } from "../../src/schema/index.js";
import type { MachineFiles } from "../storage/machine-files.js";
import { drawingBoxMm } from "../planning/drawing-box.js";
import { lane } from "../../host/planning/lane.js";
import type { DrawingFiles } from "../storage/drawing-files.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { Access } from "../security/access.js";
import type { OperatorLock } from "../security/operator-lock.js";
import type { Notices } from "../../host/queue/notices.js";
import type { PlotterRegistry } from "../../host/plotter/plotter-registry.js";
import type { UploadedDrawings } from "../storage/uploaded-drawings.js";
import { ACCESS_ROUTES, accessRoutes } from "./access-routes.js";
import type { ApiPart } from "./api-route.js";
import { Browsers, requireOperator } from "./browser.js";
import { limitRequests, pairRoutes, requireRole } from "./auth.js";
import { DRAWING_ROUTES, drawingRoutes } from "./drawing-routes.js";
import { errorResponder, notFound } from "./errors.js";
import type { EventHub } from "./events.js";
import { guardHosts, guardPaths } from "./guard.js";
import { HAND_MOVE_ROUTES, handMoveRoutes, type HandMoveParts } from "./hand-move-routes.js";
import { JOB_ROUTES, jobRoutes } from "./job-routes.js";
import { MACHINE_ROUTES, machineRoutes } from "./machine-routes.js";
import { openApiText } from "./openapi.js";
import { OPERATOR_ROUTES, operatorRoutes } from "./operator-routes.js";
import { PLOTTER_ROUTES, plotterRoutes } from "./plotter-routes.js";
import type { Refusals } from "./refusals.js";
import { SAMPLE_ROUTES, sampleRoutes } from "./sample-routes.js";
import { STATE_ROUTES, stateRoutes } from "./state-routes.js";

export interface AppParts {
  readonly version: string;
  readonly queue: JobQueue;
  readonly files: DrawingFiles;
  readonly uploads: UploadedDrawings;
  readonly registry: PlotterRegistry;
  readonly hub: EventHub;
  readonly operatorLock: OperatorLock;
  readonly notices: Notices;
  /** Routes of the plug-ins that are loaded. */
  readonly plugins: readonly ApiPart[];
  /** Links that pair a device. */
  readonly pairing: () => Promise<Pairing>;
  /** The server's log so far. */
  readonly serverLog: () => Promise<string>;
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
  readonly refusals: Refusals;
}

export function createApp(parts: AppParts): Express {
  const { access, queue, log, refusals } = parts;
  const browsers = new Browsers(access, parts.operatorLock.operator);
  const isRunning = (jobId: string): boolean => queue.isRunning(jobId);
  const app = express();
  app.disable("x-powered-by");
  // Answers of the API are not cached, so a hash of each would be for nothing.
  app.disable("etag");
  app.use(securityHeaders());
  app.use(limitRequests(access, isRunning, refusals));
  app.use(guardHosts(parts.allowedHosts, parts.localName, refusals));
  app.use(guardPaths(refusals));
  app.use(pairRoutes(access, refusals, log));
  app.use(browsers.routes());
  app.use("/api", requireRole(access, isRunning, refusals));
  app.use("/api", requireOperator(browsers, parts.operatorLock, isRunning));
  app.use("/api/v1", apiRoutes(parts, browsers));
  app.use("/api", notFound);
  app.use(pageRoutes(parts.webDir));
  app.use(notFound);
  app.use(errorResponder(log, refusals));
  return app;
}

/** The parts of the API, those of the plug-ins included. */
export function apiParts(
  parts: AppParts,
  browsers = new Browsers(parts.access),
  openApi = (): Promise<string> => Promise.resolve("{}"),
): readonly ApiPart[] {
  const { queue, files, uploads, machines, registry } = parts;
  const plotters = registry.ports;
  return [
    { path: "", router: stateRoutes(parts, browsers, openApi), routes: STATE_ROUTES },
    { path: "", router: operatorRoutes({ ...parts, plotters, browsers }), routes: OPERATOR_ROUTES },
    { path: "", router: plotterRoutes(registry, queue, parts.log), routes: PLOTTER_ROUTES },
    { path: "/plotters", router: handMoveRoutes(handMoveParts(parts)), routes: HAND_MOVE_ROUTES },
    { path: "/access", router: accessRoutes(parts.access), routes: ACCESS_ROUTES },
    { path: "/drawings", router: drawingRoutes(uploads), routes: DRAWING_ROUTES },
    { path: "/jobs", router: jobRoutes({ queue, files, uploads }), routes: JOB_ROUTES },
    { path: "/machines", router: machineRoutes(machines), routes: MACHINE_ROUTES },
    { path: "/samples", router: sampleRoutes(parts.samplesDir), routes: SAMPLE_ROUTES },
    ...parts.plugins,
  ];
}

function handMoveParts({ registry, queue, files }: AppParts): HandMoveParts {
  const turn = lane(2);
  return {
    plotters: registry.ports,
    queue,
    jobBoxMm: (id) =>
      turn({ client: id }, () => drawingBoxMm(files.path(queue.drawingOf(id)), queue.get(id).settings)),
  };
}

/** Messages for the routes of plug-ins that are not loaded. */
const WITHOUT_PLUGIN: Readonly<Record<string, string>> = {
  "/shared-jobs": "This server has no shared queue. Start it with serve --shared-queue to use one.",
  "/webhooks": "Webhooks are switched off on this server.",
};

function apiRoutes(parts: AppParts, browsers: Browsers): Router {
  const router = Router();
  router.use((_request, response, next) => {
    response.set("Cache-Control", "no-store");
    next();
  });
  let text: Promise<string> | null = null;
  const all = apiParts(parts, browsers, () => {
    text ??= openApiText(
      parts.version,
      all.flatMap(({ routes }) => routes),
    );
    return text;
  });
  for (const part of all) router.use(part.path === "" ? "/" : part.path, part.router);
  for (const [path, message] of Object.entries(WITHOUT_PLUGIN)) {
    if (all.some((part) => part.path === path)) continue;
    router.use(path, () => {
      throw new PlotwrightError("not-found", message);
    });
  }
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
