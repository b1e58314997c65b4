/** The page is as high as the window and does not scroll; its panel does. The sheet has most of the window. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { openView, plotBar, queuePanel } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";
import { ruledSheet } from "../../support/drawings/drawings.js";

const SIZES = [
  { width: 1440, height: 900 },
  { width: 1920, height: 1080 },
  { width: 1024, height: 768 },
];

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
  it("the guide is in sight in a window of 1440 × 900, without scrolling", async () => {
    const { page } = test;
    const guide = page.getByRole("region", { name: "First plot with this plotter" });
    await guide.waitFor();
    const inSight = async (): Promise<void> => {
      const { y, height } = (await guide.boundingBox())!;
      expect(y + height).toBeLessThanOrEqual(900);
    };
    await inSight();
    // With its model known, and the longer help of a plotter that finds home.
    for (const name of ["NextDraw 8511", "AxiDraw V3"]) {
      await guide.getByRole("button", { name, exact: true }).click();
      await guide.getByText("Press Plot.").waitFor();
      await inSight();
      if (name === "NextDraw 8511") {
        await guide.getByRole("button", { name: "Another model…" }).click();
        await inSight();
      }
    }
    await guide.getByRole("button", { name: "The carriage is in its corner" }).click();
    // Done: one line, from which it can be opened again.
    await guide.getByText("The carriage is home.").waitFor();
    await inSight();
    await guide.getByRole("button", { name: "Home again…" }).click();
    await guide.getByRole("button", { name: "Motors off" }).waitFor();
  });
});

/** The part of the window in which sheet and desk are drawn. */
async function canvasShare(): Promise<number> {
  const { width, height } = (await test.page.locator(".canvas:visible").boundingBox())!;
  const window = test.page.viewportSize()!;
  return (width * height) / (window.width * window.height);
}

/** The larger of the two shares of the canvas that the sheet fills in one dimension. */
async function sheetShare(): Promise<number> {
  const sheet = await test.onScreen("paper");
  const canvas = (await test.page.locator(".canvas:visible").boundingBox())!;
  return Math.max((sheet.right - sheet.left) / canvas.width, (sheet.bottom - sheet.top) / canvas.height);
}

describe("the sheet", () => {
  const close = () => test.page.getByRole("button", { name: "Close the panel" });

  it("has at least 55 % of a desktop's window with a panel open, and 70 % without", async () => {
    await test.page.setViewportSize({ width: 1440, height: 900 });
    await test.panel("Paper");
    expect(await canvasShare()).toBeGreaterThan(0.55);
    expect(await sheetShare()).toBeGreaterThan(0.85);
    await close().click();
    expect(await canvasShare()).toBeGreaterThan(0.7);
    expect(await sheetShare()).toBeGreaterThan(0.85);
  });

  it("fills as much of it with the desk turned", async () => {
    const turn = test.page.getByRole("button", { name: "Turn the desk" });
    for (const isUpright of [true, false, true, false]) {
      await turn.click();
      expect(await canvasShare()).toBeGreaterThan(0.7);
      expect(await sheetShare()).toBeGreaterThan(0.85);
      const { left, top, right, bottom } = await test.onScreen("paper");
      expect(bottom - top > right - left).toBe(isUpright);
    }
  });

  it("has at least half of a phone's", async () => {
    await test.page.setViewportSize({ width: 390, height: 844 });
    expect(await canvasShare()).toBeGreaterThan(0.5);
    await test.page.setViewportSize({ width: 1440, height: 900 });
  });
});

describe("a notice", () => {
  it("of a drawing with a long name stays in the window, with the button that closes it", async () => {
    const name = "a_long_name_without_a_space_".repeat(6);
    await test.drop(name, ruledSheet(1));
    await test.queue();
    const notice = test.page.locator(".notice").filter({ hasText: name });
    const close = (await notice.getByRole("button", { name: "Close" }).boundingBox())!;
    const sheet = (await test.page.locator(".canvas:visible").boundingBox())!;
    expect(close.x + close.width).toBeLessThan(sheet.x + sheet.width);
    await notice.getByRole("button", { name: "Close" }).click();
    const [{ id }] = await test.jobs();
    await test.page.request.delete(`${test.server.url}/api/v1/jobs/${id}`);
  });
});

describe("Watch without a plot at 200 % zoom", () => {
  it("says once that nothing is plotted, and leaves the low sheet free", async () => {
    const { page } = test;
    await page.setViewportSize({ width: 720, height: 450 });
    await openView(page, "Watch");
    await test.panel("Queue");
    const words = page.getByText("Nothing is being plotted.").filter({ visible: true });
    await words.first().waitFor();
    expect(await words.count()).toBe(1);
    await page.setViewportSize({ width: 1440, height: 900 });
    await openView(page, "Prepare");
  });
});

describe("the menu of the last plot in the queue", () => {
  it("opens within the window, where its plot is at the window's end", async () => {
    const { page } = test;
    await page.setViewportSize({ width: 1440, height: 620 });
    await test.panel("Queue");
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
  it("holds the whole page with all groups of settings open, also after scrolling past a panel's end", async () => {
    const { page } = test;
    await page.setViewportSize(size);
    expect(await documentPx()).toEqual({ height: size.height, scrolled: 0 });
    const panel = page.locator(".panel");
    for (const name of ["Drawing", "Paper", "Layers", "Lines", "Speed", "Plotter", "Queue"] as const) {
      await test.panel(name);
      const folded = panel.locator(".group-head[aria-expanded=false]");
      while ((await folded.count()) > 0) await folded.first().click();
      const box = (await panel.boundingBox())!;
      await page.mouse.move(box.x + 20, box.y + box.height / 2);
      // Parts that are loaded meanwhile make it longer.
      await expect
        .poll(async () => {
          await page.mouse.wheel(0, 1_000);
          return panel.evaluate(
            (element) => element.scrollTop + element.clientHeight >= element.scrollHeight - 1,
          );
        })
        .toBe(true);
      expect(await documentPx()).toEqual({ height: size.height, scrolled: 0 });
    }
    const plot = (await plotBar(page).boundingBox())!;
    expect(plot.y).toBeGreaterThanOrEqual(0);
    expect(plot.y + plot.height).toBeLessThanOrEqual(size.height);
  });
});

describe("the names of plotters", () => {
  const NAMES = ["Large plotter by the window", "The small one on the shelf"];

  /** Selects whose chosen text has less room than it needs. */
  const cut = (): Promise<string[]> =>
    test.page.evaluate(() => {
      const context = new OffscreenCanvas(1, 1).getContext("2d")!;
      return Array.from(document.querySelectorAll("select"))
        .filter((select) => select.checkVisibility())
        .flatMap((select) => {
          const style = getComputedStyle(select);
          context.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
          const text = select.selectedOptions[0]?.text ?? "";
          const roomPx = select.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
          return context.measureText(text).width > roomPx + 0.5 ? [text] : [];
        });
    });

  it.each([...SIZES, { width: 390, height: 844 }])(
    "are whole in header and queue of a window of $width × $height, and nothing is wider than it",
    async (size) => {
      const { page } = test;
      const to = `${test.server.url}/api/v1/plotters`;
      const headers = { "content-type": "application/json" };
      if ((await page.getByRole("combobox", { name: "Send to" }).count()) === 0) {
        await fetch(`${to}/main`, { method: "PATCH", headers, body: JSON.stringify({ name: NAMES[0] }) });
        const body = JSON.stringify({ name: NAMES[1], device: "virtual" });
        await fetch(to, { method: "POST", headers, body });
        await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
      }
      await page.setViewportSize(size);
      const header = page.getByRole("combobox", { name: "Send to" });
      await header.waitFor();
      expect(await header.locator("option:checked").innerText()).toBe(NAMES[0]);
      await test.panel("Queue");
      await queuePanel(page)
        .getByRole("combobox", { name: /^Plotter for / })
        .waitFor();
      expect(await cut()).toEqual([]);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(size.width);
      const help = (await page.getByRole("button", { name: "Keyboard shortcuts" }).boundingBox())!;
      expect(help.x + help.width).toBeLessThanOrEqual(size.width);
    },
  );
});
