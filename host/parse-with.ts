/** Checks what a client sent: the body of a request to the server, or the arguments of a page's call. */
import type { z } from "zod";
import { PlotwrightError } from "../src/index.js";
import { firstFault } from "../src/schema/index.js";

/** Throws `bad-setting` that names the first invalid field. */
export function parseWith<T>(schema: z.ZodType<T>, value: unknown): T {
  const result = schema.safeParse(value);
  if (result.success) return result.data;
  const { path, words } = firstFault(result.error);
  throw new PlotwrightError("bad-setting", `${path === "" ? "The request" : path}: ${words}.`);
}
