/** A plot that waits for a pen, or was reopened: the page shows its progress, and never all of it as drawn. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Job } from "../../../src/schema/index.js";
import { combOf, expectPartlyDrawn, expectShareOnCanvas, SHARP } from "../../support/browser/half-drawn.js";
import { historyPanel, openView, plotBar, statusCard } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const LIMIT_MS = 120_000;
const NAME = "two pens for a card, 28 November";
const WAITS = "Waits for the pen for “Red”";

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.firstVisit("pen-change", SHARP);
}, LIMIT_MS);

afterAll(async () => test.close());

const theJob = async (): Promise<Job> => (await test.jobs()).find(({ name }) => name === NAME)!;
const history = () => historyPanel(test.page);

describe("a plot that waits for a pen", () => {
  it("is shown at its position, and on a page that is opened then", async () => {
    await test.drop(NAME, combOf("Blue", "!Red"));
    await plotBar(test.page).getByRole("button", { name: "Plot", exact: true }).click();
    await expect.poll(async () => (await theJob())?.wait?.layerName).toContain("Red");
    await expectPartlyDrawn(test.page, await theJob(), WAITS);
    await test.page.reload();
    await expectPartlyDrawn(test.page, await theJob(), WAITS);
  });

  it("sets the new pen on the paper and lifts it again, by buttons that say how it is", async () => {
    const { page } = test;
    const button = (name: string) => statusCard(page).getByRole("button", { name, exact: true });
    const isUp = async (): Promise<unknown> => {
      const state: unknown = await (await page.request.get(`${test.server.url}/api/v1/state`)).json();
      return (state as { plotters: { penUp: boolean }[] }).plotters[0].penUp;
    };
    for (const [name, other, up] of [
      ["Pen down", "Pen up", false],
      ["Pen up", "Pen down", true],
    ] as const) {
      await button(name).click();
      await expect.poll(isUp).toBe(up);
      await expect.poll(() => button(name).getAttribute("aria-pressed")).toBe("true");
      expect(await button(other).getAttribute("aria-pressed")).toBe("false");
    }
    expect((await theJob()).wait?.layerName).toContain("Red");
  });
});

describe("the pen that a plot waits for", () => {
  const PHONE = { width: 390, height: 844 };
  const DESK = { width: 1440, height: 900 };

  it("is asked for in one place in Prepare, at any size", async () => {
    const { page } = test;
    await openView(page, "Prepare");
    await test.panel("Queue");
    for (const size of [PHONE, DESK]) {
      await page.setViewportSize(size);
      for (const name of ["Continue", "Cancel", "Pen down"]) {
        const shown = page.getByRole("button", { name, exact: true }).filter({ visible: true });
        expect(`${name}: ${await shown.count()}`).toBe(`${name}: 1`);
      }
    }
    await openView(page, "Watch");
  });

  it("leaves the sheet of Watch as much of the window as any plot", async () => {
    const { page } = test;
    const share = async ({ width, height }: typeof DESK): Promise<number> => {
      await page.setViewportSize({ width, height });
      const canvas = (await page.locator(".canvas:visible").boundingBox())!;
      return (canvas.width * canvas.height) / (width * height);
    };
    // With the panel of the queue open.
    expect(await share(PHONE)).toBeGreaterThan(0.22);
    expect(await share(DESK)).toBeGreaterThan(0.55);
  });
});

describe("a plot that was cancelled half way", () => {
  it("is shown at its position as soon as it is recovered, and waits for the pen again", async () => {
    const { id } = await theJob();
    await test.page.request.post(`${test.server.url}/api/v1/jobs/${id}/cancel`);
    await expect.poll(async () => (await theJob()).state).toBe("cancelled");
    // Its name is shown whole.
    const name = history().getByRole("article").locator(".job-name");
    await name.waitFor();
    const [wide, high] = await name.evaluate((element) => [
      element.scrollWidth - element.clientWidth,
      element.scrollHeight - element.clientHeight,
    ]);
    expect(Math.max(wide, high)).toBeLessThanOrEqual(1);
    await history()
      .getByRole("button", { name: `Go on from where it was cancelled: ${NAME}` })
      .click();
    await expect.poll(async () => (await theJob()).state).toBe("paused");
    await expectPartlyDrawn(test.page, await theJob(), WAITS);
  });

  it("is shown partly drawn in Prepare, too, where it lies on the paper", async () => {
    await openView(test.page, "Prepare");
    await test.look("Ink");
    await expectShareOnCanvas(test.page, await theJob(), "Preview");
  });

  it("is shown partly drawn where it was opened from the history", async () => {
    const { page } = test;
    const { id } = await theJob();
    await page.request.post(`${test.server.url}/api/v1/jobs/${id}/cancel`);
    await test.panel("Queue");
    await history()
      .getByRole("button", { name: `More for ${NAME}` })
      .click();
    await history()
      .getByRole("button", { name: `Open ${NAME}` })
      .click();
    await test.planned();
    await test.panel("Queue");
    await history()
      .getByRole("button", { name: `Go on from where it was cancelled: ${NAME}` })
      .click();
    await expect.poll(async () => (await theJob()).state).toBe("paused");
    await expectPartlyDrawn(page, await theJob(), WAITS);
    await openView(page, "Prepare");
    await expectShareOnCanvas(page, await theJob(), "Preview");
    expect(test.complaints).toEqual([]);
  });
});
