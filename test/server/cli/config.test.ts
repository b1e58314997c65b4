/** --config takes every setting of the schema, a job's own settings, and nothing else. */
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { z } from "zod";
import { settingsFromOptions } from "../../../server/cli/settings-options.js";
import { machineById, PlotwrightError, type MachineProfile } from "../../../src/index.js";
import {
  DEFAULT_PLOT_SETTINGS,
  machineProfileSchema,
  plotSettingsSchema,
} from "../../../src/schema/index.js";

let dir: string;
beforeAll(() => {
  dir = mkdtempSync(join(tmpdir(), "plotwright-config-"));
});
afterAll(() => rmSync(dir, { recursive: true, force: true }));

const settingsOf = (config: unknown) => {
  const file = join(dir, "config.json");
  writeFileSync(file, JSON.stringify(config));
  return settingsFromOptions({ config: file, data: dir });
};

type JsonSchema = z.core.JSONSchema.JSONSchema;
const SCHEMA = z.toJSONSchema(plotSettingsSchema, { io: "input", unrepresentable: "any" });

/** A valid value that is not the default, if there is one; objects are given completely. */
function valueFor(schema: JsonSchema, path: string): unknown {
  const options = schema.anyOf?.filter((one) => one.type !== "null");
  if (options?.[0] !== undefined) return valueFor(options[0], path);
  if (path === "customMachine") return machineProfileSchema.parse(machineById("nextdraw-8511"));
  if (path === "machine") return "nextdraw-8511";
  if (schema.enum) return schema.enum.find((one) => one !== schema.default);
  if (path.endsWith(".color")) return "#ff0000";
  switch (schema.type) {
    case "boolean":
      return schema.default !== true;
    case "string":
      return "a";
    case "number":
    case "integer":
      return numberFor(schema);
    case "array":
      return [valueFor(schema.items as JsonSchema, `${path}.0`)];
    default:
  }
  if (schema.properties === undefined) {
    return { ink: valueFor(schema.additionalProperties as JsonSchema, `${path}.ink`) };
  }
  return Object.fromEntries(
    Object.entries(schema.properties).map(([key, one]) => [
      key,
      valueFor(one as JsonSchema, `${path}.${key}`),
    ]),
  );
}

function numberFor({ minimum, exclusiveMinimum, maximum = 1_000, default: usual }: JsonSchema): number {
  const low = minimum ?? Number(exclusiveMinimum ?? 0);
  return usual === low + 1 ? Math.min(maximum, low + 2) : Math.min(maximum, low + 1);
}

/** Each setting with its path: the fields of objects, also of those that may be null; tables and lists as a whole. */
function settingsIn(schema: JsonSchema, path = ""): (readonly [path: string, schema: JsonSchema])[] {
  const whole = schema.anyOf?.find((one) => one.properties) ?? schema;
  const isNullable = whole !== schema;
  const fields = Object.entries(whole.properties ?? {}).flatMap(([key, one]) =>
    settingsIn(one as JsonSchema, path === "" ? key : `${path}.${key}`),
  );
  const isTogether = ["customMachine", "prepare.reach"].includes(path);
  if (fields.length === 0 || isTogether) return [[path, schema]];
  return isNullable ? [[path, schema], ...fields] : fields;
}

const at = (path: string, value: unknown): unknown =>
  path.split(".").reduceRight<unknown>((inner, key) => ({ [key]: inner }), value);
const read = (value: unknown, path: string): unknown =>
  path.split(".").reduce<unknown>((inner, key) => (inner as Record<string, unknown>)[key], value);

const SETTINGS = settingsIn(SCHEMA);

describe("--config", () => {
  it("is tried with all settings of the schema", () => {
    expect(SETTINGS.length).toBeGreaterThan(75);
    expect(SETTINGS.map(([path]) => path)).toEqual(
      expect.arrayContaining([
        "layerPens",
        "layerStops",
        "prepare.layerRepeats",
        "motion.layers",
        "pen.layers",
        "motion.ease",
        "motion.speedXMmPerS",
        "pen.liftPctPerS",
      ]),
    );
  });

  it.each(SETTINGS)("takes %s, alone", (path, schema) => {
    const value = valueFor(schema, path);
    const settings = settingsOf(at(path, value));
    expect(read(settings, path)).toEqual(value);
    // All others stay as they are: without this one, the settings are those without a file.
    const [top, group] = path.split(".");
    const others = Object.keys(DEFAULT_PLOT_SETTINGS).filter((key) => key !== top);
    // A profile alone names the machine.
    const base =
      path === "customMachine"
        ? { ...DEFAULT_PLOT_SETTINGS, machine: (value as MachineProfile).id }
        : DEFAULT_PLOT_SETTINGS;
    for (const key of others) {
      expect([key, read(settings, key)]).toEqual([key, read(base, key)]);
    }
    if (group === undefined) return;
    const inGroup = { ...(read(settings, top) as object), [group]: null };
    expect(inGroup).toEqual({ ...(read(DEFAULT_PLOT_SETTINGS, top) as object), [group]: null });
  });

  it.each(SETTINGS)("refuses a misspelt %s with its path and the known name", (path, schema) => {
    const misspelt = `${path}s`;
    const refusal = (): unknown => settingsOf(at(misspelt, valueFor(schema, path)));
    expect(refusal).toThrow(PlotwrightError);
    expect(refusal).toThrow(`: ${misspelt}: there is no such setting (did you mean `);
  });

  it("refuses unknown names inside lists and tables by layer", () => {
    for (const [config, words] of [
      [{ motion: { layers: { ink: { speed: 3 } } } }, "motion.layers.ink.speed: there is no such setting"],
      [{ prepare: { layerHatches: [{ layer: "a", spacing: 3 }] } }, "prepare.layerHatches.0.spacing"],
      [{ upPct: 3 }, "did you mean pen.upPct?"],
    ] as const) {
      expect(() => settingsOf(config)).toThrow(words);
    }
  });

  it("takes a job's own settings as they are stored", () => {
    const all = Object.fromEntries(
      Object.entries(SCHEMA.properties ?? {}).map(([key, one]) => [key, valueFor(one as JsonSchema, key)]),
    );
    const job = plotSettingsSchema.parse({ ...all, machine: "nextdraw-8511" });
    expect(settingsOf(job)).toEqual(job);
    expect(settingsOf(DEFAULT_PLOT_SETTINGS)).toEqual(DEFAULT_PLOT_SETTINGS);
  });
});
