/** A plot that was killed half way: Watch says how far it is, and shows what is drawn and what is left apart. */
import { once } from "node:events";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { snapshotSchema, type Job } from "../../src/schema/index.js";
import { launchBrowser } from "../support/browser.js";
import { GHOST_COLOR } from "../../web/scene/renderer.js";
import {
  colorCounts,
  dropFile,
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
  await page.goto(server.url);
}

async function theJob(): Promise<Job> {
  const answer: unknown = await (await fetch(`${server.url}/api/v1/state`)).json();
  return snapshotSchema.parse(answer).jobs[0];
}

const colorOf = (hex: string): number => Number.parseInt(hex.slice(1), 16);

/** Of what the sheet shows of the drawing, the share that is drawn: in the line's own colour, not pale. */
async function drawnShare(): Promise<number> {
  await page.getByText(`Reading ${NAME}`).waitFor({ state: "detached" });
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
  const bar = statusCard(page).getByRole("progressbar");
  expect(Math.abs(Number(await bar.getAttribute("aria-valuenow")) - share)).toBeLessThanOrEqual(1);
  expect(await statusCard(page).innerText()).toContain("left");
  expect(Math.abs((await drawnShare()) - job.progress)).toBeLessThan(0.15);
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
      await expectPartlyDrawn("Interrupted");
    },
  );

  it("is shown there when it is resumed and held, after a reload too", { timeout: PATIENCE_MS }, async () => {
    const { id } = await theJob();
    await fetch(`${server.url}/api/v1/jobs/${id}/recover`, { method: "POST" });
    await expect.poll(async () => (await theJob()).state).toBe("paused");
    await expectPartlyDrawn("Paused");
    await page.reload();
    await expectPartlyDrawn("Paused");
  });
});
