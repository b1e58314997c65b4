/** Access to a server over the network. */
import { z } from "zod";
import { nameSchema } from "./name.js";

/** "watch": may see everything but change nothing. */
export const ROLES = ["operate", "watch"] as const;
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
