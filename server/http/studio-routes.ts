/** /api/v1: the operator, webhooks, notices, pairing and logs. */
import express, { Router } from "express";
import { PlotwrightError } from "../../src/index.js";
import { newWebhookSchema, type Pairing } from "../../src/schema/index.js";
import { bundleText } from "../log-book.js";
import type { PlotterPort } from "../queue/plotter-port.js";
import type { JobQueue } from "../queue/job-queue.js";
import type { Notices } from "../queue/notices.js";
import type { Access } from "../security/access.js";
import type { OperatorLock } from "../security/operator-lock.js";
import type { Webhooks } from "../webhooks/webhooks.js";
import { isTrusted } from "./auth.js";
import type { Browsers } from "./browser.js";
import { parseWith } from "./errors.js";

export interface StudioParts {
  readonly version: string;
  readonly access: Access;
  readonly operatorLock: OperatorLock;
  readonly browsers: Browsers;
  readonly webhooks: Webhooks;
  readonly notices: Notices;
  readonly queue: JobQueue;
  readonly plotters: ReadonlyMap<string, PlotterPort>;
  readonly pairing: () => Promise<Pairing>;
  readonly serverLog: () => string;
  readonly log: (line: string) => void;
}

export function studioRoutes(parts: StudioParts): Router {
  const { access, operatorLock, browsers, webhooks, notices, log } = parts;
  const router = Router();
  const small = express.json({ limit: "10kb" });

  router.post("/operator/take", (request, response) => {
    const browser = browsers.of(request);
    if (browser === null) {
      throw new PlotwrightError("bad-setting", "Only a browser can take over; scripts may act at any time.");
    }
    response.json({ operator: operatorLock.take(browser) });
  });

  router.get("/webhooks", (_request, response) => {
    response.json({ webhooks: webhooks.list() });
  });
  router.post("/webhooks", small, (request, response) => {
    const made = webhooks.add(parseWith(newWebhookSchema, request.body));
    log(`webhook ${JSON.stringify(made.webhook.name)} added (${new URL(made.webhook.url).host})`);
    response.status(201).json(made);
  });
  router.delete("/webhooks/:id", (request, response) => {
    webhooks.remove(request.params.id);
    response.json({ ok: true });
  });

  router.delete("/notices/:id", (request, response) => {
    notices.remove(request.params.id);
    response.json({ ok: true });
  });

  // Anyone with such a link gets access, so only users at this computer may see them.
  router.post("/pairing", async (request, response) => {
    if (!isTrusted(request, access)) {
      log(`refused pairing links to ${request.socket.remoteAddress ?? "?"}`);
      throw new PlotwrightError(
        "not-allowed",
        "Pairing links are shown only on the computer where the server runs, and in its terminal.",
      );
    }
    response.json(await parts.pairing());
  });

  router.get("/logs", (_request, response) => {
    const text = bundleText({
      version: parts.version,
      serverLog: parts.serverLog(),
      jobs: parts.queue.list(),
      plotters: [...parts.plotters.values()].map((port) => ({ plotter: port.snapshot(), log: port.log() })),
    });
    response.attachment("plotwright-logs.txt").type("text/plain; charset=utf-8").send(text);
  });

  return router;
}
