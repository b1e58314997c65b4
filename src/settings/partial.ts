/** Settings that give only a part, laid over complete ones. */

/** Any part of T. Lists are given as a whole. */
export type DeepPartial<T> = T extends string | readonly unknown[]
  ? T
  : T extends object
    ? { readonly [K in keyof T]?: DeepPartial<T[K]> | undefined }
    : T;

/** Tables by layer, which belong to one drawing, and a machine's profile: a part of these would be a mixture. */
export const GIVEN_WHOLE: readonly string[] = [
  "layers",
  "layerRepeats",
  "layerPens",
  "layerStops",
  "layerShifts",
  "customMachine",
];

/**
 * `base` with what `given` has. Objects are laid over each other field by field; lists, tables by layer and machine
 * profiles are replaced. A field that is undefined counts as left out.
 */
export function withGiven<T extends object>(base: T, given: NoInfer<DeepPartial<T>>): T {
  // For a value of another kind, from a program without types; the checks of settings report it.
  if (!isObject(given)) return given;
  const merged: Record<string, unknown> = { ...(base as Record<string, unknown>) };
  for (const [key, value] of Object.entries(given)) {
    if (value === undefined) continue;
    const before = merged[key];
    const isPart = isObject(before) && isObject(value) && !GIVEN_WHOLE.includes(key);
    merged[key] = isPart ? withGiven(before, value) : value;
  }
  return merged as T;
}

const isObject = (value: unknown): value is object =>
  typeof value === "object" && value !== null && !Array.isArray(value);

/**
 * Whether two settings are equal as JSON. The order of keys does not count, and a field that is undefined counts as left
 * out.
 */
export const isSameJson = (a: unknown, b: unknown): boolean => sortedJson(a) === sortedJson(b);

const sortedJson = (value: unknown): string =>
  JSON.stringify(value, (_key, part: unknown) =>
    typeof part === "object" && part !== null && !Array.isArray(part)
      ? Object.fromEntries(Object.entries(part).sort(([one], [other]) => (one < other ? -1 : 1)))
      : part,
  );
