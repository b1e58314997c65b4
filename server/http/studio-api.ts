/** The part of the OpenAPI document on plotters, operator, webhooks and what else a studio needs. */
import { z } from "zod";
import {
  deviceSchema,
  newPlotterSchema,
  newSharedJobSchema,
  newWebhookSchema,
  operatorSchema,
  pairingSchema,
  plotterPatchSchema,
  plotterSchema,
  queueSettingsSchema,
  sharedJobSchema,
  webhookSchema,
} from "../../src/schema/index.js";
import type { ApiRoute } from "./openapi.js";

const okSchema = z.object({ ok: z.literal(true) });

export const STUDIO_ROUTES: readonly ApiRoute[] = [
  {
    method: "post",
    path: "/operator/take",
    about: "The calling browser becomes the operator",
    answer: z.object({ operator: operatorSchema }),
  },
  {
    method: "get",
    path: "/devices",
    about: "Boards that are plugged in",
    answer: z.object({ devices: z.array(deviceSchema) }),
  },
  {
    method: "post",
    path: "/plotters",
    about: "Adds a plotter",
    body: newPlotterSchema,
    answer: plotterSchema,
    status: 201,
  },
  {
    method: "patch",
    path: "/plotters/:id",
    about: "Renames it, gives it another device or machine",
    body: plotterPatchSchema,
    answer: plotterSchema,
  },
  { method: "delete", path: "/plotters/:id", about: "Removes a plotter without jobs", answer: okSchema },
  { method: "get", path: "/plotters/:id/queue", about: "How its queue runs", answer: queueSettingsSchema },
  {
    method: "patch",
    path: "/plotters/:id/queue",
    about: "Changes how its queue runs",
    body: queueSettingsSchema,
    answer: queueSettingsSchema,
  },
  {
    method: "get",
    path: "/webhooks",
    about: "Whom the server tells",
    answer: z.object({ webhooks: z.array(webhookSchema) }),
  },
  {
    method: "post",
    path: "/webhooks",
    about: "Adds one; its secret is shown once",
    body: newWebhookSchema,
    answer: z.object({ webhook: webhookSchema, secret: z.string() }),
    status: 201,
  },
  { method: "delete", path: "/webhooks/:id", about: "Removes one", answer: okSchema },
  { method: "delete", path: "/notices/:id", about: "Marks a notice as read", answer: okSchema },
  {
    method: "post",
    path: "/pairing",
    about: "Links that pair a device; from this computer only",
    answer: pairingSchema,
  },
  {
    method: "get",
    path: "/shared-jobs",
    about: "Jobs that several servers share, newest first",
    answer: z.object({ jobs: z.array(sharedJobSchema) }),
  },
  {
    method: "post",
    path: "/shared-jobs",
    about: "Adds one, for a plotter by name or a machine",
    body: newSharedJobSchema,
    answer: z.object({ id: z.string() }),
    status: 201,
  },
  {
    method: "post",
    path: "/shared-jobs/:id/give-back",
    about: "Lets another server have what one that has gone took and did not begin",
    answer: okSchema,
  },
  { method: "delete", path: "/shared-jobs/:id", about: "Withdraws one that still waits", answer: okSchema },
  { method: "get", path: "/logs", about: "What happened, to be sent to whoever helps", answer: "text" },
];
