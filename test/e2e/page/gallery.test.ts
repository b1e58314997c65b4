/** The gallery of 5 000 finished plots: it fetches and shows one page at a time, finds by name, and plots again. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { prepareDataDir } from "../../../server/storage/data-dir.js";
import { DrawingFiles } from "../../../server/storage/drawing-files.js";
import { Store } from "../../../server/storage/store.js";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import { historyPanel, openPanel, queuePanel } from "../../support/browser/page-actions.js";
import { ruledSheet } from "../../support/drawings/drawings.js";
import { makeJob, STATS } from "../../support/jobs/jobs.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";

const LIMIT_MS = 120_000;
const COUNT = 5_000;
const PAGE_SIZE = 50;

const data = temporaryFolder("gallery");
let browser: Browser;
let server: ServerProcess;
let page: Page;
/** Addresses of all requests for a part of the history, and how many for drawings. */
const histories: string[] = [];
let drawingCount = 0;
const complaints: string[] = [];

beforeAll(async () => {
  prepareDataDir(data.path);
  const store = Store.open(data.path);
  const drawing = await new DrawingFiles(data.path, 1_000_000).add([Buffer.from(ruledSheet(3))]);
  store.transaction(() => {
    for (let i = 0; i < COUNT; i++) {
      const endedAt = new Date(Date.parse("2026-01-01") + 60_000 * i).toISOString();
      const more = {
        name: `Sheet ${i}`,
        startedAt: endedAt,
        endedAt,
        progress: 1,
        plottedS: 90,
        expectedS: 60,
      };
      store.addJob(
        makeJob(`job-${i}`, { state: "done", stats: { ...STATS, drawMm: 12_340 }, ...more }),
        drawing,
      );
    }
  });
  store.close();
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path });
  page = await (await browser.newContext({ ...PLAIN, viewport: { width: 1440, height: 900 } })).newPage();
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => {
    if (request.url().includes("/history")) histories.push(new URL(request.url()).search);
    if (request.url().endsWith("/drawing")) drawingCount++;
  });
  await page.goto(server.url);
}, LIMIT_MS);

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

const gallery = () => page.getByRole("dialog", { name: "Gallery" });
const tiles = () => gallery().getByRole("article");
const names = (): Promise<string[]> => tiles().locator(".job-name").allInnerTexts();
const upTo = (first: number): string[] => Array.from({ length: PAGE_SIZE }, (_, i) => `Sheet ${first - i}`);

describe("the gallery of 5 000 finished plots", () => {
  it("shows the newest beside the queue, with ink and times, and asks the server for nothing more", async () => {
    await openPanel(page, "Queue");
    const first = historyPanel(page).getByRole("article").first();
    await first.getByText("Sheet 4999").waitFor();
    const words = (await first.innerText()).replace(/\s/g, " ");
    expect(words).toContain("12.3 m of ink · took 1 min 30 s · estimated 1 min");
    expect(await historyPanel(page).getByRole("article").count()).toBe(6);
    expect(histories).toEqual([]);
  });

  it("has one page in the document, and fetches each page with one request", async () => {
    await page.getByRole("button", { name: "Show all finished plots" }).click();
    await expect.poll(names).toEqual(upTo(4_999));
    expect(histories).toEqual([""]);
    await gallery().getByRole("button", { name: "Older" }).click();
    await expect.poll(names).toEqual(upTo(4_949));
    expect(histories).toEqual(["", "?after=job-4950"]);
    await gallery().getByRole("button", { name: "Newer" }).click();
    await expect.poll(names).toEqual(upTo(4_999));
    expect(await tiles().count()).toBe(PAGE_SIZE);
    // Pictures are fetched only for tiles that were in view.
    expect(drawingCount).toBeLessThan(2 * PAGE_SIZE + 6);
  });

  it("finds a plot by a part of its name among all of them", async () => {
    histories.length = 0;
    await gallery().getByRole("textbox", { name: "Search by name" }).pressSequentially("sheet 123");
    await expect
      .poll(names)
      .toEqual([...Array.from({ length: 10 }, (_, i) => `Sheet ${1_239 - i}`), "Sheet 123"]);
    // Not one request for each letter.
    expect(histories.length).toBeLessThan("sheet 123".length);
    await gallery().getByRole("textbox", { name: "Search by name" }).fill("no such sheet");
    await gallery().getByText("No finished plot has “no such sheet” in its name.").waitFor();
  });

  it("plots an old sheet again, and removes one", async () => {
    const search = gallery().getByRole("textbox", { name: "Search by name" });
    await search.fill("Sheet 77");
    await gallery().getByRole("button", { name: "Plot again: Sheet 77", exact: true }).click();
    await expect.poll(names).not.toContain("Sheet 77");
    await gallery().getByRole("button", { name: "More for Sheet 770" }).click();
    await gallery().getByRole("button", { name: "Remove Sheet 770" }).click();
    await expect.poll(names).not.toContain("Sheet 770");
    await gallery().getByRole("button", { name: "Close" }).click();
    await queuePanel(page).getByRole("button", { name: "Sheet 77", exact: true }).waitFor();
  });

  it("shows an old sheet as it was plotted", async () => {
    await page.getByRole("button", { name: "Show all finished plots" }).click();
    await gallery().getByRole("textbox", { name: "Search by name" }).fill("Sheet 1000");
    await gallery().getByRole("button", { name: "Show Sheet 1000 as it was plotted" }).click();
    const status = page.getByRole("region", { name: "Plot under way" });
    await status.getByText("Sheet 1000", { exact: true }).waitFor();
    await status.getByText("30 s longer than the expected 1 min").waitFor();
    await page.locator(".watch canvas[aria-busy=false]:visible").first().waitFor();
    expect(complaints).toEqual([]);
  });
});
