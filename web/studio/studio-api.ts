/** What a server that is left alone is told: plotters, devices that may use it, whom it tells. */
import { z } from "zod";
import {
  accessEntrySchema,
  deviceSchema,
  pairingSchema,
  plotterSchema,
  sharedJobSchema,
  webhookSchema,
  type NewKey,
  type NewPlotter,
  type NewSharedJob,
  type NewWebhook,
  type PlotterPatch,
  type SharedJob,
} from "../../src/schema/index.js";
import { ApiFault, okSchema } from "../api/client.js";
import type { Actions } from "../state/actions.js";
import type { DrawingText } from "../worker/protocol.js";

const devicesSchema = z.object({ devices: z.array(deviceSchema) });
const entriesSchema = z.object({ entries: z.array(accessEntrySchema) });
const newKeyAnswerSchema = z.object({ entry: accessEntrySchema, secret: z.string() });
const webhooksSchema = z.object({ webhooks: z.array(webhookSchema) });
const sharedJobsSchema = z.object({ jobs: z.array(sharedJobSchema) });
const sentSchema = z.object({ id: z.string() });
const newWebhookAnswerSchema = z.object({ webhook: webhookSchema, secret: z.string() });

export type StudioApi = ReturnType<typeof studioApi>;

/** Each answers null where it failed; the user has been told then. */
export const studioApi = ({ ask, attempt, uploadDrawing }: Actions) => {
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
    /** Asked again and again while it is looked at: a failure leaves what is shown. `jobs` is null where none is shared. */
    sharedJobs: (): Promise<{ readonly jobs: readonly SharedJob[] | null } | null> =>
      ask(sharedJobsSchema, "GET", "/shared-jobs").catch((error: unknown) =>
        error instanceof ApiFault && error.code === "not-found" ? { jobs: null } : null,
      ),
    shareJob: (job: Omit<NewSharedJob, "drawing">, drawing: DrawingText) =>
      attempt("share", async () =>
        ask(sentSchema, "POST", "/shared-jobs", { ...job, drawingId: await uploadDrawing(drawing) }),
      ),
    giveBackShared: (id: string) =>
      attempt("shared-job", () => ask(okSchema, "POST", `${one("shared-jobs", id)}/give-back`)),
    withdrawShared: (id: string) =>
      attempt("shared-job", () => ask(okSchema, "DELETE", one("shared-jobs", id))),
    removeWebhook: (id: string) => attempt("webhook", () => ask(okSchema, "DELETE", one("webhooks", id))),
  };
};
