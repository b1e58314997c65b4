/** The page without a server: a reload, a hidden tab and a second tab while it plots on the board. */
import { describe, expect, it } from "vitest";
import { IS_FULL } from "../support/full-run.js";
import { historyPanel, statusCard } from "../support/page-actions.js";
import { done, expectState, useSerialPages } from "../support/serial-page.js";
import { startTabbedBrowser } from "../support/tabbed-browser.js";

const HIDDEN_S = IS_FULL ? 360 : 20;

const startPages = useSerialPages();

describe("the page without a server", () => {
  it("plots without an underrun while its tab is hidden", { timeout: (HIDDEN_S + 200) * 1_000 }, async () => {
    // Of 4 s each: longer than the tab is hidden.
    const lines = Math.ceil(HIDDEN_S / 4) + 3;
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

  it("recovers after a reload in the middle of a plot", { timeout: 300_000 }, async () => {
    const pages = await startPages(1);
    const page = await pages.openPage();
    await pages.plotComb(page, 4);
    await expect.poll(() => pages.board.statistics().movingS).toBeGreaterThan(2);
    await page.reload();
    await pages.recover(page);
    expect(await pages.combFaults(page, 4)).toMatchObject({ isGood: true });
  });

  it("lets one tab operate while another one watches", { timeout: 300_000 }, async () => {
    const pages = await startPages(1);
    const page = await pages.openPage();
    await pages.plotComb(page, 20);
    await expectState(page, /^Plotting/);
    const other = await pages.openPage();
    await other.getByText("Another tab is operating.").waitFor();
    await expectState(other, /^Plotting: comb/);
    // It can't change anything, nor take over while the other one plots, but it can stop the plot.
    await other.getByRole("button", { name: "Take over" }).click();
    await other.getByText("The other tab is plotting.").waitFor();
    await statusCard(other).getByRole("button", { name: "Cancel" }).click();
    await other.getByRole("button", { name: "Cancel the plot" }).click();
    await historyPanel(page).getByText("Cancelled").first().waitFor();
    // Idle, it is handed over.
    await other.getByRole("button", { name: "Take over" }).click();
    await page.getByText("Another tab is operating.").waitFor();
    await other.getByText("Another tab is operating.").waitFor({ state: "detached" });
    // The operator is closed: the other one's worker takes over.
    await other.close();
    await page.getByText("Another tab is operating.").waitFor({ state: "detached" });
    await expectState(page, /Ready/);
  });
});
