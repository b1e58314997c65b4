/** Plotters, access, webhooks and the shared queue, through plotwright's server. */
import { z } from "zod";
import {
  accessEntrySchema,
  deviceSchema,
  pairingSchema,
  plotterSchema,
  sharedJobSchema,
  webhookSchema,
} from "../../../src/schema/index.js";
import { BackendFault, type StudioBackend } from "../backend.js";
import { pathOf, type Requests } from "./requests.js";

const devicesSchema = z.object({ devices: z.array(deviceSchema) });
const entriesSchema = z.object({ entries: z.array(accessEntrySchema) });
const newKeyAnswerSchema = z.object({ entry: accessEntrySchema, secret: z.string() });
const webhooksSchema = z.object({ webhooks: z.array(webhookSchema) });
const sharedJobsSchema = z.object({ jobs: z.array(sharedJobSchema) });
const sentSchema = z.object({ id: z.string() });
const newWebhookAnswerSchema = z.object({ webhook: webhookSchema, secret: z.string() });

export const studioRoutes = ({ ask, command, askWithDrawing }: Requests): StudioBackend => ({
  devices: async () => (await ask(devicesSchema, "GET", "/devices")).devices,
  addPlotter: (plotter) => ask(plotterSchema, "POST", "/plotters", plotter),
  patchPlotter: (id, patch) => ask(plotterSchema, "PATCH", pathOf("plotters", id), patch),
  removePlotter: (id) => command("DELETE", pathOf("plotters", id)),

  pairing: () => ask(pairingSchema, "POST", "/pairing"),
  access: async () => (await ask(entriesSchema, "GET", "/access")).entries,
  addKey: (key) => ask(newKeyAnswerSchema, "POST", "/access/keys", key),
  revoke: (id) => command("DELETE", pathOf("access", id)),

  webhooks: async () => (await ask(webhooksSchema, "GET", "/webhooks")).webhooks,
  addWebhook: (webhook) => ask(newWebhookAnswerSchema, "POST", "/webhooks", webhook),
  removeWebhook: (id) => command("DELETE", pathOf("webhooks", id)),

  sharedJobs: async () => {
    try {
      return (await ask(sharedJobsSchema, "GET", "/shared-jobs")).jobs;
    } catch (error) {
      if (error instanceof BackendFault && error.code === "not-found") return null;
      throw error;
    }
  },
  shareJob: async (job, drawing) => {
    await askWithDrawing(sentSchema, "/shared-jobs", job, drawing);
  },
  giveBackShared: (id) => command("POST", `${pathOf("shared-jobs", id)}/give-back`),
  withdrawShared: (id) => command("DELETE", pathOf("shared-jobs", id)),
});
