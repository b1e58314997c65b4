/** The page without a server: a reload and a second tab while it plots on the board. */
import { describe, expect, it } from "vitest";
import { historyPanel, statusCard } from "../../support/browser/page-actions.js";
import { expectState, useSerialPages } from "../../support/browser/serial-page.js";

const startPages = useSerialPages();

describe("the page without a server", () => {
  it("recovers after a reload in the middle of a plot", { timeout: 300_000 }, async () => {
    const pages = await startPages(3);
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
