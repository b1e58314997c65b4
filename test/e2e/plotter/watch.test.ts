/** Watch: the running plot has a separate view, and the drawing laid out in Prepare stays unchanged. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS, type Job } from "../../../src/schema/index.js";
import { ruledSheet } from "../../support/drawings/drawings.js";
import {
  historyPanel,
  openView,
  plotBar,
  queuePanel,
  statusCard,
  waitForPicture,
} from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const PATIENCE_MS = 120_000;
const LINES = "lines";
const OTHER = "other";
const OTHER_SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100"><path d="M10 10h80v80" fill="none" stroke="#0a0"/></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.firstVisit("watch", {}, ["--virtual-speed", "4"]);
}, PATIENCE_MS);

afterAll(async () => test.close());

const button = (name: string | RegExp) => statusCard(test.page).getByRole("button", { name });
const nameOnPaper = () => test.page.locator(".drawn-size").getByText(OTHER, { exact: true }).first();
const theJob = async (): Promise<Job> => (await test.jobs()).find(({ name }) => name === LINES)!;

const penCanvas = () => test.page.locator(".pen-canvas:visible");

/** Pixels of the pen on the sheet that is shown. */
async function penPixels(): Promise<number> {
  await waitForPicture(test.page);
  return penCanvas().evaluate((canvas: HTMLCanvasElement) => {
    const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((alpha, i) => i % 4 === 3 && alpha > 128).length;
  });
}

describe("a plot that starts", () => {
  it("opens Watch, with the time left, the progress and the time of the end", async () => {
    const { page } = test;
    await test.drop(LINES, ruledSheet());
    await test.queue();
    await test.drop(OTHER, OTHER_SVG);
    await test.panel("Queue");
    await queuePanel(page)
      .getByRole("button", { name: `Start ${LINES}` })
      .click();
    await statusCard(page)
      .getByText(/^done \d\d:\d\d$/)
      .waitFor();
    const words = await statusCard(page).innerText();
    expect(words).toMatch(/lines\s+Plotting/);
    expect(words).toMatch(/\d+\s(s|min).*left/s);
    expect(words).toMatch(/\d\s%/);
    await expect.poll(penPixels).toBeGreaterThan(20);
  });

  it("does not change the laid-out drawing, and shows no pen on it", async () => {
    const { page } = test;
    expect(await plotBar(page).isVisible()).toBe(false);
    await openView(page, "Prepare");
    await nameOnPaper().waitFor();
    expect(await penPixels()).toBe(0);
    await queuePanel(page).getByRole("button", { name: LINES, exact: true }).click();
    await statusCard(page).waitFor();
    await openView(page, "Prepare");
    await nameOnPaper().waitFor();
    await openView(page, "Watch");
  });

  it("shows the pen moving at every frame, and at rest while the plot is paused", async () => {
    const placesIn = (frames: number): Promise<number> =>
      penCanvas().evaluate(async (canvas: HTMLCanvasElement, count) => {
        const places = new Set<string | undefined>();
        for (let i = 0; i < count; i++) {
          await new Promise(requestAnimationFrame);
          places.add(canvas.dataset["mm"]);
        }
        return places.size;
      }, frames);
    // It rests while it lifts. A report comes every seventh frame or less often.
    expect(await placesIn(150)).toBeGreaterThan(60);
    await button("Pause").click();
    await button("Resume").waitFor();
    await expect.poll(() => placesIn(20)).toBe(1);
    await button("Resume").click();
    await button("Pause").waitFor();
    await expect.poll(() => placesIn(20)).toBeGreaterThan(5);
  });

  it("is the first view of a new tab", async () => {
    const tab = await test.page.context().newPage();
    await tab.goto(test.server.url);
    await statusCard(tab).getByText(LINES, { exact: true }).waitFor();
    expect(await tab.locator(".machine-state").innerText()).toMatch(/^Plotting: lines\s+\d+\s%$/);
    await tab.close();
  });

  it("fills a tablet beside the plotter, with its buttons", async () => {
    const { page } = test;
    await page.getByRole("button", { name: "Full screen" }).click();
    expect(await page.getByRole("banner").isVisible()).toBe(false);
    expect(await queuePanel(page).isVisible()).toBe(false);
    await button("Pause").waitFor();
    await page.getByRole("button", { name: "Exit full screen" }).click();
    await page.getByRole("banner").waitFor();
  });

  it("asks before it cancels, with Emergency stop at hand", async () => {
    const { page } = test;
    for (const size of [
      { width: 390, height: 844 },
      { width: 1440, height: 900 },
    ]) {
      await page.setViewportSize(size);
      await button("Cancel").click();
      await statusCard(page).getByRole("alertdialog").waitFor();
      // Enabled, in sight, and not covered.
      await button("Emergency stop").click({ trial: true });
      expect(await button("Pause").isDisabled()).toBe(true);
      await button("Keep plotting").click();
    }
  });

  it("has Pause within reach of the thumb on a phone, and nothing wider than the screen", async () => {
    const { page } = test;
    await page.setViewportSize({ width: 390, height: 844 });
    const box = (await button("Pause").boundingBox())!;
    expect(box.y).toBeGreaterThan(720);
    expect(box.y + box.height).toBeLessThanOrEqual(844);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    const sheet = (await page.locator(".preview:visible").boundingBox())!;
    expect(sheet.y).toBeLessThan(300);
    await page.setViewportSize({ width: 1440, height: 900 });
  });
});

describe("a plot that was cancelled", () => {
  it("resumes where it was cancelled", async () => {
    const { page } = test;
    await expect.poll(async () => (await theJob()).progress).toBeGreaterThan(0.03);
    await button("Cancel").click();
    await button("Cancel the plot").click();
    await expect.poll(async () => (await theJob()).state).toBe("cancelled");
    const { progress } = await theJob();
    const row = historyPanel(page).getByRole("listitem");
    await row.getByRole("button", { name: `Plot again: ${LINES}` }).waitFor();
    await row.getByRole("button", { name: `Go on from where it was cancelled: ${LINES}` }).click();
    await button("Resume").waitFor();
    expect((await theJob()).progress).toBeCloseTo(progress, 2);
    await button("Cancel").click();
    await button("Cancel the plot").click();
    await historyPanel(page).getByText("Cancelled", { exact: true }).waitFor();
  });
});

describe("the queue", () => {
  it("has one line for copies, with its number, its picture and a menu", async () => {
    const { page } = test;
    await openView(page, "Prepare");
    await test.field("Copies").fill("3");
    await test.field("Copies").press("Enter");
    await plotBar(page).getByRole("button", { name: "Add 3 to queue" }).click();
    const row = queuePanel(page).getByRole("listitem");
    await row.getByText("×3").waitFor();
    expect(await row.count()).toBe(1);
    // The plotter's panel is above the queue, and only a visible row fetches its thumbnail.
    await row.scrollIntoViewIfNeeded();
    await row.locator(".thumb img").waitFor();
    const more = row.getByRole("button", { name: `More for ${OTHER}` });
    await more.click();
    await row.getByRole("button", { name: `Remove ${OTHER}` }).click();
    await row.getByText("×2").waitFor();
    await more.click();
    await page.keyboard.press("Escape");
    expect(await row.getByRole("button", { name: `Remove ${OTHER}` }).count()).toBe(0);
    await more.click();
    await row.getByRole("button", { name: "Remove all 2" }).click();
    await row.waitFor({ state: "detached" });
  });

  it("shows at which stroke a job starts, in a row apart from copies of the whole drawing", async () => {
    const drawing = ruledSheet(6);
    const add = (from?: { strokeIndex: number; alongMm: number }) =>
      fetch(`${test.server.url}/api/v1/jobs`, {
        method: "POST",
        headers: { "content-type": "application/json" },
        body: JSON.stringify({ name: "part", drawing, settings: DEFAULT_PLOT_SETTINGS, from }),
      });
    await add();
    await add({ strokeIndex: 3, alongMm: 0 });
    const rows = queuePanel(test.page).getByRole("listitem").filter({ hasText: "part" });
    await rows.getByText(/^from stroke 4$/).waitFor();
    expect(await rows.count()).toBe(2);
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
