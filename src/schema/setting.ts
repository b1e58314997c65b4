/** Builds schemas from the settings tables. Their descriptions are shown by the HTTP reference and OpenAPI. */
import { z } from "zod";
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

export function numberSchema(row: NumberSetting): z.ZodNumber {
  const error = `it must be ${rangeInWords(row)}`;
  const number = row.isWhole ? z.int({ error }) : z.number({ error });
  const fromMin = row.minExcluded ? number.gt(row.min, { error }) : number.min(row.min, { error });
  return fromMin.max(row.max, { error }).describe(row.about);
}

export function schemaOf(row: Setting): z.ZodType {
  if (takesAuto(row)) return orAuto(row).describe(row.about);
  if (row.kind === "number") return numberSchema(row);
  return (row.kind === "switch" ? z.boolean() : z.enum(row.choices)).describe(row.about);
}

function orAuto(row: Setting): z.ZodType {
  const error = `it must be ${orAutoInWords(row)}`;
  return z.union([row.kind === "number" ? numberSchema(row) : z.boolean(), z.literal(AUTO)], { error });
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
