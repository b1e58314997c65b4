/**
 * The page without a server, whose tab is killed at random instants of a plot. PLOTWRIGHT_KILLS=20, or the full run: that
 * many times.
 */
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { crash } from "../../support/browser/backends.js";
import { launchBrowser } from "../../support/browser/browser.js";
import { countFor } from "../../support/runs/full-run.js";
import { seeded } from "../../support/plots/live-plot.js";
import { SerialPages } from "../../support/browser/serial-page.js";

const KILLS = countFor("PLOTWRIGHT_KILLS", 20, 1);
/** Seconds of the board per second. */
const BOARD_SPEED = 3;

let browser: Browser;

beforeAll(async () => {
  browser = await launchBrowser();
});
afterAll(() => browser.close());

describe("the page without a server", () => {
  it("loses and doubles nothing when a tab is killed", { timeout: 60_000 + KILLS * 120_000 }, async () => {
    const random = seeded(22);
    for (let kill = 0; kill < KILLS; kill++) {
      const pages = await SerialPages.start(browser, BOARD_SPEED);
      try {
        const page = await pages.openPage();
        await pages.plotComb(page, 3);
        const atS = 1 + 5 * random();
        await expect.poll(() => pages.board.statistics().movingS, { interval: 20 }).toBeGreaterThan(atS);
        await crash(page);
        const next = await pages.openPage();
        await pages.recover(next);
        expect({ atS, ...(await pages.combFaults(next, 3)) }).toMatchObject({ isGood: true });
      } finally {
        await pages.close();
      }
    }
  });
});
