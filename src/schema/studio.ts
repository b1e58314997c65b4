/** Of a server that is left alone: its plotters, whom it tells, and how devices pair with it. */
import { z } from "zod";
import { nameSchema } from "./name.js";

/** "auto": the first EiBotBoard that no other plotter has, else the virtual board; "virtual"; or a serial path. */
const deviceChoiceSchema = z.string().trim().min(1).max(500);

/** A board that is plugged into the server. */
export const deviceSchema = z.object({
  path: z.string(),
  description: z.string(),
  /** Id of the plotter that has it. */
  inUseBy: z.string().nullable(),
});
export type Device = z.infer<typeof deviceSchema>;

export const newPlotterSchema = z.object({
  name: nameSchema(100),
  device: deviceChoiceSchema,
  /** Id of a machine profile, taken for moves by hand. */
  machine: z.string().min(1).max(100).nullable().default(null),
});
export type NewPlotter = z.input<typeof newPlotterSchema>;

export const plotterPatchSchema = z
  .object({
    name: nameSchema(100),
    /** The plotter connects anew. */
    device: deviceChoiceSchema,
    machine: z.string().min(1).max(100).nullable(),
  })
  .partial();
export type PlotterPatch = z.infer<typeof plotterPatchSchema>;

export const WEBHOOK_EVENTS = ["done", "waiting", "failed"] as const;
export const webhookEventSchema = z.enum(WEBHOOK_EVENTS);
export type WebhookEvent = z.infer<typeof webhookEventSchema>;

export const webhookSchema = z.object({
  id: z.string(),
  name: z.string(),
  url: z.string(),
  events: z.array(webhookEventSchema),
  createdAt: z.string(),
  /** Deliveries that have not arrived yet and are tried again. */
  pendingCount: z.int(),
  /** How the latest try went; null before the first. */
  last: z.object({ at: z.string(), isDelivered: z.boolean(), message: z.string() }).nullable(),
});
export type Webhook = z.infer<typeof webhookSchema>;

export const newWebhookSchema = z.object({
  name: nameSchema(100),
  url: z.url({ protocol: /^https?$/ }).max(2_000),
  events: z.array(webhookEventSchema).min(1).max(WEBHOOK_EVENTS.length),
});
export type NewWebhook = z.infer<typeof newWebhookSchema>;

/** What is posted to a webhook, with the header `Plotwright-Signature: t=SECONDS,v1=HMAC-SHA256 of "SECONDS.BODY"`. */
export const webhookMessageSchema = z.object({
  id: z.string(),
  event: webhookEventSchema,
  at: z.string(),
  job: z.object({
    id: z.string(),
    name: z.string(),
    state: z.string(),
    message: z.string().nullable(),
    /** Layer and pen it waits for, in words. */
    wait: z.string().nullable(),
  }),
  plotter: z.object({ id: z.string(), name: z.string() }),
});
export type WebhookMessage = z.infer<typeof webhookMessageSchema>;

/** Links that pair another device, and the same as QR codes (SVG text). */
export const pairingSchema = z.object({
  /** False: the server listens on this computer only, so no other device can use the links. */
  isOnLan: z.boolean(),
  operateUrl: z.string(),
  watchUrl: z.string(),
  operateQrSvg: z.string(),
  watchQrSvg: z.string(),
});
export type Pairing = z.infer<typeof pairingSchema>;
