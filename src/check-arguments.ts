/** Checks of the arguments of public functions, for programs that are written without types. */
import { PlotwrightError } from "./errors.js";

/** A value in an error message. */
function inWords(value: unknown): string {
  if (value === undefined) return "missing";
  if (typeof value === "string") return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}…` : value);
  if (value instanceof Promise) return "a promise: await it";
  if (Array.isArray(value)) return "a list";
  if (typeof value !== "object" || value === null) return String(value);
  const { name = "" } = value.constructor ?? {};
  return name === "" || name === "Object" ? "a different object" : `a ${name}`;
}

/** @throws TypeError if the text of a drawing is not a string */
export function checkText(call: string, text: unknown): void {
  if (typeof text === "string") return;
  throw new TypeError(
    `${call}: the drawing's text is ${inWords(text)}. Pass a string, for example readFileSync(name, "utf8").`,
  );
}

/**
 * Checks that a value is an object with certain fields.
 *
 * @param hint what to pass instead
 * @throws TypeError
 */
export function checkObject(
  call: string,
  what: string,
  value: unknown,
  fields: readonly string[],
  hint: string,
): void {
  const isObject = typeof value === "object" && value !== null && !Array.isArray(value);
  if (!isObject || value instanceof Promise)
    throw new TypeError(`${call}: ${what} is ${inWords(value)}. Pass ${hint}.`);
  const missing = fields.find((field) => (value as Record<string, unknown>)[field] === undefined);
  if (missing !== undefined) throw new TypeError(`${call}: ${what} has no "${missing}". Pass ${hint}.`);
}

/** @throws PlotwrightError "bad-setting" for a value that is not an object, and for unknown names of settings */
export function checkNames(
  what: string,
  values: unknown,
  known: readonly string[],
): asserts values is Readonly<Record<string, unknown>> {
  if (typeof values !== "object" || values === null || Array.isArray(values)) {
    throw new PlotwrightError("bad-setting", `The ${what} settings are ${inWords(values)}: pass an object.`);
  }
  const other = Object.keys(values).find((key) => !known.includes(key));
  if (other === undefined) return;
  throw new PlotwrightError(
    "bad-setting",
    `There is no ${what} setting "${other}". Settings: ${known.join(", ")}.`,
  );
}

/** @throws PlotwrightError "bad-setting" with the setting, its value and what is allowed */
export function refuseSetting(name: string, value: unknown, allowed: string): never {
  const is = typeof value === "number" ? String(value) : inWords(value);
  throw new PlotwrightError("bad-setting", `The setting ${name} is ${is}: it must be ${allowed}.`);
}
