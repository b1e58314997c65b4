/** Queue, settings and recovery: the same with plotwright's server and without one. */
import { text } from "node:stream/consumers";
import type { Browser, Locator, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { BACKENDS, startPage, type StartedPage } from "../../support/browser/backends.js";
import { launchBrowser } from "../../support/browser/browser.js";
import { IS_FULL } from "../../support/runs/full-run.js";
import {
  dropFile,
  historyPanel,
  openGroup,
  openPanel,
  openView,
  plotBar,
  queuePanel,
  statusCard,
  waitForPlan,
} from "../../support/browser/page-actions.js";

const PATIENCE_MS = 90_000;

/** Long lines that do not touch each other. */
const comb = (lines: number): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="150mm" viewBox="0 0 150 150" fill="none" stroke="black">${Array.from(
    { length: lines },
    (_, i) => `<path d="M20 ${20 + 3 * i}h100"/>`,
  ).join("")}</svg>`;

let browser: Browser;
beforeAll(async () => {
  browser = await launchBrowser();
});
afterAll(() => browser.close());

async function lay(page: Page, name: string, lines: number): Promise<void> {
  await dropFile(page, `${name}.svg`, comb(lines));
  await page.getByText(name, { exact: true }).first().waitFor({ state: "attached" });
  await waitForPlan(page);
}

/** Names of the waiting jobs, in their order. */
const waiting = (page: Page): Promise<string[]> =>
  queuePanel(page)
    .getByRole("button", { name: /^More for / })
    .evaluateAll((buttons) =>
      buttons.map((button) => (button.getAttribute("aria-label") ?? "").slice("More for ".length)),
    );

const expectWaiting = (page: Page, names: readonly string[]): Promise<void> =>
  expect.poll(() => waiting(page), { timeout: PATIENCE_MS }).toEqual(names);

const expectState = (page: Page, words: RegExp): Promise<void> =>
  expect.poll(() => page.locator(".machine-state").innerText(), { timeout: PATIENCE_MS }).toMatch(words);

const openMenu = (page: Page, name: string): Promise<void> =>
  queuePanel(page)
    .getByRole("button", { name: `More for ${name}` })
    .click();

async function choose(page: Page, name: string, what: string): Promise<void> {
  await openMenu(page, name);
  await page.getByRole("button", { name: `${what} ${name}` }).click();
}

/** The commands for heights of 22 and 77 %. */
const SERVOS = [
  { label: "NextDraw 8511", model: "nextdraw-8511", commands: ["S2,6984,5", "S2,10944,5"] },
  { label: "AxiDraw V3/A3", model: "axidraw-v3-a3", commands: ["SC,5,12010", "SC,4,23285"] },
].slice(0, IS_FULL ? 2 : 1);

/** Other tests of `npm test` (story, machine, interrupted) have a server. */
const CHECKED = IS_FULL ? BACKENDS : (["browser"] as const);

describe.each(CHECKED)("the page's backend %s", (backend) => {
  let started: StartedPage;
  beforeEach(async () => {
    started = await startPage(backend, browser);
  });
  afterEach(() => started.close());

  it("keeps the queue, its order and the history", { timeout: 300_000 }, async () => {
    let { page } = started;
    await openPanel(page, "Queue");
    for (const [name, lines] of [
      ["one", 1],
      ["two", 2],
      ["three", 3],
    ] as const) {
      await lay(page, name, lines);
      await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
      await expect.poll(() => waiting(page), { timeout: PATIENCE_MS }).toContain(name);
    }
    await choose(page, "three", "Move earlier:");
    await expectWaiting(page, ["one", "three", "two"]);
    // A waiting job is changed on the paper, and saved at its place.
    await choose(page, "three", "Open");
    await waitForPlan(page);
    await openPanel(page, "Paper");
    await page.getByRole("radio", { name: "Portrait" }).check();
    await waitForPlan(page);
    const save = plotBar(page).getByRole("button", { name: "Save the changes to three in the queue" });
    await save.click();
    await save.waitFor({ state: "detached" });
    // Two more of it.
    await openPanel(page, "Queue");
    await choose(page, "three", "Duplicate");
    await queuePanel(page).getByLabel("2 copies").waitFor();
    await started.killAndReopen();
    ({ page } = started);
    await openPanel(page, "Queue");
    await expectWaiting(page, ["one", "three", "two"]);
    await queuePanel(page).getByLabel("2 copies").waitFor();
    await choose(page, "three", "Open");
    await openPanel(page, "Paper");
    await expect.poll(() => page.getByRole("radio", { name: "Portrait" }).isChecked()).toBe(true);
    await openPanel(page, "Queue");
    await openMenu(page, "three");
    await page.getByRole("button", { name: "Remove all 2" }).click();
    await expectWaiting(page, ["one", "two"]);
    await queuePanel(page).getByRole("button", { name: "Start one" }).click();
    await openView(page, "Prepare");
    await historyPanel(page).getByText("Done", { exact: true }).waitFor();
    await started.killAndReopen();
    ({ page } = started);
    await openPanel(page, "Queue");
    await expectWaiting(page, ["two"]);
    await historyPanel(page).getByText("Done", { exact: true }).waitFor();
    await historyPanel(page).getByRole("button", { name: "Plot again: one" }).click();
    await expectWaiting(page, ["two", "one"]);
  });

  it(
    "keeps a drawing's true size, and asks about one that leaves the paper",
    { timeout: 300_000 },
    async () => {
      const { page } = started;
      const size = () =>
        expect.poll(async () => (await page.locator(".drawn-size span").innerText()).replace(/\u202f/g, " "));
      const plot = plotBar(page).getByRole("button", { name: "Plot", exact: true });
      // A line of 100 mm on a page of 150 mm.
      await lay(page, "true size", 1);
      await size().toBe("Drawn 100 × 0 mm, 100 %");
      await expect.poll(() => plot.isEnabled()).toBe(true);
      const wide = `<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210"><path stroke="black" d="M10 20H330"/></svg>`;
      await dropFile(page, "wide.svg", wide);
      await plotBar(page)
        .getByText(/off the paper/)
        .waitFor();
      expect(await plot.isDisabled()).toBe(true);
      await page.getByRole("button", { name: "Cut", exact: true }).click();
      await size().toBe("Drawn 287.5 × 0 mm, 100 %");
      await expect.poll(() => plot.isEnabled()).toBe(true);
    },
  );

  it.each(SERVOS)(
    "plots on $label with the plotter's heights, by the commands that reach the board",
    { timeout: 300_000 },
    async ({ label, model, commands }) => {
      const { page } = started;
      await openGroup(page, "Plotter", "Model and position");
      await page.getByLabel("Model", { exact: true }).selectOption({ label });
      for (const [which, pct] of [
        ["down", "22"],
        ["up", "77"],
      ] as const) {
        const height = page.getByLabel(`Height ${which}`, { exact: true });
        await height.fill(pct);
        await height.blur();
      }
      await expect
        .poll(() => started.storedPlotters(), { timeout: PATIENCE_MS })
        .toMatch(new RegExp(`(?=.*"upPct":77\\b)(?=.*"downPct":22\\b)(?=.*"${model}")`, "s"));
      await lay(page, "one", 1);
      await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
      await historyPanel(page).getByText("Done", { exact: true }).waitFor({ timeout: PATIENCE_MS });
      await openPanel(page, "Plotter");
      const download = page.waitForEvent("download");
      await page.getByRole("button", { name: "Save the connection log" }).click();
      const log = await text(await (await download).createReadStream());
      const sent = Array.from(log.matchAll(/\b(?:SC,[45],\d+|S2,\d+,\d+)/g), ([command]) => command);
      expect(new Set(sent)).toEqual(new Set(commands));
    },
  );

  it("keeps the plotter's model, heights and presets", { timeout: 300_000 }, async () => {
    let { page } = started;
    await lay(page, "one", 1);
    await openGroup(page, "Plotter", "Model and position");
    await page.getByLabel("Model", { exact: true }).selectOption({ label: "AxiDraw V3/A3" });
    await openGroup(page, "Speed", "Presets");
    await page.getByLabel("Name of this preset").fill("fine liner");
    await page.getByRole("button", { name: "Save", exact: true }).click();
    await page.getByText("fine liner").first().waitFor();
    const stored = () => expect.poll(() => started.storedPlotters(), { timeout: PATIENCE_MS });
    const height = (which: string): Locator => page.getByLabel(`Height ${which}`, { exact: true });
    await openPanel(page, "Plotter");
    for (const [which, pct] of [
      ["down", "22"],
      ["up", "77"],
    ] as const) {
      await height(which).fill(pct);
      await height(which).blur();
    }
    // Changes of the plotter's settings are stored a moment later. The preset has 60 % too.
    await stored().toMatch(/"upPct":77\b/);
    await page.getByRole("button", { name: "Undo" }).click();
    await expect.poll(() => height("up").inputValue()).toBe("60");
    await stored().not.toMatch(/"upPct":77\b/);
    await stored().toMatch(/(?=.*fine liner)(?=.*axidraw-v3-a3)(?=.*"downPct":22\b)/s);
    await started.killAndReopen();
    ({ page } = started);
    await openGroup(page, "Plotter", "Model and position");
    const model = page.getByLabel("Model", { exact: true });
    await expect
      .poll(() => model.evaluate((select) => (select as HTMLSelectElement).selectedOptions[0]?.label))
      .toBe("AxiDraw V3/A3");
    await openGroup(page, "Speed", "Presets");
    await page.getByText("fine liner").first().waitFor();
    await openPanel(page, "Plotter");
    await expect.poll(() => height("down").inputValue()).toBe("22");
    await expect.poll(() => height("up").inputValue()).toBe("60");
  });

  it("continues a plot that was killed", { timeout: 300_000 }, async () => {
    let { page } = started;
    await lay(page, "comb", 30);
    await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
    await expectState(page, /^Plotting: comb\s+[1-9]\d\s*%$/);
    await started.killAndReopen();
    ({ page } = started);
    await expectState(page, /^Interrupted: comb/);
    const bar = statusCard(page).getByRole("progressbar");
    expect(Number(await bar.getAttribute("aria-valuenow"))).toBeGreaterThanOrEqual(5);
    await statusCard(page).getByRole("button", { name: "Go on from there" }).click();
    await expectState(page, /^Paused: comb/);
    await statusCard(page).getByRole("checkbox", { name: "The carriage is in its corner" }).check();
    await statusCard(page).getByRole("button", { name: "Resume" }).click();
    await historyPanel(page).getByText("Done", { exact: true }).waitFor({ timeout: 120_000 });
  });
});
