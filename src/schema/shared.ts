/** Jobs that several servers share: a server that has a suitable plotter takes the job. */
import { z } from "zod";
import { hasOneDrawing, ONE_DRAWING } from "./job-drawing.js";
import { nameSchema } from "./name.js";
import { givenSettingsSchema } from "./given-settings.js";

/** A plotter by its name, or any plotter of one machine type. */
export const sharedTargetSchema = z.union([
  z.object({ plotter: nameSchema(100) }),
  z.object({ machine: z.string().min(1).max(100) }),
]);
export type SharedTarget = z.infer<typeof sharedTargetSchema>;

/** Has either the text of a small drawing, or the id of a drawing uploaded before. */
export const newSharedJobSchema = z
  .object({
    name: nameSchema(200),
    drawing: z.string().min(1).optional(),
    /** From POST /drawings. */
    drawingId: z.string().max(100).optional(),
    /** Laid over the settings of the plotter that draws it. */
    settings: givenSettingsSchema.optional(),
    target: sharedTargetSchema,
  })
  .refine(hasOneDrawing, ONE_DRAWING);
export type NewSharedJob = z.infer<typeof newSharedJobSchema>;

/** A server that has not reported for this long counts as lost. */
export const SERVER_LOST_AFTER_MS = 60_000;

/**
 * waiting ──> taken ──> stored (in the queue of `server`) | refused (not plottable); waiting ──> withdrawn
 *    ^──────────┴─────────┘ returned when its server is lost, unless it has begun
 */
export const sharedJobSchema = z.object({
  id: z.string(),
  name: z.string(),
  target: z.string(),
  state: z.enum(["waiting", "taken", "stored", "refused", "withdrawn"]),
  /** Name of the server that took it. */
  server: z.string().nullable(),
  /** When that server last reported (ISO 8601); null if never. */
  serverSeenAt: z.string().nullable().default(null),
  /** The plot has begun there, so the job cannot be returned. */
  hasBegun: z.boolean().default(false),
  message: z.string().nullable(),
  createdAt: z.string(),
});
export type SharedJob = z.infer<typeof sharedJobSchema>;
