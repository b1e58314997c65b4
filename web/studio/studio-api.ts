/** What a server that is left alone is told: plotters, devices that may use it, whom it tells. */
import { z } from "zod";
import {
  accessEntrySchema,
  deviceSchema,
  pairingSchema,
  plotterSchema,
  webhookSchema,
  type NewKey,
  type NewPlotter,
  type NewWebhook,
  type PlotterPatch,
} from "../../src/schema/index.js";
import { okSchema } from "../api/client.js";
import type { Actions } from "../state/actions.js";

const devicesSchema = z.object({ devices: z.array(deviceSchema) });
const entriesSchema = z.object({ entries: z.array(accessEntrySchema) });
const newKeyAnswerSchema = z.object({ entry: accessEntrySchema, secret: z.string() });
const webhooksSchema = z.object({ webhooks: z.array(webhookSchema) });
const newWebhookAnswerSchema = z.object({ webhook: webhookSchema, secret: z.string() });

export type StudioApi = ReturnType<typeof studioApi>;

/** Each answers null where it failed; the user has been told then. */
export const studioApi = ({ ask, attempt }: Actions) => {
  const one = (what: string, id: string): string => `/${what}/${encodeURIComponent(id)}`;
  return {
    devices: () => attempt("devices", () => ask(devicesSchema, "GET", "/devices")),
    addPlotter: (plotter: NewPlotter) =>
      attempt("plotter", () => ask(plotterSchema, "POST", "/plotters", plotter)),
    patchPlotter: (id: string, patch: PlotterPatch) =>
      attempt("plotter", () => ask(plotterSchema, "PATCH", one("plotters", id), patch)),
    removePlotter: (id: string) => attempt("plotter", () => ask(okSchema, "DELETE", one("plotters", id))),
    pairing: () => attempt("pairing", () => ask(pairingSchema, "POST", "/pairing")),
    access: () => attempt("access", () => ask(entriesSchema, "GET", "/access")),
    addKey: (key: NewKey) => attempt("key", () => ask(newKeyAnswerSchema, "POST", "/access/keys", key)),
    revoke: (id: string) => attempt("access", () => ask(okSchema, "DELETE", one("access", id))),
    webhooks: () => attempt("webhooks", () => ask(webhooksSchema, "GET", "/webhooks")),
    addWebhook: (webhook: NewWebhook) =>
      attempt("webhook", () => ask(newWebhookAnswerSchema, "POST", "/webhooks", webhook)),
    removeWebhook: (id: string) => attempt("webhook", () => ask(okSchema, "DELETE", one("webhooks", id))),
  };
};
