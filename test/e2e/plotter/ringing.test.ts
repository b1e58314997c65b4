/** Measuring the plotter's swing by the two ringing sheets, from the first plot to a faster plan. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Job } from "../../../src/schema/index.js";
import { machineListSchema, snapshotSchema } from "../../../src/schema/index.js";
import { seriousFindings } from "../../support/browser/axe.js";
import { PageTest } from "../../support/browser/page-test.js";

const PATIENCE_MS = 120_000;
/** Six plots: on a computer as busy as the limit of one test allows for, they take longer than that. */
const SIX_PLOTS_MS = 300_000;
const DRAWING = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100"><path d="M10 10h80v80" fill="none" stroke="#0a0"/></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.firstVisit("ringing", {}, ["--virtual-speed", "60"]);
  await test.drop("mine", DRAWING);
}, PATIENCE_MS);

afterAll(async () => test.close());

const dialog = () => test.page.getByRole("dialog", { name: "Measure ringing" });
const named = async (name: RegExp): Promise<Job[]> =>
  (await test.jobs()).filter((job) => name.test(job.name));
const api = async (path: string): Promise<unknown> =>
  (await fetch(`${test.server.url}/api/v1${path}`)).json();

/** From now on the page records what the button in the dialog says, even if it says so only for a moment. */
const noteButtonWords = (): Promise<void> =>
  dialog().evaluate((element) => {
    const words: string[] = [];
    (window as unknown as { buttonWords: string[] }).buttonWords = words;
    new MutationObserver(() => {
      words.push(element.querySelector(".button-primary")?.textContent ?? "");
    }).observe(element, { subtree: true, childList: true, characterData: true });
  });
const notedButtonWords = (): Promise<string[]> =>
  test.page.evaluate(() => (window as unknown as { buttonWords: string[] }).buttonWords);

describe("the ringing sheet", () => {
  it("is plotted as one small job, and leaves the drawing on the paper", async () => {
    const { page } = test;
    await page
      .getByRole("region", { name: "Plotter" })
      .getByRole("button", { name: "Measure ringing…" })
      .click();
    await dialog().getByRole("button", { name: "Plot the ringing sheet" }).click();
    await expect.poll(async () => (await named(/^Ringing sheet$/))[0]?.state).toBe("done");
    const [job] = await named(/^Ringing sheet$/);
    expect(job.settings.motion).toMatchObject({ mode: "junction", shaper: "none" });
    const { strokes } = { strokes: await test.strokesOf(job) };
    expect(strokes.offsets.length - 1).toBe(6);
    const { xy } = strokes;
    const width = (k: 0 | 1): number => {
      const places = [...xy].filter((_, i) => i % 2 === k);
      return Math.max(...places) - Math.min(...places);
    };
    expect([width(0), width(1)]).toEqual([expect.closeTo(60, 6), expect.closeTo(40, 6)]);
    await dialog().getByRole("button", { name: "Plot the ringing sheet" }).waitFor();
    expect(await page.getByText("mine", { exact: true }).first().isVisible()).toBe(true);
  });

  it("turns ripples into a frequency, and shows the benefit", async () => {
    await dialog().getByLabel("Ripples, x").fill("30");
    await dialog().getByLabel("Their length, x").fill("10");
    await dialog().getByText("count again, near the bend", { exact: false }).waitFor();
    await dialog().getByLabel("Ripples, x").fill("2");
    await dialog().getByLabel("Their length, x").fill("20");
    await dialog().getByText("15.2 Hz", { exact: true }).waitFor();
    const store = dialog().getByRole("button", { name: "Save for this plotter" });
    expect(await store.isDisabled()).toBe(true);
    await dialog().getByLabel("Ripples, y").fill("3");
    // The picture numbers as many ripples as were counted.
    const ofY = dialog().getByRole("group", { name: "Front-to-back ringing (y)" });
    await expect.poll(() => ofY.locator(".ripple-picture text").allTextContents()).toEqual(["1", "2", "3"]);
    await dialog().getByLabel("Their length, y").fill("18");
    await dialog().getByText("25.1 Hz", { exact: true }).waitFor();
    // The swing of y moves the crests of x a little.
    await dialog().getByText("15 Hz", { exact: true }).waitFor();
    await dialog().getByRole("radio", { name: "Quickly" }).check();
    await dialog().getByText("25.3 Hz", { exact: true }).waitFor();
    const row = dialog().getByRole("row", { name: /^Fast/ });
    expect(await row.innerText()).toMatch(/s \(−[234]\d %\)\s+0\.\d\d? mm/);
    for (const colorScheme of ["light", "dark"] as const) {
      await test.page.emulateMedia({ colorScheme });
      expect(await seriousFindings(test.page)).toEqual([]);
    }
    await test.page.emulateMedia({ colorScheme: "light" });
  });

  it("stores it with the plotter's machine on the server", async () => {
    await dialog().getByRole("button", { name: "Save for this plotter" }).click();
    await dialog().getByText("Saved: 15.1 Hz along x, 25.3 Hz along y.").waitFor();
    const { machines } = machineListSchema.parse(await api("/machines"));
    const mine = machines.find(({ builtIn }) => !builtIn);
    expect(mine).toMatchObject({
      name: "AxiDraw V3, measured",
      springs: { xHz: 15.1, yHz: 25.3, damping: 0.08 },
    });
    await expect
      .poll(async () => snapshotSchema.parse(await api("/state")).plotters[0].machine)
      .toBe(mine?.id);
  });
});

describe("the second sheet", () => {
  it(
    "plots six lines one after the other, each shaped for another frequency",
    async () => {
      await dialog().getByRole("radio", { name: "Pick by eye" }).check();
      await noteButtonWords();
      await dialog().getByRole("button", { name: "Plot the six lines" }).click();
      await expect
        .poll(async () => (await named(/^Ringing, /)).filter(({ state }) => state === "done").length, {
          timeout: 0.75 * SIX_PLOTS_MS,
        })
        .toBe(6);
      await dialog().getByRole("button", { name: "Plot the six lines" }).waitFor();
      // A busy computer may show only a later one.
      expect(await notedButtonWords()).toContainEqual(expect.stringMatching(/^Plotting line [1-6] of 6…$/));
      const jobs = await named(/^Ringing, /);
      const swings = jobs.map(({ settings }) => settings.customMachine?.springs?.xHz ?? 0);
      expect([...swings].sort((a, b) => a - b)).toEqual(
        [0, 12.08, 13.59, 15.1, 16.61, 18.875].map((hz) => expect.closeTo(hz, 6) as number),
      );
      expect(jobs.filter(({ settings }) => settings.motion.shaper === "zv")).toHaveLength(5);
    },
    SIX_PLOTS_MS,
  );

  it("takes the line that is clicked", async () => {
    await dialog().getByRole("radio", { name: "16.6 / 27.8 Hz" }).check();
    await dialog().getByText("Saved: 16.6 Hz along x, 27.8 Hz along y.").waitFor();
    expect(await dialog().getByRole("radio", { name: "16.6 / 27.8 Hz" }).isChecked()).toBe(true);
    // The lines stay those that were plotted.
    await dialog().getByRole("radio", { name: "15.1 / 25.3 Hz" }).waitFor();
    await test.page.setViewportSize({ width: 390, height: 844 });
    expect(await test.page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    await test.page.setViewportSize({ width: 1440, height: 900 });
    await test.page.keyboard.press("Escape");
    await test.panel("Speed");
    await test.page.locator("#group-motion").getByText("16.6 Hz along x", { exact: false }).waitFor();
    // The quality stays Normal, and uses what was measured.
    expect(await test.page.getByRole("radio", { name: "Normal" }).isChecked()).toBe(true);
    const { settings } = await test.queue();
    expect(settings.motion.shaper).toBe("zv");
    expect(settings.customMachine?.springs).toEqual({ xHz: 16.6, yHz: 27.8, damping: 0.08 });
    expect(test.complaints).toEqual([]);
  });
});
