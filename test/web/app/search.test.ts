/** What the search finds for the words that people use. */
import { describe, expect, it } from "vitest";
import { aboutOf, wordsOf } from "../../../src/internal.js";
import { bestMatches, type Searched } from "../../../src/settings/matching.js";
import { SETTINGS_TABLES } from "../../../src/settings/tables.js";
import { PAGE_ACTIONS } from "../../../web/app/page-actions.js";
import { FIELDS } from "../../../web/search/fields.js";

const ENTRIES: readonly (Searched & { readonly id: string })[] = [
  ...PAGE_ACTIONS.map(({ id, label, words = "" }) => ({
    id,
    label: typeof label === "string" ? label : id,
    words,
    where: "",
  })),
  ...FIELDS.map(({ id, label, words, place }) => ({ id, label, words, where: place.panel.titles.join(" ") })),
];
const found = (typed: string): readonly string[] => bestMatches(typed, ENTRIES).map(({ id }) => id);

describe("the search", () => {
  it.each([
    ["pen down delay", "pen Extra wait after lowering"],
    ["pen up delay", "pen Extra wait after lifting"],
    ["acceleration", "details draw accelMmPerS2"],
    ["accel", "details draw accelMmPerS2"],
    ["speed", "details draw speedMmPerS"],
    ["inches", "paper Lengths in"],
    ["mirror", "paperMore Mirror"],
    ["flip", "paperMore Mirror"],
    ["dpi", "paper Resolution of the file"],
    ["jerk", "details Softness"],
    ["input shaping", "details Reduce ringing"],
    ["hatching", "fill Fill areas with lines"],
    ["home", "home"],
    ["Turn paper", "turn-paper"],
    ["dark mode", "theme"],
    ["PEN  DOWN-DELAY ", "pen Extra wait after lowering"],
  ])("finds first, for “%s”, %s", (typed, id) => {
    expect(found(typed)[0]).toBe(id);
  });

  it.each([
    ["servo", ["hand Height up", "hand Height down", "pen Extra wait after lowering", "wizard"]],
    ["landscape", ["paper Orientation", "turn-paper"]],
    ["speed", ["details travel speedMmPerS", "panel motion"]],
    ["delay", ["pen Extra wait after lifting", "pen Extra wait after lowering"]],
    ["optimi", ["lines Order of strokes"]],
  ])("finds for “%s” %j", (typed, ids) => {
    expect(found(typed)).toEqual(expect.arrayContaining([...ids]));
  });

  it("finds nothing for a word that nothing has, also beside one that is known", () => {
    expect(found("zebra")).toEqual([]);
    expect(found("speed zebra")).toEqual([]);
  });

  it("lists everything before anything is typed", () => {
    expect(found("")).toHaveLength(ENTRIES.length);
    expect(found("  ")).toHaveLength(ENTRIES.length);
  });

  it("names each entry once", () => {
    expect(new Set(ENTRIES.map(({ id }) => id)).size).toBe(ENTRIES.length);
  });
});

/** Rows that the page shows under another name. */
const RENAMED: Readonly<Record<string, string>> = {
  "prepare.landscape": "Orientation",
  "prepare.fit": "Size of the drawing",
};
/** Rows that only the command line and files have. */
const NOT_ON_PAGE: readonly string[] = ["prepare.reinkMm", "motion.travel.cornerMm"];

describe("every setting of the tables", () => {
  const rows = Object.entries(SETTINGS_TABLES).flatMap(([at, table]) =>
    Object.entries(table).map(([key, row]) => ({ path: at === "" ? key : `${at}.${key}`, row })),
  );
  const shown = rows.filter(({ path }) => !NOT_ON_PAGE.includes(path));

  it.each(shown)("is found by its name: $path", ({ path, row }) => {
    const label = RENAMED[path] ?? row.label;
    const fields = FIELDS.filter((field) => field.label === label);
    const expected = path in RENAMED ? wordsOf(row) || aboutOf(row) : aboutOf(row);
    expect(fields.map(({ words }) => words)).toContainEqual(expect.stringContaining(expected));
  });
});
