/** Checks the arguments of a page's call on the host, as the server's routes check the bodies of requests. */
import type { z } from "zod";
import { PlotwrightError } from "../../../src/index.js";
import { firstFault } from "../../../src/schema/index.js";

/** Throws `bad-setting` that names the first invalid field. */
export function checked<T>(schema: z.ZodType<T>, value: unknown): T {
  const result = schema.safeParse(value);
  if (result.success) return result.data;
  const { path, words } = firstFault(result.error);
  throw new PlotwrightError("bad-setting", `${path === "" ? "The request" : path}: ${words}.`);
}
