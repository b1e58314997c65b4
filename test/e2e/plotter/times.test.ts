/** Times in the queue and in Watch: durations in words, the day if it is not today, no end time while a plot is held. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { queuePanel, statusCard } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const PATIENCE_MS = 120_000;
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="280mm" height="200mm" viewBox="0 0 280 200" fill="none" stroke="#000">${Array.from(
  { length: 90 },
  (_, i) => `<path d="M5 ${5 + 2 * i}H275"/>`,
).join("")}</svg>`;
/** 90 lines of 270 mm at 0.4 mm/s: 17 hours. */
const SLOW = {
  ...DEFAULT_PLOT_SETTINGS,
  prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, fit: false },
  motion: {
    ...DEFAULT_PLOT_SETTINGS.motion,
    draw: { ...DEFAULT_PLOT_SETTINGS.motion.draw, speedMmPerS: 0.4 },
  },
};
/** "18 h 30 min": never "18:30", which could be a time of day. */
const HOURS = /\b1\d h( \d+ min)?/;
const EARLIEST = /All done (Mon|Tue|Wed|Thu|Fri|Sat|Sun) \d\d:\d\d at the earliest/;
const DONE_ON_A_DAY = /done (Mon|Tue|Wed|Thu|Fri|Sat|Sun) \d\d:\d\d/;

let test: PageTest;

beforeAll(async () => {
  // Early in the evening: 17 hours later it is another day.
  test = await PageTest.firstVisit("times");
  await test.page.clock.setFixedTime(new Date("2026-11-21T18:41:00"));
  // The page reads the clock every few seconds only: loaded anew, it has never seen another time.
  await test.page.reload();
  const body = { name: "slow", drawing: SVG, settings: SLOW };
  const headers = { "content-type": "application/json" };
  for (let i = 0; i < 2; i++) {
    await fetch(`${test.server.url}/api/v1/jobs`, { method: "POST", headers, body: JSON.stringify(body) });
  }
}, PATIENCE_MS);

afterAll(async () => test.close());

const wordsOf = async (locator: ReturnType<typeof queuePanel>): Promise<string> =>
  (await locator.innerText()).replace(/[\u202f\u00a0]/g, " ");

describe("a queue of many hours", () => {
  it("says how long it takes, in words, and when it would end if it were started now", async () => {
    const { page } = test;
    await test.panel("Queue");
    await queuePanel(page).getByText("×2").waitFor();
    await expect.poll(() => wordsOf(queuePanel(page))).toMatch(/2 plots, 3\d h/);
    expect(await wordsOf(queuePanel(page))).toMatch(/Times if you start now/);
    expect(await wordsOf(queuePanel(page))).toMatch(/18:41–\w\w\w \d\d:\d\d/);
    // Somebody must put in new paper before the second copy.
    expect(await wordsOf(queuePanel(page))).toMatch(/new paper after each copy/i);
    expect(await wordsOf(queuePanel(page))).toMatch(EARLIEST);
  });

  it("names the day on which the running plot is done", async () => {
    const { page } = test;
    await queuePanel(page)
      .getByRole("button", { name: /^Start slow/ })
      .click();
    await expect.poll(() => wordsOf(statusCard(page))).toMatch(DONE_ON_A_DAY);
    expect(await wordsOf(statusCard(page))).toMatch(HOURS);
    expect(await wordsOf(queuePanel(page))).toMatch(DONE_ON_A_DAY);
  });

  it("has no such time while it is paused", async () => {
    const { page } = test;
    await statusCard(page).getByRole("button", { name: "Pause" }).click();
    await statusCard(page).getByRole("button", { name: "Resume" }).waitFor();
    expect(await wordsOf(statusCard(page))).toMatch(HOURS);
    for (const part of [statusCard(page), queuePanel(page)]) expect(await wordsOf(part)).not.toMatch(/done/);
    expect(await wordsOf(queuePanel(page))).toMatch(/The end is not known yet/);
    expect(test.complaints).toEqual([]);
  });
});
