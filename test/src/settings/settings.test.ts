import { readFileSync } from "node:fs";
import path from "node:path";
import { describe, expect, it } from "vitest";
import { settingsTable } from "../../../scripts/settings-table.js";
import { SETTINGS_TYPES_FILE, settingsTypes } from "../../../scripts/settings-types.js";
import { DEFAULT_PLOT_SETTINGS, plotSettingsSchema } from "../../../src/schema/index.js";
import { isSameJson } from "../../../src/settings/partial.js";
import { isAllowed, rangeInWords, type NumberSetting } from "../../../src/settings/setting.js";
import { SETTINGS_TABLES } from "../../../src/settings/tables.js";

const valueAt = (settings: unknown, at: string): unknown =>
  at.split(".").reduce<unknown>((value, key) => (value as Record<string, unknown>)[key], settings);

/** The default settings with one value changed. */
function withValue(path: string, value: unknown): unknown {
  const settings = structuredClone(DEFAULT_PLOT_SETTINGS) as unknown as Record<string, unknown>;
  const keys = path.split(".");
  const parent = keys
    .slice(0, -1)
    .reduce<Record<string, unknown>>((at, key) => at[key] as Record<string, unknown>, settings);
  parent[keys.at(-1)!] = value;
  return settings;
}

const accepts = (at: string, value: unknown): boolean =>
  plotSettingsSchema.safeParse(withValue(at, value)).success;

const rows = Object.entries(SETTINGS_TABLES).flatMap(([at, table]) =>
  Object.entries(table).map(([key, row]) => [at === "" ? key : `${at}.${key}`, row] as const),
);
const numbers = rows.flatMap(([at, row]) => (row.kind === "number" ? [[at, row] as const] : []));

describe("the settings tables", () => {
  it.each(rows)("give %s its default", (at, row) => {
    expect(valueAt(DEFAULT_PLOT_SETTINGS, at)).toBe(row.default);
  });

  it.each(numbers)("give the schema the range of %s", (at, row) => {
    const justAbove = row.isWhole ? row.max + 1 : row.max * 1.001 + 0.001;
    const justBelow = row.isWhole ? row.min - 1 : row.min - 0.001;
    expect(accepts(at, row.max)).toBe(true);
    expect(accepts(at, justAbove)).toBe(false);
    expect(accepts(at, justBelow)).toBe(false);
    expect(accepts(at, row.min)).toBe(row.minExcluded !== true);
  });

  it("have the types that `npm run docs` writes", async () => {
    expect(readFileSync(SETTINGS_TYPES_FILE, "utf8")).toBe(await settingsTypes());
  });

  it("fill in what an older version did not store", () => {
    const stored = { ...DEFAULT_PLOT_SETTINGS, prepare: {}, pen: { upPct: 70 } };
    const parsed = plotSettingsSchema.parse(stored);
    expect(parsed.prepare).toEqual(DEFAULT_PLOT_SETTINGS.prepare);
    expect(parsed.pen).toEqual({ ...DEFAULT_PLOT_SETTINGS.pen, upPct: 70 });
  });

  it("do not fill in what a layer leaves to the common settings", () => {
    const motion = { ...DEFAULT_PLOT_SETTINGS.motion, layers: { ink: { speedMmPerS: 20 } } };
    const parsed = plotSettingsSchema.parse({ ...DEFAULT_PLOT_SETTINGS, motion });
    expect(parsed.motion.layers).toEqual({ ink: { speedMmPerS: 20 } });
  });

  it("explain in words what is allowed", () => {
    const row: NumberSetting = { kind: "number", label: "", default: 1, min: 0, max: 5, unit: "mm", step: 1 }; // prettier-ignore
    expect(rangeInWords(row)).toBe("0 to 5 mm");
    expect(rangeInWords({ ...row, minExcluded: true })).toBe("more than 0, up to 5 mm");
    expect(rangeInWords({ ...row, isWhole: true, unit: "" })).toBe("a whole number, 0 to 5");
    expect([0, 5, 5.1, -0.1, NaN].map((value) => isAllowed(row, value))).toEqual([
      true,
      true,
      false,
      false,
      false,
    ]);
  });
});

describe("two settings", () => {
  const layered = (layers: unknown) => ({ pen: { upPct: 60 }, layers });

  it.each([
    ["another order of fields", { a: 1, b: [1, { c: 2, d: null }] }, { b: [1, { d: null, c: 2 }], a: 1 }],
    ["a field that is undefined", { a: 1, b: undefined }, { a: 1 }],
    ["a layer named like a part of each object", layered({ constructor: 1 }), layered({ constructor: 1 })],
  ])("are the same with %s", (_what, one, other) => {
    expect(isSameJson(one, other)).toBe(true);
    expect(isSameJson(other, one)).toBe(true);
  });

  it.each([
    ["another value", { a: 1 }, { a: 2 }],
    ["another order of a list", { a: [1, 2] }, { a: [2, 1] }],
    ["null in place of a missing field", { a: 1, b: null }, { a: 1 }],
    ["a list in place of a table", { a: ["x"] }, { a: { 0: "x" } }],
    ["another layer", layered({ constructor: 1 }), layered({ constructor: 2 })],
  ])("differ with %s", (_what, one, other) => {
    expect(isSameJson(one, other)).toBe(false);
    expect(isSameJson(other, one)).toBe(false);
  });
});

describe("docs/cli.md", () => {
  it("has the settings table that `npm run docs` writes", () => {
    const text = readFileSync(path.join(import.meta.dirname, "..", "..", "..", "docs", "cli.md"), "utf8");
    expect(text).toContain(settingsTable());
  });
});
