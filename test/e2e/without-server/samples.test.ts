/** The samples, plotted by the page without a server: the board ends with the steps of a plot by the library. */
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { describe, expect, it } from "vitest";
import { IS_FULL } from "../../support/runs/full-run.js";
import { plotting } from "../../support/plots/live-plot.js";
import { openGroup } from "../../support/browser/page-actions.js";
import { done, storedJob, useSerialPages } from "../../support/browser/serial-page.js";
import { strokesInBrowser } from "../../support/browser/strokes-in-browser.js";

/** The samples take 10 to 20 minutes each on a real board. */
const BOARD_SPEED = 100;
const SAMPLES = [
  ["Whirling triangles", "whirling-triangles"],
  ["Hello paper", "hello-paper"],
  ["Flower meadow", "flower-meadow"],
] as const;
const PLOTTED = IS_FULL ? SAMPLES : SAMPLES.slice(0, 1);

const startPages = useSerialPages();

/** Otherwise a busy computer lowers the pen up to 0.1 mm late on its way, and the lines differ by that. */
async function waitWithPen(page: Page): Promise<void> {
  await openGroup(page, "Plotter", "Lifting the pen");
  await page
    .getByRole("group", { name: "Move while the pen lifts" })
    .getByRole("radio", { name: "Off" })
    .check();
}

describe("the page without a server", () => {
  it.each(PLOTTED)("plots the sample %s to the step", { timeout: 300_000 }, async (title, file) => {
    const pages = await startPages(BOARD_SPEED);
    const page = await pages.openPage();
    await page.getByRole("button", { name: title }).click();
    await waitWithPen(page);
    await pages.plot(page);
    await done(page);
    const { settings } = await storedJob(page);
    const strokes = await strokesInBrowser(page, readFileSync(`samples/${file}.svg`, "utf8"), settings);
    const { world, board, run } = await plotting(
      settings.motion.mode,
      strokes,
      "2.8.1",
      settings.pen,
      settings,
    );
    await world.run(run.finished);
    const { steps1, steps2 } = pages.board.state();
    expect([steps1, steps2]).toEqual([board.state().steps1, board.state().steps2]);
    expect(pages.board.drawn()).toEqual(board.drawn());
  });
});
