/** On a desktop screen the page is as high as the window and does not scroll; its columns scroll separately. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { plotBar, queuePanel } from "../support/browser/page-actions.js";
import { PageTest } from "../support/browser/page-test.js";

const SIZES = [
  { width: 1440, height: 900 },
  { width: 1920, height: 1080 },
  { width: 1024, height: 768 },
];
/** The left column's groups, including collapsed ones. */
const GROUPS = ".column-setup .group-head";

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("window-height");
});

afterAll(async () => test.close());

/** Height of the document and its scroll position, px. */
const documentPx = (): Promise<{ height: number; scrolled: number }> =>
  test.page.evaluate(() => ({
    height: document.documentElement.scrollHeight,
    scrolled: document.scrollingElement?.scrollTop ?? 0,
  }));

describe("before the first plot", () => {
  it("the guide leaves room for the queue in a window of 1440 × 900", async () => {
    const { page } = test;
    const guide = page.getByRole("region", { name: "First plot with this plotter" });
    await guide.waitFor();
    const inSight = async (): Promise<void> => {
      const queue = (await queuePanel(page).boundingBox())!;
      expect(queue.y + queue.height).toBeLessThanOrEqual(900);
    };
    await inSight();
    await guide.getByRole("button", { name: "Home", exact: true }).click();
    // Done: one line, from which it can be opened again.
    await guide.getByText("The carriage is home.").waitFor();
    await inSight();
    await guide.getByRole("button", { name: "Home again…" }).click();
    await guide.getByRole("button", { name: "Motors off" }).waitFor();
  });
});

describe("the menu of the last plot in the queue", () => {
  it("opens within the window, where its plot is at the window's end", async () => {
    const { page } = test;
    await page.setViewportSize({ width: 1440, height: 620 });
    await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
    const opener = queuePanel(page).getByRole("button", { name: /^More for / });
    await opener.evaluate((element) => element.scrollIntoView({ block: "end" }));
    await opener.click();
    const last = queuePanel(page).getByRole("button", { name: /^Remove / });
    await last.waitFor();
    const { y, height } = (await last.boundingBox())!;
    expect(y + height).toBeLessThanOrEqual(620);
    await last.click();
  });
});

describe.each(SIZES)("a window of $width × $height", (size) => {
  it("holds the whole page with all groups of settings open, also after scrolling past a column's end", async () => {
    const { page } = test;
    await page.setViewportSize(size);
    expect(await documentPx()).toEqual({ height: size.height, scrolled: 0 });
    const folded = page.locator(`${GROUPS}[aria-expanded=false]`);
    while ((await folded.count()) > 0) await folded.first().click();
    expect(await page.locator(GROUPS).count()).toBeGreaterThan(8);
    // The parts that are loaded when they are first shown.
    await page.getByRole("button", { name: "Prepared drawing as SVG" }).waitFor();
    for (const column of [".column-setup", ".column-run"]) {
      const box = (await page.locator(column).boundingBox())!;
      await page.mouse.move(box.x + 20, box.y + box.height / 2);
      for (let turn = 0; turn < 12; turn++) await page.mouse.wheel(0, 1_000);
      await expect
        .poll(() =>
          page
            .locator(column)
            .evaluate((element) => element.scrollTop + element.clientHeight >= element.scrollHeight - 1),
        )
        .toBe(true);
    }
    expect(await documentPx()).toEqual({ height: size.height, scrolled: 0 });
    await page.locator(".column-run").evaluate((element) => (element.scrollTop = 0));
    const plot = (await plotBar(page).boundingBox())!;
    expect(plot.y).toBeGreaterThanOrEqual(0);
    expect(plot.y + plot.height).toBeLessThanOrEqual(size.height);
  });
});
