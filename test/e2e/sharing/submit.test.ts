/** The page on a device that may only add drawings to the queue, as a student's in a classroom. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { launchBrowser } from "../../support/browser/browser.js";
import { ruledSheet } from "../../support/drawings/drawings.js";
import {
  chooseSample,
  dropFile,
  historyPanel,
  openPanel,
  openView,
  plotBar,
  queuePanel,
  waitForPlan,
} from "../../support/browser/page-actions.js";
import { pairedPage } from "../../support/browser/paired-page.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";

const data = temporaryFolder("submit");
const VIEWPORT = { width: 1100, height: 700 };
let browser: Browser;
let server: ServerProcess;
let teacher: Page;
let anna: Page;
let ben: Page;

beforeAll(async () => {
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path, virtualSpeed: 20, args: ["--pair-always"] });
  teacher = await pairedPage(browser, server, "operate", VIEWPORT);
  anna = await pairedPage(browser, server, "submit", VIEWPORT);
  ben = await pairedPage(browser, server, "submit", VIEWPORT);
  for (const page of [teacher, anna, ben]) await chooseSample(page);
});

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

async function submit(page: Page, name: string): Promise<void> {
  await dropFile(page, `${name}.svg`, ruledSheet());
  await page.getByText(name).first().waitFor();
  await waitForPlan(page);
  await openPanel(page, "Queue");
  await plotBar(page).getByRole("button", { name: "Add to queue", exact: true }).click();
  await queuePanel(page).getByText(name).waitFor();
}

const buttonCount = (page: Page, name: RegExp): Promise<number> => page.getByRole("button", { name }).count();

describe("the page of a device that may only submit", () => {
  it("lays out a drawing and adds it to the queue, and has no button for the machine", async () => {
    await anna.getByText("This device can add drawings to the queue").waitFor();
    await submit(anna, "annas");
    for (const name of [
      /^Plot$/,
      /^Start /,
      /^Pen (up|down)/,
      /^Home/,
      /Motors off/,
      /^Test line/,
      /Take over/,
      /^Sharing/,
      /Set up/,
      /^Console/,
      /^Plotter$/,
    ]) {
      expect([String(name), await buttonCount(anna, name)]).toEqual([String(name), 0]);
    }
    expect(await anna.getByLabel("Height up", { exact: true }).count()).toBe(0);
    expect(await anna.getByRole("radio", { name: "Start the next" }).count()).toBe(0);
    expect(await anna.getByRole("alert").count()).toBe(0);
  }, 120_000);

  it("shows its own jobs only, and the operator all of them, with who sent them", async () => {
    await submit(ben, "bens");
    await openPanel(teacher, "Queue");
    await queuePanel(teacher).getByText("annas").waitFor();
    await queuePanel(teacher).getByText("bens").waitFor();
    await queuePanel(teacher)
      .getByText(/from Chrome.* on /)
      .first()
      .waitFor();
    expect(await queuePanel(ben).getByText("annas").count()).toBe(0);
    expect(await queuePanel(anna).getByText("bens").count()).toBe(0);
    // Neither asked for the operator's lock, nor has it.
    expect(await teacher.getByText("is operating.").count()).toBe(0);
  }, 120_000);

  it("withdraws its own job while that waits, watches and stops its plot, and can't resume it", async () => {
    await submit(anna, "mistake");
    await queuePanel(anna).getByRole("button", { name: "More for mistake" }).click();
    await anna.getByRole("button", { name: "Remove mistake" }).click();
    await expect.poll(() => queuePanel(teacher).getByText("mistake").count()).toBe(0);
    await queuePanel(teacher).getByRole("button", { name: "Start annas" }).click();
    await queuePanel(anna).getByText("Plotting").waitFor();
    await openView(anna, "Watch");
    await anna.getByRole("button", { name: "Pause" }).first().click();
    await queuePanel(anna).getByText("Paused").waitFor();
    expect(await buttonCount(anna, /Resume/)).toBe(0);
    await openView(teacher, "Watch");
    await teacher.getByRole("button", { name: "Resume" }).first().click();
    await historyPanel(anna).getByText("annas").waitFor({ timeout: 60_000 });
    expect(await historyPanel(ben).getByText("annas").count()).toBe(0);
    expect(await anna.getByRole("alert").count()).toBe(0);
  }, 120_000);
});
