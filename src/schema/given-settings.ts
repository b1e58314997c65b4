/**
 * Settings as a caller gives them: any part of a job's settings, to be laid over those of the plotter. Unknown names are
 * refused, and the probable one is named: a misspelt height must not be ignored.
 */
import { z } from "zod";
import { aboutOf, wordsOf } from "../settings/texts.js";
import { bestMatches, type Searched } from "../settings/matching.js";
import type { DeepPartial } from "../settings/partial.js";
import { SETTING_FLAGS } from "../settings/tables.js";
import { machineProfileSchema } from "./machine.js";
import {
  motionSettingsSchema,
  penSettingsSchema,
  plotSettingsSchema,
  type PlotSettings,
} from "./settings.js";

export type GivenSettings = DeepPartial<PlotSettings>;

/**
 * Rebuilds a schema so that unknown names are refused, at every depth. With `isPart`, the fields of objects may be left
 * out, and then have no default: the settings below stay. Entries of lists and of tables by layer are always whole.
 *
 *   schema              { upPct: number, by default 60; layers?: { [id]: { extraDropMs: number, by default 0 } } }
 *   strict, as a part   { upPct?: number;               layers?: { [id]: { extraDropMs: number, by default 0 } } }
 */
function strict(schema: z.ZodType, isPart: boolean): z.ZodType {
  const rebuilt = (inner: unknown, isInnerPart = isPart): z.ZodType =>
    strict(inner as z.ZodType, isInnerPart);
  if (schema instanceof z.ZodObject) {
    const names = Object.keys(schema.shape);
    const fieldOf = (name: string): z.ZodType => {
      const field = rebuilt(schema.shape[name]);
      return isPart ? field.optional() : field;
    };
    const fields = Object.fromEntries(names.map((name) => [name, fieldOf(name)]));
    return z.strictObject(fields, { error: unknownName(names) });
  }
  if (schema instanceof z.ZodDefault) {
    const value = rebuilt(schema.unwrap());
    return isPart ? value : value.default(schema.def.defaultValue);
  }
  if (schema instanceof z.ZodOptional) return rebuilt(schema.unwrap()).optional();
  if (schema instanceof z.ZodNullable) return rebuilt(schema.unwrap()).nullable();
  if (schema instanceof z.ZodRecord)
    return schema.clone({ ...schema.def, valueType: rebuilt(schema.valueType, false) });
  if (schema instanceof z.ZodArray)
    return schema.clone({ ...schema.def, element: rebuilt(schema.element, false) });
  return schema;
}

/** Any part of a job's settings. A machine's profile is given as a whole. */
export const givenSettingsSchema = z.strictObject(
  {
    ...(strict(plotSettingsSchema.omit({ customMachine: true }), true) as z.ZodObject).shape,
    customMachine: machineProfileSchema.nullable().optional(),
  },
  { error: unknownName(Object.keys(plotSettingsSchema.shape)) },
) as unknown as z.ZodType<GivenSettings>;

export const givenPenSchema = strict(penSettingsSchema, true) as z.ZodType<GivenSettings["pen"]>;
export const givenMotionSchema = strict(motionSettingsSchema, true) as z.ZodType<GivenSettings["motion"]>;

/**
 * Complete settings for laying over others: fields that are left out are switched off explicitly. Otherwise those of the
 * settings below would stay.
 */
export const withOffs = <T extends Pick<GivenSettings, "pen" | "motion">>(settings: T): T => ({
  ...settings,
  ...(settings.pen && { pen: { ...offsIn(penSettingsSchema.shape), ...settings.pen } }),
  ...(settings.motion && { motion: { ...offsIn(motionSettingsSchema.shape), ...settings.motion } }),
});

/** The optional fields, switched off: null, or an empty table by layer. */
function offsIn(shape: z.ZodRawShape): Record<string, unknown> {
  const offs = Object.entries(shape).flatMap(([key, field]) => {
    const inner: unknown = field instanceof z.ZodOptional ? field.unwrap() : null;
    if (inner instanceof z.ZodNullable) return [[key, null]];
    return inner instanceof z.ZodRecord ? [[key, {}]] : [];
  });
  return Object.fromEntries(offs) as Record<string, unknown>;
}

/** What to say about a name that an object with these fields does not have: the setting that was probably meant. */
function unknownName(known: readonly string[]): z.core.$ZodErrorMap {
  return (issue) => {
    if (issue.code !== "unrecognized_keys") return undefined;
    const name = String((issue as z.core.$ZodIssueUnrecognizedKeys).keys[0]).slice(0, MAX_NAME);
    const meant = meantBy(name, known);
    return `there is no such setting${meant === undefined ? "" : ` (did you mean ${meant}?)`}`;
  };
}

/** Names come from outside, and may be long. */
const MAX_NAME = 60;

/** A name in this object, or the path of a setting: by its option, its own name, words for it, or a misspelt name. */
function meantBy(name: string, known: readonly string[]): string | undefined {
  const paths = settingPaths();
  const misspelt = nearest(name, paths.map(lastOf));
  return (
    nearest(name, known) ??
    SETTING_FLAGS.find(({ path, flag }) => flag === `--${name}` && paths.includes(path))?.path ??
    paths.find((path) => lastOf(path) === name) ??
    bestMatches(inWords(name), paths.map(searchedAt))[0]?.path ??
    paths.find((path) => lastOf(path) === misspelt)
  );
}

const lastOf = (path: string): string => path.split(".").at(-1) ?? "";

/** "extraLiftMs" as "extra Lift Ms"; an option that switches something off is known by what it switches. */
const inWords = (name: string): string => name.replace(/^no-/, "").replace(/([a-z])([A-Z])/g, "$1 $2");

function searchedAt(path: string): Searched & { readonly path: string } {
  const { flag = "", row } = SETTING_FLAGS.find((one) => one.path === path) ?? {};
  const words = `${row?.label ?? ""}, ${row ? wordsOf(row) : ""}`;
  return { path, label: inWords(`${path} ${flag}`), words, where: row ? aboutOf(row) : "" };
}

/** The paths of all settings; `*` is the id of a layer or the number of an entry. */
const settingPaths = (): string[] => pathsIn(plotSettingsSchema.omit({ customMachine: true }), []);

function pathsIn(schema: unknown, at: readonly string[]): string[] {
  if (schema instanceof z.ZodObject) {
    return Object.entries(schema.shape as z.ZodRawShape).flatMap(([key, field]) => {
      const path = [...at, key];
      return [path.join("."), ...pathsIn(field, path)];
    });
  }
  if (schema instanceof z.ZodRecord) return pathsIn(schema.valueType, [...at, "*"]);
  if (schema instanceof z.ZodArray) return pathsIn(schema.element, [...at, "*"]);
  const isWrapped =
    schema instanceof z.ZodDefault || schema instanceof z.ZodOptional || schema instanceof z.ZodNullable;
  return isWrapped ? pathsIn(schema.unwrap(), at) : [];
}

/** The known name with the fewest letters to change, in any case; none if that is more than every third letter. */
function nearest(name: string, known: readonly string[]): string | undefined {
  const distances = known.map((one) => editDistance(name.toLowerCase(), one.toLowerCase()));
  const least = Math.min(...distances);
  return least <= Math.max(1, name.length / 3) ? known[distances.indexOf(least)] : undefined;
}

/** Levenshtein distance, one row of its table at a time. */
function editDistance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, i) => i);
  for (let i = 0; i < a.length; i++) {
    const next = [i + 1];
    for (let j = 0; j < b.length; j++) {
      next.push(Math.min(next[j] + 1, row[j + 1] + 1, row[j] + (a[i] === b[j] ? 0 : 1)));
    }
    row = next;
  }
  return row[b.length];
}
