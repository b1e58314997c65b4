/**
 * The page without a server plots while its tab is hidden. Like the tests on a pseudo-terminal, it would have underruns
 * if other tests kept the processor busy.
 */
import { describe, expect, it } from "vitest";
import { IS_FULL } from "../support/runs/full-run.js";
import { done, useSerialPages } from "../support/browser/serial-page.js";
import { startTabbedBrowser } from "../support/browser/tabbed-browser.js";

const HIDDEN_S = IS_FULL ? 360 : 20;

const startPages = useSerialPages();

describe("the page without a server", () => {
  it("plots without an underrun while its tab is hidden", { timeout: (HIDDEN_S + 200) * 1_000 }, async () => {
    // Of 4 s each, besides travel and pen moves: longer than the tab is hidden.
    const lines = Math.ceil(HIDDEN_S / 4) + 1;
    const pages = await startPages(1, startTabbedBrowser);
    const page = await pages.openPage();
    await pages.plotComb(page, lines);
    await expect.poll(() => pages.board.statistics().movingS).toBeGreaterThan(1);
    const front = await pages.context.newPage();
    await front.bringToFront();
    await expect.poll(() => page.evaluate(() => document.visibilityState)).toBe("hidden");
    const before = pages.board.statistics();
    await new Promise((resolve) => setTimeout(resolve, HIDDEN_S * 1_000));
    expect(await page.evaluate(() => document.visibilityState)).toBe("hidden");
    const after = pages.board.statistics();
    expect(after.movingS - before.movingS).toBeGreaterThan(0.5 * HIDDEN_S);
    expect(after.underrunCount).toBe(before.underrunCount);
    await page.bringToFront();
    await done(page);
    expect(await pages.combFaults(page, lines)).toMatchObject({ isGood: true });
  });
});
