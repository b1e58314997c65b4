/** Ctrl K: from a word to the field or the action, by keyboard alone. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { FIELDS } from "../../../web/search/fields.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore } from "../../../web/state/store.js";
import { seriousFindings } from "../../support/browser/axe.js";
import { IS_FULL } from "../../support/runs/full-run.js";
import { PageTest } from "../../support/browser/page-test.js";

const LIMIT_MS = 120_000;

/** A first visit. */
const STATE = {
  ...createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW }).getState(),
  link: "connected" as const,
};

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("search");
});

afterAll(async () => test.close());

const box = () => test.page.getByRole("combobox", { name: "Search for anything" });
const options = () => test.page.getByRole("listbox", { name: "Results" }).getByRole("option");

/** Opens the search, and types. */
async function search(words: string): Promise<void> {
  // The last search may still be closing, and would take the keys.
  await box().waitFor({ state: "detached" });
  await test.page.keyboard.press("Control+k");
  await box().waitFor();
  await test.page.keyboard.type(words);
}

/** Name and value of what has the focus. */
const focused = () =>
  test.page.evaluate(() => {
    const element = document.activeElement as HTMLInputElement;
    // Nothing has the focus. The body's text has the names of all fields.
    if (element === document.body) return { name: "", legend: "" };
    const label = element.labels?.[0]?.textContent ?? element.textContent ?? "";
    const group = element.closest("[role=group]")?.firstElementChild?.textContent;
    const legend = element.closest("fieldset")?.querySelector("legend")?.textContent ?? "";
    return { name: element.type === "radio" ? (group ?? legend) : label, legend };
  });

/** Waits until a control of that name has the focus, and is under that legend. */
const waitForFocus = async (name: string, legend = ""): Promise<void> => {
  const patience = { timeout: 30_000 };
  await expect
    .poll(focused, patience)
    .toEqual({ name: expect.stringContaining(name), legend: expect.stringContaining(legend) });
};

describe("the search", () => {
  it("goes from the load to the field: Ctrl K, “pen down delay”, Enter", async () => {
    await test.page.reload();
    await test.planned();
    await search("pen down delay");
    await test.page.keyboard.press("Enter");
    await waitForFocus("Extra wait after lowering");
    await box().waitFor({ state: "detached" });
    await test.page.keyboard.type("420");
    await test.page.keyboard.press("Tab");
    expect(await test.field("Extra wait after lowering").inputValue()).toContain("420");
  });

  it("opens folded details, and tells two fields of one name apart", async () => {
    await search("acceleration");
    await test.page.keyboard.press("Enter");
    await waitForFocus("Acceleration", "Pen down");
    await search("acceleration pen up");
    await test.page.keyboard.press("Enter");
    await waitForFocus("Acceleration", "Pen up");
  });

  it("performs an action, which can be undone by its own name", async () => {
    const orientation = async () =>
      test.page.getByRole("radio", { name: "Portrait", exact: true }).isChecked();
    await test.panel("Paper");
    const before = await orientation();
    await search("turn paper");
    await test.page.keyboard.press("Enter");
    await expect.poll(orientation).toBe(!before);
    await search("undo");
    await test.page.keyboard.press("Enter");
    await expect.poll(orientation).toBe(before);
  });

  it("moves the plotter home", async () => {
    const asked = test.page.waitForRequest((request) => request.url().endsWith("/home"));
    await search("home");
    expect(await options().first().innerText()).toContain("Home");
    await test.page.keyboard.press("Enter");
    await asked;
  });

  it("says why an action is off, and does not perform it", async () => {
    await search("pause the plot");
    const pause = options().first();
    expect(await pause.getAttribute("aria-disabled")).toBe("true");
    expect(await pause.innerText()).toContain("No plot is running.");
    await test.page.keyboard.press("Enter");
    await box().waitFor();
    await test.page.keyboard.press("Escape");
  });

  it("gives the focus back at Escape, also to a field in which one types", async () => {
    await test.panel("Paper");
    await test.field("Margin").focus();
    await search("speed");
    await test.page.keyboard.press("Escape");
    await box().waitFor({ state: "detached" });
    expect((await focused()).name).toBe("Margin");
    const button = test.page.getByRole("button", { name: "Search for anything" });
    await button.click();
    await box().waitFor();
    await test.page.keyboard.press("Escape");
    await box().waitFor({ state: "detached" });
    expect(await button.evaluate((element) => element === document.activeElement)).toBe(true);
  });

  it("is a combobox without faults that arrow keys lead through", async () => {
    await search("speed");
    expect(await seriousFindings(test.page)).toEqual([]);
    const chosen = () => box().getAttribute("aria-activedescendant");
    const [first, second] = await Promise.all([0, 1].map((at) => options().nth(at).getAttribute("id")));
    expect(await chosen()).toBe(first);
    await test.page.keyboard.press("ArrowDown");
    expect(await chosen()).toBe(second);
    expect(await options().nth(1).getAttribute("aria-selected")).toBe("true");
    await test.page.keyboard.press("ArrowUp");
    await test.page.keyboard.press("ArrowUp");
    expect(await chosen()).toBe(await options().last().getAttribute("id"));
    await test.page.keyboard.type(" zebra");
    await test.page.getByText("Nothing is called “speed zebra”").waitFor();
    await test.page.keyboard.press("Escape");
  });

  it(
    IS_FULL ? "leads to every setting that it lists" : "leads to settings of all panels",
    async () => {
      for (const [index, field] of FIELDS.entries()) {
        if (field.whyOff?.(STATE) || (!IS_FULL && index % 5 !== 0)) continue;
        const { control, panel, legend } = field.instead?.(STATE) ?? field.place;
        await search(field.label);
        const where = [...field.place.panel.titles, ...(field.place.legend ? [field.place.legend] : [])];
        const way = control === null ? where.slice(0, -1) : where;
        await options()
          .filter({ has: test.page.getByText(field.label, { exact: true }) })
          .filter({ hasText: way.join(" › ") })
          .first()
          .click();
        await box().waitFor({ state: "detached" });
        await waitForFocus(control ?? panel.titles.at(-1) ?? "", legend ?? "");
      }
    },
    10 * LIMIT_MS,
  );

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
