/** /api/v1: the operator, notices, pairing and logs. */
import { Router } from "express";
import { z } from "zod";
import { PlotwrightError } from "../../src/index.js";
import { operatorSchema, pairingSchema, type Pairing } from "../../src/schema/index.js";
import { bundleText } from "../storage/log-book.js";
import type { PlotterPort } from "../../host/plotter/plotter-port.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { Notices } from "../../host/queue/notices.js";
import type { Access } from "../security/access.js";
import type { OperatorLock } from "../security/operator-lock.js";
import { okSchema, route, type ApiRoute } from "./api-route.js";
import { isTrusted } from "./auth.js";
import type { Browsers } from "./browser.js";
import type { Refusals } from "./refusals.js";

export interface OperatorParts {
  readonly version: string;
  readonly access: Access;
  readonly operatorLock: OperatorLock;
  readonly browsers: Browsers;
  readonly notices: Notices;
  readonly queue: JobQueue;
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly pairing: () => Promise<Pairing>;
  readonly serverLog: () => Promise<string>;
  readonly refusals: Refusals;
}

export const OPERATOR_ROUTES: readonly ApiRoute[] = [
  route(
    "post",
    "/operator/take",
    "Makes the calling browser the operator",
    z.object({ operator: operatorSchema }),
  ),
  route("delete", "/notices/:id", "Dismisses a notice", okSchema),
  route(
    "post",
    "/pairing",
    "Returns the links that pair a device; only on the server's computer",
    pairingSchema,
  ),
  route("get", "/logs", "Returns all logs as one text, for a bug report", "text"),
];

export function operatorRoutes(parts: OperatorParts): Router {
  const { access, operatorLock, browsers, notices, refusals } = parts;
  const router = Router();

  router.post("/operator/take", (request, response) => {
    const browser = browsers.of(request);
    if (browser === null) {
      throw new PlotwrightError("bad-setting", "Only a browser can take over; scripts may act at any time.");
    }
    response.json({ operator: operatorLock.take(browser) });
  });

  router.delete("/notices/:id", (request, response) => {
    notices.remove(request.params.id);
    response.json({ ok: true });
  });

  // Anyone with such a link gets access, so only users at this computer may see them.
  router.post("/pairing", async (request, response) => {
    if (!isTrusted(request, access)) {
      refusals.note(request, "pairing links are only for this computer");
      throw new PlotwrightError(
        "not-allowed",
        "Pairing links are shown only on the computer where the server runs, and in its terminal.",
      );
    }
    response.json(await parts.pairing());
  });

  router.get("/logs", async (_request, response) => {
    const text = bundleText({
      version: parts.version,
      serverLog: await parts.serverLog(),
      jobs: parts.queue.list(),
      plotters: [...parts.plotters.values()].map((port) => ({ plotter: port.snapshot(), log: port.log() })),
    });
    response.attachment("plotwright-logs.txt").type("text/plain; charset=utf-8").send(text);
  });

  return router;
}
