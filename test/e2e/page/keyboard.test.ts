/** From load to Plot by keyboard alone, in few stops. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { statusCard, waitForPlotButton } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const MAX_STOPS = 12;
/** Boxes inside each other, so that the plot lasts while the page is loaded again. */
const BOXES = Array.from({ length: 14 }, (_, i) => `M${5 + i} ${5 + i}H${55 - i}V${35 - i}H${5 + i}Z`).join(
  "",
);
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">
  <path fill="none" stroke="#000" d="${BOXES}"/></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.firstVisit("keyboard", {}, ["--virtual-speed", "2"]);
});

afterAll(async () => test.close());

const focused = async (): Promise<string> =>
  (
    await test.page.evaluate(() => {
      const element = document.activeElement;
      return element?.getAttribute("aria-label") ?? element?.textContent ?? "";
    })
  ).trim();

/** Presses Tab until a control of that name has the focus; returns how often. */
async function stopsTo(name: string): Promise<number> {
  for (let stops = 1; stops <= 200; stops++) {
    await test.page.keyboard.press("Tab");
    if ((await focused()) === name) return stops;
  }
  throw new Error(`Tab never reached "${name}"`);
}

describe("the keyboard", () => {
  it("reaches Plot from the load in at most 12 stops, and then the plot's buttons", async () => {
    const { page } = test;
    await test.drop("box", SVG);
    await page.reload();
    await test.planned();
    // Tab skips a button that is disabled.
    await waitForPlotButton(page);
    let stops = await stopsTo("Skip to Plot");
    await page.keyboard.press("Enter");
    expect(await focused()).toBe("Plot");
    expect(stops).toBeLessThanOrEqual(MAX_STOPS);
    await page.keyboard.press("Enter");
    await statusCard(page).getByRole("button", { name: "Pause" }).waitFor();
    await page.reload();
    await statusCard(page).getByRole("button", { name: "Pause" }).waitFor();
    stops = await stopsTo("Skip to the plot’s buttons");
    await page.keyboard.press("Enter");
    expect(await focused()).toBe("Pause");
    expect(stops).toBeLessThanOrEqual(MAX_STOPS);
  });

  it("goes on from the sheet after a sample was opened from it", async () => {
    const { page } = test;
    const context = await page
      .context()
      .browser()!
      .newContext({ viewport: { width: 1440, height: 900 } });
    const fresh = await context.newPage();
    await fresh.goto(page.url());
    // The page learns of the plot then, and opens Watch.
    await fresh
      .getByRole("banner")
      .getByRole("status")
      .filter({ hasText: /Plotting|Ready|Virtual/ })
      .waitFor();
    await fresh.getByRole("group", { name: "View" }).getByRole("button", { name: "Prepare" }).click();
    await fresh.getByRole("region", { name: "Or try a sample" }).getByRole("button").first().focus();
    await fresh.keyboard.press("Enter");
    await expect
      .poll(() => fresh.evaluate(() => document.activeElement?.getAttribute("aria-label")))
      .toMatch(/^Arrow keys move the paper/);
    await context.close();
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
