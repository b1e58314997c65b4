/** The plotter's own settings are the same on every screen, and a first plot takes few clicks. */
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { snapshotSchema, type Snapshot } from "../../../src/schema/index.js";
import { dropFile, openPanel, plotBar, waitForPlan } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">
  <path fill="none" stroke="#000" d="M5 5H55V35H5Z"/></svg>`;

let test: PageTest;
let phone: Page;

beforeAll(async () => {
  test = await PageTest.firstVisit("pen-at-hand");
});

afterAll(async () => test.close());

const panel = (page: Page) => page.getByRole("region", { name: "Plotter", exact: true });
const height = (page: Page, which: "up" | "down") =>
  panel(page).getByLabel(`Height ${which}`, { exact: true });
const state = async (): Promise<Snapshot> =>
  snapshotSchema.parse(await (await fetch(`${test.server.url}/api/v1/state`)).json());
const storedPen = async () => (await state()).plotterSettings["main"]?.pen;

describe("model and heights that are set on one screen", () => {
  it("are the plotter's, and on every other screen", async () => {
    const { page } = test;
    expect((await state()).plotterSettings).toEqual({});
    await test.group("Plotter", "Model and position");
    await page.getByLabel("Model", { exact: true }).selectOption("axidraw-se-a3");
    await height(page, "up").fill("70");
    await height(page, "down").fill("41");
    await expect.poll(storedPen).toMatchObject({ upPct: 70, downPct: 41 });
    await expect.poll(async () => (await state()).plotters[0].machine).toBe("axidraw-se-a3");
    const context = await test.browser.newContext({ viewport: { width: 390, height: 844 } });
    phone = await context.newPage();
    await phone.goto(test.server.url);
    await openPanel(phone, "Plotter");
    await expect.poll(() => height(phone, "up").inputValue()).toBe("70");
    expect(await height(phone, "down").inputValue()).toBe("41");
    const model = phone.getByLabel("Model", { exact: true });
    await expect.poll(() => model.inputValue()).toBe("axidraw-se-a3");
  });
});

describe("two screens", () => {
  it("have the same heights, and undo on one of them is seen on the other", async () => {
    const { page } = test;
    await height(page, "down").fill("35");
    await expect.poll(() => height(phone, "down").inputValue()).toBe("35");
    expect(await storedPen()).toMatchObject({ downPct: 35 });
    await page.getByRole("button", { name: "Undo" }).click();
    await expect.poll(() => height(phone, "down").inputValue()).toBe("41");
    expect(await storedPen()).toMatchObject({ downPct: 41 });
  });
});

describe("a first plot", () => {
  it("takes at most 8 clicks after the file was dropped: home, heights, a test line, plot", async () => {
    const { page } = test;
    await panel(page).getByText("First plot with this plotter").waitFor();
    await page.evaluate(() => {
      const counted = window as unknown as { clickCount: number };
      counted.clickCount = 0;
      addEventListener("pointerdown", () => counted.clickCount++, { capture: true });
    });
    await dropFile(page, "box.svg", SVG);
    await waitForPlan(page);
    const press = (name: string) =>
      panel(page).getByRole("button", { name, exact: true }).and(page.locator(":enabled")).click();
    await press("The carriage is in its corner");
    // The step folds, and the heights move up.
    await panel(page).getByText("The carriage is home.").waitFor();
    // The pen follows the slider: no other click is needed to see it there.
    const slider = panel(page).locator(".pen-heights input[type=range]").nth(1);
    const box = (await slider.boundingBox())!;
    await page.mouse.move(box.x + box.width * 0.41, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.3, box.y + box.height / 2, { steps: 8 });
    await page.mouse.up();
    const downPct = Number(await height(page, "down").inputValue());
    expect(downPct).toBeLessThan(38);
    await expect.poll(async () => (await state()).plotters[0].penUp).toBe(false);
    await expect.poll(storedPen).toMatchObject({ downPct });
    await press("Pen up");
    await expect.poll(async () => (await state()).plotters[0].penUp).toBe(true);
    await press("Draw a test line");
    await plotBar(page)
      .getByRole("button", { name: "Plot", exact: true })
      .and(page.locator(":enabled"))
      .click();
    await expect.poll(async () => (await state()).jobs[0]?.state).toBe("done");
    expect(
      await page.evaluate(() => (window as unknown as { clickCount: number }).clickCount),
    ).toBeLessThanOrEqual(8);
    const [job] = await test.jobs();
    expect([job.settings.machine, job.settings.pen.downPct]).toEqual(["axidraw-se-a3", downPct]);
    await panel(page).getByText("First plot with this plotter").waitFor({ state: "detached" });
  });

  it("is followed by plots that take at most 2 clicks each", async () => {
    const { page } = test;
    const before = await page.evaluate(() => (window as unknown as { clickCount: number }).clickCount);
    await dropFile(page, "box2.svg", SVG);
    await test.planned();
    await plotBar(page)
      .getByRole("button", { name: "Plot", exact: true })
      .and(page.locator(":enabled"))
      .click();
    await expect
      .poll(async () => (await state()).jobs.filter(({ state: now }) => now === "done").length)
      .toBe(2);
    const after = await page.evaluate(() => (window as unknown as { clickCount: number }).clickCount);
    expect(after - before).toBeLessThanOrEqual(2);
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
