/** Checks what a client sent: the body of a request to the server, or the arguments of a page's call. */
import { z } from "zod";
import { PlotwrightError } from "../src/index.js";
import { firstFault } from "../src/schema/index.js";

/** Throws `bad-setting` that names the first invalid field. */
export function parseWith<T>(schema: z.ZodType<T>, value: unknown): T {
  const result = schema.safeParse(value);
  if (result.success) return result.data;
  const { path, words } = firstFault(result.error);
  throw new PlotwrightError("bad-setting", `${path === "" ? "The request" : path}: ${words}.`);
}

/** As `parseWith`, for a request that says what to do: names that it does not have are refused. */
export function parseRequest<T>(schema: z.ZodType<T>, value: unknown): T {
  const known = fieldsOf(schema);
  if (known.length > 0) mustKnow(known, value);
  return parseWith(schema, value);
}

/** Of an object, or of any in a union of objects. */
function fieldsOf(schema: unknown): string[] {
  if (schema instanceof z.ZodObject) return Object.keys(schema.shape);
  return schema instanceof z.ZodUnion ? schema.options.flatMap(fieldsOf) : [];
}

/** Throws `bad-setting` for another name, as in settings: a misspelt "settings" must not be ignored. */
export function mustKnow(known: readonly string[], value: unknown): void {
  if (typeof value !== "object" || value === null || Array.isArray(value)) return;
  const unknown = Object.keys(value).find((name) => !known.includes(name));
  if (unknown === undefined) return;
  const shown = unknown.slice(0, MAX_SHOWN);
  throw new PlotwrightError(
    "bad-setting",
    `${shown}: there is no such field. There is ${[...new Set(known)].join(", ")}.`,
  );
}

const MAX_SHOWN = 60;
