/** The view of the simulated pen: the line that it would draw on the machine's springs, beside the planned line. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { planJob } from "../../../src/index.js";
import { machineOf, penError } from "../../../src/internal.js";
import { ASKED_COLOR } from "../../../web/scene/renderer.js";
import { ruledSheet } from "../../support/drawings/drawings.js";
import { seriousFindings } from "../../support/browser/axe.js";
import { colorCounts, waitForPicture } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const PATIENCE_MS = 120_000;
const STEPS = `<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="120mm" viewBox="0 0 120 120"><path d="M10 10v25h25v25h25v25h25" fill="none" stroke="#000"/></svg>`;
const ASSUMED = { xHz: 15, yHz: 25, damping: 0.05 };

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.firstVisit("simulated-pen");
  await test.drop("steps", STEPS);
}, PATIENCE_MS);

afterAll(async () => test.close());

const legend = () => test.page.getByRole("figure", { name: "Legend of the simulated pen" });
const result = () => legend().locator("[data-max-mm]");
const maxMm = async (): Promise<number> => Number(await result().getAttribute("data-max-mm"));
/** Without what is at the edges of the sheet: rulers, the drawing's name, the legend. */
const colors = async (): Promise<Map<number, number>> => {
  // Off the drawing, so that no tooltip for a stroke appears.
  await test.page.mouse.move(700, 20);
  await waitForPicture(test.page);
  const { x, y, width, height } = (await test.page.locator(".stage").boundingBox())!;
  return colorCounts(test.page, { x: x + 26, y: y + 50, width: width - 26, height: height - 90 });
};
const ASKED = Number.parseInt(ASKED_COLOR.slice(1), 16) & 255;
/** Number of pixels of the thin planned line: greys between the grid's and the line's own. */
const askedPixels = (counts: Map<number, number>): number =>
  [...counts].reduce((sum, [rgb, n]) => {
    const [r, g, b] = [(rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255];
    const isGrey = Math.max(r, g, b) - Math.min(r, g, b) < 25;
    return sum + (isGrey && b >= ASKED - 10 && b < 200 ? n : 0);
  }, 0);

describe("the view of the simulated pen", () => {
  it("has the same maximum as the command line, on assumed springs where none were measured", async () => {
    await test.look("Pen (simulated)");
    await result().waitFor();
    await legend().getByText("Assumed swing: 15 Hz along x, 25 Hz along y.", { exact: false }).waitFor();
    await legend().getByRole("button", { name: "Measure yours…" }).waitFor();
    const job = await test.queue();
    const strokes = await test.strokesOf(job);
    const { trajectory } = planJob({ strokes }, job.settings, machineOf(job.settings), { firmware: "2.8.1" });
    const error = penError(strokes, trajectory, ASSUMED);
    expect(await maxMm()).toBeCloseTo(error.maxMm, 3);
    expect(await legend().innerText()).toContain(`At most ${Number(error.maxMm.toFixed(2))} mm`);
    for (const colorScheme of ["light", "dark"] as const) {
      await test.page.emulateMedia({ colorScheme });
      expect(await seriousFindings(test.page)).toEqual([]);
    }
    await test.page.emulateMedia({ colorScheme: "light" });
  });

  it("draws the pen in colours of its error, with the drawing beside it", async () => {
    const { page } = test;
    const paper = await test.onScreen("paper");
    const far = await colors();
    // On a corner of the line, 60 mm from the paper's.
    const cornerPx = (60 / 297) * (paper.right - paper.left);
    await page.mouse.move(paper.left + cornerPx, paper.top + cornerPx);
    await page.keyboard.down("Control");
    for (let i = 0; i < 8; i++) await page.mouse.wheel(0, -100);
    await page.keyboard.up("Control");
    const near = await colors();
    // Warm colours are large errors: the ramp goes from indigo over magenta to orange.
    const warm = (counts: Map<number, number>): number =>
      [...counts].reduce((sum, [rgb, n]) => sum + (rgb >> 16 > 200 && (rgb & 255) < 120 ? n : 0), 0);
    expect(warm(far)).toBeGreaterThan(5);
    expect(askedPixels(near)).toBeGreaterThan(50);
    await page.getByRole("button", { name: "Whole paper" }).click();
  });

  it("follows the settings, and disappears with the view", async () => {
    const before = await maxMm();
    await test.panel("Speed");
    await test.page.locator("#group-motion").getByText("Details", { exact: true }).click();
    const down = test.page.locator("#group-motion").getByRole("group", { name: "Pen down" });
    await down.getByLabel("Acceleration", { exact: true }).fill("2500");
    await expect.poll(maxMm).toBeGreaterThan(1.3 * before);
    await test.look("Speed");
    await test.page.getByRole("img", { name: "Speed legend" }).waitFor();
    expect(await legend().count()).toBe(0);
  });

  it("opens with one click from where the plotter's swing is set", async () => {
    await test.page.getByRole("button", { name: "Show what the pen draws" }).click();
    await result().waitFor();
    await test.look("Speed");
    expect(await legend().count()).toBe(0);
  });

  it("works with another drawing", async () => {
    await test.look("Pen (simulated)");
    await test.drop("lines", ruledSheet());
    await test.drop("steps", STEPS);
    await result().waitFor();
    expect(test.complaints).toEqual([]);
  });
});
