/**
 * A plot that stands half way (killed, held, waiting for a pen, resumed): Watch says how far it is, and shows
 * what is drawn and what is left apart.
 */
import { once } from "node:events";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { snapshotSchema, type Job } from "../../src/schema/index.js";
import { launchBrowser } from "../support/browser.js";
import { GHOST_COLOR } from "../../web/scene/renderer.js";
import {
  colorCounts,
  dropFile,
  historyPanel,
  openView,
  plotBar,
  queuePanel,
  statusCard,
  waitForPicture,
  waitForPlan,
} from "../support/page-actions.js";
import { startServerProcess, temporaryFolder, type ServerProcess } from "../support/server-process.js";

const PATIENCE_MS = 120_000;
const NAME = "comb";
const PEN_COLOR = "#1040c0";
const COMB = `<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="150mm" viewBox="0 0 150 150" stroke="${PEN_COLOR}">${Array.from(
  { length: 40 },
  (_, i) => `<path d="M10 ${10 + 3 * i}h120"/>`,
).join("")}</svg>`;

/** The same comb in two layers; the second one stops the plot for its pen. */
const TWO_PENS = "two pens";
const layerOf = (label: string, color: string, from: number): string =>
  `<g inkscape:groupmode="layer" inkscape:label="${label}" stroke="${color}">${Array.from(
    { length: 20 },
    (_, i) => `<path d="M10 ${from + 3 * i}h120"/>`,
  ).join("")}</g>`;
const TWO_PENS_SVG = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="150mm" height="150mm" viewBox="0 0 150 150">${layerOf("Blue", PEN_COLOR, 10)}${layerOf("!Red", "#c01010", 70)}</svg>`;

const data = temporaryFolder("interrupted");
let browser: Browser;
let server: ServerProcess;
let page: Page;
async function openPage(): Promise<void> {
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 },
    // So that a line covers whole pixels.
    deviceScaleFactor: 2,
    colorScheme: "light",
  });
  page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  await page.goto(server.url);
}

async function theJob(name = NAME): Promise<Job> {
  const answer: unknown = await (await fetch(`${server.url}/api/v1/state`)).json();
  return snapshotSchema.parse(answer).jobs.find((job) => job.name === name)!;
}

/** Drops a drawing and starts its plot. */
async function start(name: string, svg: string): Promise<void> {
  await dropFile(page, `${name}.svg`, svg);
  await page.getByText(name, { exact: true }).first().waitFor();
  await waitForPlan(page);
  await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
  await queuePanel(page)
    .getByRole("button", { name: /^Start / })
    .click();
}

const colorOf = (hex: string): number => Number.parseInt(hex.slice(1), 16);

/** Of what the sheet shows of the drawing, the share that is drawn: in the line's own colour, not pale. */
async function drawnShare(name: string): Promise<number> {
  await page.getByText(`Reading ${name}`).waitFor({ state: "detached" });
  await waitForPicture(page);
  let [drawn, left] = [0, 0];
  const canvas = page.getByRole("img", { name: "The plot: what is drawn, and what is left" });
  for (const [color, count] of await colorCounts(canvas)) {
    if (color === colorOf(PEN_COLOR)) drawn += count;
    else if (color === colorOf(GHOST_COLOR)) left += count;
  }
  expect(drawn + left).toBeGreaterThan(1_000);
  return drawn / (drawn + left);
}

/** The page's text and picture match the job's progress. */
async function expectPartlyDrawn(state: string, name = NAME): Promise<void> {
  const job = await theJob(name);
  const share = Math.round(job.progress * 100);
  expect(job.progress).toBeGreaterThan(0.2);
  expect(job.progress).toBeLessThan(0.8);
  expect(job.remainingS! / job.stats!.durationS).toBeCloseTo(1 - job.progress, 1);
  const pill = page.locator(".machine-state");
  await expect.poll(() => pill.innerText()).toMatch(new RegExp(`^${state}: ${name}\\s+\\d+\\s*%$`));
  const shown = Number(/(\d+)\s*%/.exec(await pill.innerText())![1]);
  expect(Math.abs(shown - share)).toBeLessThanOrEqual(1);
  const bar = statusCard(page).getByRole("progressbar");
  expect(Math.abs(Number(await bar.getAttribute("aria-valuenow")) - share)).toBeLessThanOrEqual(1);
  expect(await statusCard(page).innerText()).toContain("left");
  expect(Math.abs((await drawnShare(name)) - job.progress)).toBeLessThan(0.15);
}

beforeAll(async () => {
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path, virtualSpeed: 8 });
  await openPage();
}, PATIENCE_MS);

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

describe("a plot whose server was killed", () => {
  it(
    "is shown at its position at once, on a page that is opened then",
    { timeout: PATIENCE_MS },
    async () => {
      await start(NAME, COMB);
      await expect.poll(async () => (await theJob()).progress, { interval: 50 }).toBeGreaterThan(0.3);
      const ended = once(server.process, "exit");
      server.process.kill("SIGKILL");
      await ended;
      await page.context().close();
      server = await startServerProcess({ dataDir: data.path, virtualSpeed: 8 });
      await openPage();
      await expectPartlyDrawn("Interrupted");
    },
  );

  it("is shown there when it is resumed and held, after a reload too", { timeout: PATIENCE_MS }, async () => {
    const { id } = await theJob();
    await statusCard(page).getByRole("button", { name: "Go on from there" }).click();
    await expect.poll(async () => (await theJob()).state).toBe("paused");
    await expectPartlyDrawn("Paused");
    await page.reload();
    await expectPartlyDrawn("Paused");
    await page.request.post(`${server.url}/api/v1/jobs/${id}/cancel`);
    await expect.poll(async () => (await theJob()).state).toBe("cancelled");
  });
});

describe("a plot that waits for a pen", { timeout: PATIENCE_MS }, () => {
  const WAITS = "Waits for the pen[^:]*";

  it("is shown at its position, after a reload too", async () => {
    await openView(page, "Prepare");
    await start(TWO_PENS, TWO_PENS_SVG);
    await expect.poll(async () => (await theJob(TWO_PENS)).wait?.layerName).toContain("Red");
    await expectPartlyDrawn(WAITS, TWO_PENS);
    await page.reload();
    await expectPartlyDrawn(WAITS, TWO_PENS);
  });

  it("is shown there when it was cancelled and is opened again, after a reload too", async () => {
    const { id } = await theJob(TWO_PENS);
    await page.request.post(`${server.url}/api/v1/jobs/${id}/cancel`);
    await expect.poll(async () => (await theJob(TWO_PENS)).state).toBe("cancelled");
    await historyPanel(page)
      .getByRole("button", { name: `Go on from where it was cancelled: ${TWO_PENS}` })
      .click();
    await expect.poll(async () => (await theJob(TWO_PENS)).state).toBe("paused");
    await expectPartlyDrawn("(Paused|Waits for the pen[^:]*)", TWO_PENS);
    await page.reload();
    await expectPartlyDrawn("(Paused|Waits for the pen[^:]*)", TWO_PENS);
  });
});
