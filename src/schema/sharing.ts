/** A server that several people use: its plotters, its webhooks, who has access, and pairing with other devices. */
import { z } from "zod";
import { nameSchema } from "./name.js";

/** "auto": the first board of the machine's controller that no other plotter uses, or else the virtual one; "virtual"; or a serial path. */
const deviceChoiceSchema = z.string().trim().min(1).max(500);

/** A board connected to the server, or a device that may be one. */
export const deviceSchema = z.object({
  path: z.string(),
  description: z.string(),
  /** Id of the plotter that uses it. */
  inUseBy: z.string().nullable(),
});
export type Device = z.infer<typeof deviceSchema>;

export const askedDeviceSchema = deviceSchema.extend({
  /** Name and version, such as "Grbl 1.1h"; null: nothing that plotwright knows answers. */
  answer: z.string().nullable(),
  /** Why the port could not be opened; null if it could. */
  fault: z.string().nullable(),
});
export type AskedDevice = z.infer<typeof askedDeviceSchema>;

export const newPlotterSchema = z.object({
  name: nameSchema(100),
  device: deviceChoiceSchema,
  /** Id of a machine profile for manual moves. */
  machine: z.string().min(1).max(100).nullable().default(null),
});
export type NewPlotter = z.input<typeof newPlotterSchema>;

export const plotterPatchSchema = z
  .object({
    name: nameSchema(100),
    /** The plotter reconnects. */
    device: deviceChoiceSchema,
    machine: z.string().min(1).max(100).nullable(),
  })
  .partial();
export type PlotterPatch = z.infer<typeof plotterPatchSchema>;

export const WEBHOOK_EVENTS = ["started", "progress", "waiting", "done", "failed"] as const;
export const webhookEventSchema = z.enum(WEBHOOK_EVENTS);
export type WebhookEvent = z.infer<typeof webhookEventSchema>;

/** How often "progress" is sent: after so much of the plot, and so much time. */
export const webhookProgressSchema = z.object({
  everyPct: z.number().min(1).max(100).default(5),
  everyS: z.number().min(5).max(86_400).default(30),
});
export type WebhookProgress = z.infer<typeof webhookProgressSchema>;

export const webhookSchema = z.object({
  id: z.string(),
  name: z.string(),
  url: z.string(),
  events: z.array(webhookEventSchema),
  progress: webhookProgressSchema,
  createdAt: z.string(),
  /** Deliveries that have not succeeded yet and are retried. */
  pendingCount: z.int(),
  /** Result of the latest attempt; null before the first. */
  last: z.object({ at: z.string(), isDelivered: z.boolean(), message: z.string() }).nullable(),
});
export type Webhook = z.infer<typeof webhookSchema>;

export const newWebhookSchema = z.object({
  name: nameSchema(100),
  url: z
    .url({ protocol: /^https?$/, error: "it must be an address that begins with http:// or https://" })
    .max(2_000),
  events: z.array(webhookEventSchema).min(1).max(WEBHOOK_EVENTS.length),
  progress: webhookProgressSchema.prefault({}),
});
export type NewWebhook = z.input<typeof newWebhookSchema>;

/** The body of a webhook request; its header is `Plotwright-Signature: t=SECONDS,v1=HMAC-SHA256 of "SECONDS.BODY"`. */
export const webhookMessageSchema = z.object({
  id: z.string(),
  event: webhookEventSchema,
  at: z.string(),
  job: z.object({
    id: z.string(),
    name: z.string(),
    state: z.string(),
    message: z.string().nullable(),
    /** Share of the plot's time, 0 … 1. */
    progress: z.number(),
    /** Null: not known. */
    remainingS: z.number().nullable(),
    /** The layer and pen it waits for, in words. */
    wait: z.string().nullable(),
  }),
  plotter: z.object({ id: z.string(), name: z.string() }),
});
export type WebhookMessage = z.infer<typeof webhookMessageSchema>;

/** Links for pairing another device, also as QR codes (SVG text). */
export const pairingSchema = z.object({
  /** False: the server listens on this computer only, so other devices cannot use the links. */
  isOnLan: z.boolean(),
  operateUrl: z.string(),
  submitUrl: z.string(),
  watchUrl: z.string(),
  operateQrSvg: z.string(),
  submitQrSvg: z.string(),
  watchQrSvg: z.string(),
});
export type Pairing = z.infer<typeof pairingSchema>;

/**
 * "submit": may add jobs and sees only its own, for a classroom; "watch": may see everything and stop a plot, but change
 * nothing.
 */
export const ROLES = ["operate", "submit", "watch"] as const;
export const roleSchema = z.enum(ROLES);
export type Role = z.infer<typeof roleSchema>;

/** A paired browser, or a key for scripts. The secret is shown only once, when it is created. */
export const accessEntrySchema = z.object({
  id: z.string(),
  kind: z.enum(["session", "key"]),
  role: roleSchema,
  name: z.string(),
  createdAt: z.string(),
  lastSeenAt: z.string(),
});
export type AccessEntry = z.infer<typeof accessEntrySchema>;

export const newKeySchema = z.object({ name: nameSchema(200), role: roleSchema });
export type NewKey = z.infer<typeof newKeySchema>;

/** Who the caller is: `id` is the browser's id, null for scripts. */
export const meSchema = z.object({
  role: roleSchema,
  id: z.string().nullable(),
  name: z.string().nullable(),
});
export type Me = z.infer<typeof meSchema>;
