/**
 * Assembles the express app: guards first, then the API, then the page. The limit of requests is the first guard, so that
 * also those that the others refuse are counted.
 */
import express, { Router, type Express } from "express";
import helmet from "helmet";
import { API_PATH, type Operation } from "../../src/schema/index.js";
import { limitRequests, pairRoutes, requireLocal, requireRole } from "./auth.js";
import { Browsers, requireOperator } from "./browser.js";
import { answerPreflights, crossOriginHeaders } from "./cross-origin.js";
import { errorResponder, notFound } from "./errors.js";
import { guardHosts, guardPaths } from "./guard.js";
import { openApiText } from "./openapi.js";
import { missingPlugins, offeredOperations, operationRoutes, requireOwnJob } from "./operation-routes.js";
import type { Refusals } from "./refusals.js";
import { serverHandlers, serverResponders, type ServerParts } from "./server-operations.js";

export interface AppParts extends ServerParts {
  readonly allowedHosts: readonly string[];
  /** Origins whose pages may use the API with a key, as browsers send them. */
  readonly allowedOrigins: readonly string[];
  /** Folder with the built page. */
  readonly webDir: string;
  readonly refusals: Refusals;
}

export function createApp(parts: AppParts): Express {
  const { access, queue, log, refusals, allowedOrigins } = parts;
  const browsers = new Browsers(access, parts.operatorLock.operator);
  const isRunning = (jobId: string): boolean => queue.isRunning(jobId);
  const app = express();
  app.disable("x-powered-by");
  // Answers of the API are not cached, so a hash of each would be for nothing.
  app.disable("etag");
  app.use(securityHeaders());
  if (allowedOrigins.length > 0) app.use("/api", crossOriginHeaders(allowedOrigins));
  app.use(limitRequests(access, isRunning, allowedOrigins, refusals));
  app.use(guardHosts(parts.allowedHosts, allowedOrigins, parts.localName, refusals));
  app.use(guardPaths(refusals));
  app.use("/api", answerPreflights(allowedOrigins));
  app.use(pairRoutes(access, refusals, log));
  app.use(browsers.routes());
  app.use("/api", requireRole(access, isRunning, refusals));
  app.use("/api", requireOperator(browsers, parts.operatorLock, isRunning));
  app.use(API_PATH, noStore, apiRoutes(parts, browsers).router);
  app.use("/api", notFound);
  app.use(pageRoutes(parts.webDir));
  app.use(notFound);
  app.use(errorResponder(log, refusals));
  return app;
}

/** The operations that this server offers, and the routes to them. */
export function apiRoutes(
  parts: AppParts,
  browsers = new Browsers(parts.access),
): { readonly router: Router; readonly operations: readonly Operation[] } {
  let text: Promise<string> | null = null;
  const openApi = (): Promise<string> => (text ??= openApiText(parts.version, offered));
  const handlers = serverHandlers(parts);
  const responders = serverResponders(parts, browsers, openApi);
  const offered = offeredOperations({ handlers, responders });
  const operations = Object.values(offered).flatMap((group = {}) => Object.values(group));
  const router = operationRoutes({
    handlers,
    responders,
    maxBytes: parts.files.maxBytes,
    requireLocal: requireLocal(parts.access, parts.refusals),
    requireOwnJob: requireOwnJob(parts.queue),
  });
  router.use(missingPlugins(handlers));
  return { router, operations };
}

const noStore: express.RequestHandler = (_request, response, next) => {
  response.set("Cache-Control", "no-store");
  next();
};

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
