/** Jobs that several servers share: whichever has the plotter for one takes it. */
import { z } from "zod";
import { nameSchema } from "./name.js";
import { plotSettingsSchema } from "./settings.js";

/** A plotter by its name, or any plotter that is one machine. */
export const sharedTargetSchema = z.union([
  z.object({ plotter: nameSchema(100) }),
  z.object({ machine: z.string().min(1).max(100) }),
]);
export type SharedTarget = z.infer<typeof sharedTargetSchema>;

export const newSharedJobSchema = z.object({
  name: nameSchema(200),
  drawing: z.string().min(1),
  settings: plotSettingsSchema,
  target: sharedTargetSchema,
});
export type NewSharedJob = z.infer<typeof newSharedJobSchema>;

/** A server that was not heard of for so long counts as gone. */
export const SERVER_LOST_AFTER_MS = 60_000;

/**
 * waiting ──> taken ──> stored (in the queue of `server`) | refused (it can't be plotted); waiting ──> withdrawn
 *    ^──────────┴─────────┘ given back, as long as it has not begun, when its server has gone
 */
export const sharedJobSchema = z.object({
  id: z.string(),
  name: z.string(),
  target: z.string(),
  state: z.enum(["waiting", "taken", "stored", "refused", "withdrawn"]),
  /** Name of the server that has taken it. */
  server: z.string().nullable(),
  /** When that server was heard of last (ISO 8601); null when it never was. */
  serverSeenAt: z.string().nullable().default(null),
  /** Its plot has begun there, so that it can't be given back. */
  hasBegun: z.boolean().default(false),
  message: z.string().nullable(),
  createdAt: z.string(),
});
export type SharedJob = z.infer<typeof sharedJobSchema>;
