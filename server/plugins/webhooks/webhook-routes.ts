/** /api/v1/webhooks: lists, adds and removes webhooks. */
import express, { Router } from "express";
import { z } from "zod";
import { newWebhookSchema, webhookSchema } from "../../../src/schema/index.js";
import { okSchema, route, type ApiRoute } from "../../http/api-route.js";
import { parseWith } from "../../../host/parse-with.js";
import type { Webhooks } from "./webhooks.js";

export const WEBHOOK_ROUTES: readonly ApiRoute[] = [
  route("get", "/webhooks", "Lists the webhooks", z.object({ webhooks: z.array(webhookSchema) })),
  route(
    "post",
    "/webhooks",
    "Adds a webhook; its secret is returned only here",
    z.object({ webhook: webhookSchema, secret: z.string() }),
    { body: newWebhookSchema, status: 201 },
  ),
  route("delete", "/webhooks/:id", "Removes a webhook", okSchema),
];

export function webhookRoutes(webhooks: Webhooks, log: (line: string) => void): Router {
  const router = Router();
  router.get("/", (_request, response) => {
    response.json({ webhooks: webhooks.list() });
  });
  router.post("/", express.json({ limit: "10kb" }), (request, response) => {
    const added = webhooks.add(parseWith(newWebhookSchema, request.body));
    log(`webhook ${JSON.stringify(added.webhook.name)} added (${new URL(added.webhook.url).host})`);
    response.status(201).json(added);
  });
  router.delete("/:id", (request, response) => {
    webhooks.remove(request.params.id);
    response.json({ ok: true });
  });
  return router;
}
