/** The OpenAPI routes for the operator, plotters, webhooks, notices, pairing, shared jobs and logs. */
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
import type { ApiRoute } from "./api-route.js";

const okSchema = z.object({ ok: z.literal(true) });

export const STUDIO_ROUTES: readonly ApiRoute[] = [
  {
    method: "post",
    path: "/operator/take",
    about: "Makes the calling browser the operator",
    answer: z.object({ operator: operatorSchema }),
  },
  {
    method: "get",
    path: "/devices",
    about: "Lists the boards that are plugged in",
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
    about: "Changes name, device or machine of a plotter",
    body: plotterPatchSchema,
    answer: plotterSchema,
  },
  { method: "delete", path: "/plotters/:id", about: "Removes a plotter without jobs", answer: okSchema },
  {
    method: "get",
    path: "/plotters/:id/queue",
    about: "Returns the queue settings of a plotter",
    answer: queueSettingsSchema,
  },
  {
    method: "patch",
    path: "/plotters/:id/queue",
    about: "Changes the queue settings of a plotter",
    body: queueSettingsSchema,
    answer: queueSettingsSchema,
  },
  {
    method: "get",
    path: "/webhooks",
    about: "Lists the webhooks",
    answer: z.object({ webhooks: z.array(webhookSchema) }),
  },
  {
    method: "post",
    path: "/webhooks",
    about: "Adds a webhook; its secret is returned only here",
    body: newWebhookSchema,
    answer: z.object({ webhook: webhookSchema, secret: z.string() }),
    status: 201,
  },
  { method: "delete", path: "/webhooks/:id", about: "Removes a webhook", answer: okSchema },
  { method: "delete", path: "/notices/:id", about: "Dismisses a notice", answer: okSchema },
  {
    method: "post",
    path: "/pairing",
    about: "Returns the links that pair a device; only on the server's computer",
    answer: pairingSchema,
  },
  {
    method: "get",
    path: "/shared-jobs",
    about: "Lists the jobs of the shared queue, newest first",
    answer: z.object({ jobs: z.array(sharedJobSchema) }),
  },
  {
    method: "post",
    path: "/shared-jobs",
    about: "Adds a job to the shared queue, for a plotter's name or a machine",
    body: newSharedJobSchema,
    answer: z.object({ id: z.string() }),
    status: 201,
  },
  {
    method: "post",
    path: "/shared-jobs/:id/give-back",
    about:
      "Gives back a job that an unreachable server took but did not start, so that another server can take it",
    answer: okSchema,
  },
  {
    method: "delete",
    path: "/shared-jobs/:id",
    about: "Withdraws a job that no server has taken",
    answer: okSchema,
  },
  { method: "get", path: "/logs", about: "Returns all logs as one text, for a bug report", answer: "text" },
];
