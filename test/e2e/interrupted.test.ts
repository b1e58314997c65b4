/**
 * A plot that was killed half way: the page shows its progress, and what is drawn and what is left in
 * different colours.
 */
import { once } from "node:events";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { snapshotSchema, type Job } from "../../src/schema/index.js";
import { launchBrowser } from "../support/browser.js";
import { rgbFromNumber, saturation } from "../support/colors.js";
import {
  colorCounts,
  dropFile,
  plotBar,
  queuePanel,
  waitForPicture,
  waitForPlan,
} from "../support/page-actions.js";
import { startServerProcess, temporaryFolder, type ServerProcess } from "../support/server-process.js";

const PATIENCE_MS = 120_000;
const NAME = "comb";
const COMB = `<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="150mm" viewBox="0 0 150 150" stroke="black">${Array.from(
  { length: 40 },
  (_, i) => `<path d="M10 ${10 + 3 * i}h120"/>`,
).join("")}</svg>`;

const data = temporaryFolder("interrupted");
let browser: Browser;
let server: ServerProcess;
let page: Page;
/** Pixels inked by the whole drawing. */
let wholeCount = 0;

async function openPage(): Promise<void> {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, colorScheme: "light" });
  page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  await page.goto(server.url);
}

async function theJob(): Promise<Job> {
  const answer: unknown = await (await fetch(`${server.url}/api/v1/state`)).json();
  return snapshotSchema.parse(answer).jobs[0];
}

async function inkedCount(): Promise<number> {
  await waitForPicture(page);
  let sum = 0;
  for (const [color, count] of await colorCounts(page.getByRole("img", { name: "Preview" }))) {
    if (saturation(rgbFromNumber(color)) > 60) sum += count;
  }
  return sum;
}

/** The page's text and picture match the job's progress. */
async function expectPartlyDrawn(state: string): Promise<void> {
  const job = await theJob();
  const share = Math.round(job.progress * 100);
  expect(job.progress).toBeGreaterThan(0.2);
  expect(job.progress).toBeLessThan(0.8);
  expect(job.remainingS! / job.stats!.durationS).toBeCloseTo(1 - job.progress, 1);
  const pill = page.locator(".machine-state");
  await expect.poll(() => pill.innerText()).toMatch(new RegExp(`^${state}: ${NAME}\\s+\\d+\\s*%$`));
  const shown = Number(/(\d+)\s*%/.exec(await pill.innerText())![1]);
  expect(Math.abs(shown - share)).toBeLessThanOrEqual(1);
  const scrubber = page.getByRole("slider", { name: "Moment of the plot" });
  const [value, max] = [Number(await scrubber.inputValue()), Number(await scrubber.getAttribute("max"))];
  expect(value / max).toBeCloseTo(job.progress, 1);
  expect(Math.abs((await inkedCount()) / wholeCount - job.progress)).toBeLessThan(0.15);
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
      await dropFile(page, `${NAME}.svg`, COMB);
      await page.getByText(NAME, { exact: true }).first().waitFor();
      await waitForPlan(page);
      wholeCount = await inkedCount();
      expect(wholeCount).toBeGreaterThan(2_000);
      await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
      await queuePanel(page)
        .getByRole("button", { name: /^Start / })
        .click();
      await expect.poll(async () => (await theJob()).progress, { interval: 50 }).toBeGreaterThan(0.3);
      const ended = once(server.process, "exit");
      server.process.kill("SIGKILL");
      await ended;
      await page.context().close();
      server = await startServerProcess({ dataDir: data.path, virtualSpeed: 8 });
      await openPage();
      await waitForPlan(page);
      await expectPartlyDrawn("Interrupted");
    },
  );

  it("is shown there when it is resumed and held, after a reload too", { timeout: PATIENCE_MS }, async () => {
    const { id } = await theJob();
    await fetch(`${server.url}/api/v1/jobs/${id}/recover`, { method: "POST" });
    await expect.poll(async () => (await theJob()).state).toBe("paused");
    await expectPartlyDrawn("Paused");
    await page.reload();
    await waitForPlan(page);
    await expectPartlyDrawn("Paused");
  });
});
