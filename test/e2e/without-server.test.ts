/**
 * The page without a server, from static files: its worker plots on a board that is on a fake serial port, outside
 * the browser. What the board has drawn at the end is compared with a plot by the library.
 */
import { readFileSync } from "node:fs";
import type { Browser, BrowserContext, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { importDrawing, type StrokeSet } from "../../src/index.js";
import { machineOf, prepareJob } from "../../src/internal.js";
import { jobSchema, type Job, type PlotSettings } from "../../src/schema/index.js";
import { crash, storedRecords } from "../support/backends.js";
import { launchBrowser } from "../support/browser.js";
import { compareDrawn } from "../support/drawn-truth.js";
import { FAKE_SERIAL_SCRIPT } from "../support/fake-serial-script.js";
import { countFor, IS_FULL } from "../support/full-run.js";
import { plotting, seeded } from "../support/live-plot.js";
import { dropFile, historyPanel, plotBar, statusCard, waitForPlan } from "../support/page-actions.js";
import { startStaticApp, type StaticApp } from "../support/static-app.js";
import { startTabbedBrowser, type TabbedBrowser } from "../support/tabbed-browser.js";

const PATIENCE_MS = 90_000;
/** The samples take ten minutes each on a real board. */
const SAMPLE_SPEED = 30;
const HIDDEN_S = IS_FULL ? 360 : 20;
const KILLS = countFor("PLOTWRIGHT_KILLS", 20, 1);
const SAMPLES = [
  ["Hello paper", "hello-paper"],
  ["Whirling triangles", "whirling-triangles"],
  ["Flower meadow", "flower-meadow"],
] as const;
/** Missing or doubled where the board kept its counters. */
const MAX_OFF_MM = 0.05;

let browser: Browser;
let app: StaticApp;
let context: BrowserContext;
let closeBrowser: () => Promise<void>;

beforeAll(async () => {
  browser = await launchBrowser();
});
afterAll(() => browser.close());
afterEach(async () => {
  await closeBrowser();
  await app.close();
});

async function newContext(): Promise<TabbedBrowser> {
  const made = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  return { context: made, close: () => made.close() };
}

async function start(boardSpeed: number, open = newContext): Promise<Page> {
  app = await startStaticApp(boardSpeed);
  ({ context, close: closeBrowser } = await open());
  await context.addInitScript(FAKE_SERIAL_SCRIPT);
  return openPage(boardSpeed);
}

async function openPage(boardSpeed: number): Promise<Page> {
  const page = await context.newPage();
  // Asked before a page that plots is closed or reloaded.
  page.on("dialog", (dialog) => void dialog.accept());
  await page.goto(`${app.url}/?virtual-speed=${boardSpeed}`);
  return page;
}

async function connect(page: Page): Promise<void> {
  await page.getByRole("button", { name: "Connect a plotter…" }).click();
  await untilConnected(page);
}

/** A port that the page may use is found by itself. */
async function untilConnected(page: Page): Promise<void> {
  await page.getByRole("button", { name: "Connect a plotter…" }).waitFor({ state: "detached" });
  await expect.poll(() => app.serial.isOpen, { timeout: PATIENCE_MS }).toBe(true);
}

const state = (page: Page, words: RegExp): Promise<void> =>
  expect.poll(() => page.locator(".machine-state").innerText(), { timeout: PATIENCE_MS }).toMatch(words);

const plot = (page: Page): Promise<void> =>
  plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();

const done = (page: Page): Promise<void> =>
  historyPanel(page).getByText("Done", { exact: true }).first().waitFor({ timeout: 600_000 });

/** The jobs as they are stored in the browser. */
async function storedJobs(page: Page): Promise<Job[]> {
  const rows = await storedRecords(page, "jobs");
  return rows.map((row) => jobSchema.parse((row as { job: unknown }).job));
}

const strokesOf = (text: string, settings: PlotSettings): StrokeSet =>
  prepareJob(importDrawing("", text), settings, machineOf(settings)).prepared.strokes;

/** Long lines that do not touch each other. */
const comb = (lines: number): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="100mm" viewBox="0 0 150 100" fill="none" stroke="black">${Array.from(
    { length: lines },
    (_, i) => `<path d="M20 ${20 + Math.min(4, 76 / lines) * i}h100"/>`,
  ).join("")}</svg>`;

async function plotComb(page: Page, lines: number): Promise<void> {
  await dropFile(page, "comb.svg", comb(lines));
  await waitForPlan(page);
  await connect(page);
  await plot(page);
}

/** How much of the paper differs from the drawing, mm. */
async function offMm(page: Page, lines: number): Promise<{ gapMm: number; overlapMm: number }> {
  const [{ settings }] = await storedJobs(page);
  const { gapMm, overlapMm, awayMm } = compareDrawn(
    strokesOf(comb(lines), settings),
    app.serial.board.drawn(),
  );
  expect(awayMm).toBeLessThan(MAX_OFF_MM);
  return { gapMm, overlapMm };
}

async function recover(page: Page): Promise<void> {
  await state(page, /^Interrupted/);
  await untilConnected(page);
  await statusCard(page).getByRole("button", { name: "Go on from there" }).click();
  await state(page, /^Paused/);
  await statusCard(page).getByRole("button", { name: "Resume" }).click();
  await done(page);
}

describe("the page without a server", () => {
  it.each(SAMPLES)("plots the sample %s to the step", { timeout: 400_000 }, async (title, file) => {
    const page = await start(SAMPLE_SPEED);
    await page.getByRole("button", { name: title }).click();
    await waitForPlan(page);
    await connect(page);
    await plot(page);
    await done(page);
    const [{ settings }] = await storedJobs(page);
    const strokes = strokesOf(readFileSync(`samples/${file}.svg`, "utf8"), settings);
    const { world, board, run } = await plotting(
      settings.motion.mode,
      strokes,
      "2.8.1",
      settings.pen,
      settings,
    );
    await world.run(run.finished);
    const { steps1, steps2 } = app.serial.board.state();
    expect([steps1, steps2]).toEqual([board.state().steps1, board.state().steps2]);
    expect(app.serial.board.drawn()).toEqual(board.drawn());
  });

  it("plots without an underrun while its tab is hidden", { timeout: (HIDDEN_S + 200) * 1_000 }, async () => {
    // Of 4 s each: longer than the tab is hidden.
    const lines = Math.ceil(HIDDEN_S / 4) + 3;
    const page = await start(1, startTabbedBrowser);
    await plotComb(page, lines);
    await expect.poll(() => app.serial.board.statistics().movingS).toBeGreaterThan(1);
    const front = await context.newPage();
    await front.bringToFront();
    await expect.poll(() => page.evaluate(() => document.visibilityState)).toBe("hidden");
    const before = app.serial.board.statistics();
    await new Promise((resolve) => setTimeout(resolve, HIDDEN_S * 1_000));
    expect(await page.evaluate(() => document.visibilityState)).toBe("hidden");
    const after = app.serial.board.statistics();
    expect(after.movingS - before.movingS).toBeGreaterThan(0.5 * HIDDEN_S);
    expect(after.underrunCount).toBe(before.underrunCount);
    await page.bringToFront();
    await done(page);
    const { gapMm, overlapMm } = await offMm(page, lines);
    expect(gapMm).toBeLessThan(MAX_OFF_MM);
    expect(overlapMm).toBeLessThan(MAX_OFF_MM);
  });

  it("recovers after a reload in the middle of a plot", { timeout: 300_000 }, async () => {
    const page = await start(1);
    await plotComb(page, 3);
    await expect.poll(() => app.serial.board.statistics().movingS).toBeGreaterThan(2);
    await page.reload();
    await recover(page);
    const { gapMm, overlapMm } = await offMm(page, 3);
    expect(gapMm).toBeLessThan(MAX_OFF_MM);
    expect(overlapMm).toBeLessThan(MAX_OFF_MM);
  });

  it("loses and doubles nothing where a tab is killed", { timeout: 60_000 + KILLS * 120_000 }, async () => {
    const random = seeded(22);
    for (let kill = 0; kill < KILLS; kill++) {
      const page = await start(1);
      await plotComb(page, 3);
      const atS = 1 + 5 * random();
      await expect.poll(() => app.serial.board.statistics().movingS, { interval: 20 }).toBeGreaterThan(atS);
      await crash(page);
      const next = await openPage(1);
      await recover(next);
      const { gapMm, overlapMm } = await offMm(next, 3);
      expect({ atS, gapMm, overlapMm, isGood: gapMm < MAX_OFF_MM && overlapMm < MAX_OFF_MM }).toMatchObject({
        isGood: true,
      });
      await closeBrowser();
      await app.close();
    }
    await start(1);
  });

  it("lets one tab operate while another one watches", { timeout: 300_000 }, async () => {
    const page = await start(1);
    await plotComb(page, 3);
    await state(page, /^Plotting/);
    const other = await openPage(1);
    await other.getByText("Another tab is operating.").waitFor();
    await state(other, /^Plotting: comb/);
    // It can't change anything, nor take over while the other one plots, but it can stop the plot.
    await other.getByRole("button", { name: "Take over" }).click();
    await other.getByText("The other tab is plotting.").waitFor();
    await statusCard(other).getByRole("button", { name: "Cancel" }).click();
    await other.getByRole("button", { name: "Cancel the plot" }).click();
    await historyPanel(page).getByText("Cancelled").first().waitFor();
    // Idle, it is handed over.
    await other.getByRole("button", { name: "Take over" }).click();
    await page.getByText("Another tab is operating.").waitFor();
    await other.getByText("Another tab is operating.").waitFor({ state: "detached" });
    // The operator is closed: the other one's worker takes over.
    await other.close();
    await page.getByText("Another tab is operating.").waitFor({ state: "detached" });
    await state(page, /Ready/);
  });
});
