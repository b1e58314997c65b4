/** Builds schemas from the settings tables. Their descriptions are shown by the HTTP reference and OpenAPI. */
import { z } from "zod";
import { aboutOf } from "../settings/texts.js";
import {
  AUTO,
  orAutoInWords,
  rangeInWords,
  takesAuto,
  type NumberSetting,
  type Setting,
  type SettingsTable,
  type ValuesOf,
} from "../settings/setting.js";

/** `about`: what it does, in a phrase. */
export function numberSchema(row: NumberSetting, about = aboutOf(row)): z.ZodNumber {
  const error = `it must be ${rangeInWords(row)}`;
  const number = row.isWhole ? z.int({ error }) : z.number({ error });
  const fromMin = row.minExcluded ? number.gt(row.min, { error }) : number.min(row.min, { error });
  return fromMin.max(row.max, { error }).describe(about);
}

export function schemaOf(row: Setting, about = aboutOf(row)): z.ZodType {
  if (takesAuto(row)) return orAuto(row, about).describe(about);
  if (row.kind === "number") return numberSchema(row, about);
  return (row.kind === "switch" ? z.boolean() : z.enum(row.choices)).describe(about);
}

function orAuto(row: Setting, about: string): z.ZodType {
  const error = `it must be ${orAutoInWords(row)}`;
  return z.union([row.kind === "number" ? numberSchema(row, about) : z.boolean(), z.literal(AUTO)], {
    error,
  });
}

type ShapeOf<Table extends SettingsTable> = {
  [K in keyof Table]: z.ZodType<ValuesOf<Table>[K], ValuesOf<Table>[K]>;
};
type ShapeWithDefaults<Table extends SettingsTable> = {
  [K in keyof Table]: z.ZodDefault<z.ZodType<ValuesOf<Table>[K], ValuesOf<Table>[K]>>;
};

export const shapeOf = <Table extends SettingsTable>(table: Table): ShapeOf<Table> =>
  Object.fromEntries(Object.entries(table).map(([key, row]) => [key, schemaOf(row)])) as ShapeOf<Table>;

export const shapeWithDefaults = <Table extends SettingsTable>(table: Table): ShapeWithDefaults<Table> =>
  Object.fromEntries(
    Object.entries(table).map(([key, row]) => [key, schemaOf(row).default(row.default)]),
  ) as ShapeWithDefaults<Table>;
