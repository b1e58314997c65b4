/**
 * Several browsers on one server: the same view, one operator, watchers, and a browser that loses its
 * network.
 */
import type { Browser, Locator, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import { ruledSheet } from "../../support/drawings/drawings.js";
import {
  chooseSample,
  dropFile,
  historyPanel,
  openPanel,
  openView,
  plotBar,
  queuePanel,
  statusCard,
  waitForPlan,
} from "../../support/browser/page-actions.js";
import { pairedPage } from "../../support/browser/paired-page.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";

const data = temporaryFolder("two-browsers");
/** Small, because three pages draw it in software. */
const VIEWPORT = { width: 900, height: 600 };
let browser: Browser;
let server: ServerProcess;
let anna: Page;
let ben: Page;
let watcher: Page;

beforeAll(async () => {
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path, virtualSpeed: 4, args: ["--pair-always"] });
  anna = await pairedPage(browser, server, "operate", VIEWPORT);
  ben = await pairedPage(browser, server, "operate", VIEWPORT);
  watcher = await pairedPage(browser, server, "watch", VIEWPORT);
  for (const page of [anna, ben]) await chooseSample(page);
  // A watcher has nothing to lay out.
  await statusCard(watcher).getByText("Nothing is being plotted").first().waitFor();
});

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

const pages = (): readonly Page[] => [anna, ben, watcher];
const plotButton = (page: Page): Locator =>
  plotBar(page).getByRole("button", { name: "Add to queue", exact: true });

/** In per cent, as the queue of the page shows it. */
const share = (page: Page): Promise<string | null> =>
  queuePanel(page).getByRole("progressbar").getAttribute("aria-valuenow");

describe("two browsers and a watcher", () => {
  it("see the same queue and the same progress", async () => {
    await dropFile(anna, "lines.svg", ruledSheet());
    await anna.getByText("lines").first().waitFor();
    await waitForPlan(anna);
    await plotButton(anna).click();
    await openPanel(anna, "Queue");
    await queuePanel(anna)
      .getByRole("button", { name: /^Start / })
      .click();
    for (const page of pages()) {
      await queuePanel(page).getByText("lines").waitFor();
      await queuePanel(page).getByText("Plotting").waitFor();
      await expect.poll(async () => Number(await share(page))).toBeGreaterThan(0);
    }
    // Paused, it keeps the progress that all pages show. While it is watched, its buttons are not in the queue.
    await statusCard(anna).getByRole("button", { name: "Pause" }).click();
    for (const page of pages()) await queuePanel(page).getByText("Paused").waitFor();
    await expect.poll(async () => new Set(await Promise.all(pages().map(share))).size).toBe(1);
    await statusCard(anna).getByRole("button", { name: "Resume" }).click();
    for (const page of pages()) await queuePanel(page).getByText("Plotting").waitFor();
  });

  it("the watcher sees the plot and who operates, may stop it, and has nothing to change", async () => {
    await watcher.getByText("this device can watch").waitFor();
    expect(await plotButton(watcher).count()).toBe(0);
    expect(await watcher.getByLabel("Choose a drawing").isVisible()).toBe(false);
    expect(await watcher.getByRole("button", { name: "Prepare" }).count()).toBe(0);
    await expect.poll(() => statusCard(watcher).innerText()).toMatch(/lines.*left.*%/s);
    await queuePanel(watcher).locator(".thumb img").first().waitFor();
    for (const name of [/^Start /, /^Remove /, "Resume", "Pen up", "Home"]) {
      expect(await watcher.getByRole("button", { name }).count()).toBe(0);
    }
    await statusCard(watcher).getByRole("button", { name: "Emergency stop" }).waitFor();
    const statuses = await watcher.evaluate(async () => {
      const { jobs } = (await (await fetch("/api/v1/state")).json()) as { jobs: { id: string }[] };
      const ask = async (method: string, path: string, body?: unknown): Promise<number> =>
        (
          await fetch(`/api/v1${path}`, {
            method,
            headers: { "content-type": "application/json" },
            body: JSON.stringify(body ?? {}),
          })
        ).status;
      return Promise.all([
        ask("PATCH", "/queue", { runOn: true }),
        ask("POST", `/jobs/${jobs[0].id}/duplicate`),
        ask("PATCH", `/jobs/${jobs[0].id}`, { name: "mine" }),
        ask("POST", "/operator/take"),
        ask("POST", "/access/keys", { name: "me", role: "operate" }),
      ]);
    });
    expect(statuses.every((status) => status === 401 || status === 403)).toBe(true);
  });

  it("one operates until the other takes over", async () => {
    for (const page of [anna, ben]) await openView(page, "Prepare");
    await openPanel(ben, "Queue");
    await ben.getByText(/^\S+ on .* is operating\.$/).waitFor();
    // A button that only the operator may press asks, instead of failing.
    const question = ben.getByRole("dialog", { name: "Another page is operating" });
    await queuePanel(ben).getByRole("radio", { name: "Start the next" }).click();
    await question.getByRole("button", { name: "Not now" }).click();
    expect(await ben.getByRole("alert").count()).toBe(0);
    await ben.getByText("is operating.").waitFor();
    const jobCount = await queuePanel(ben).getByRole("listitem").count();
    await plotButton(ben).click();
    await question.getByRole("button", { name: "Not now" }).click();
    // A slider too: it returns to the plotter's value.
    await openPanel(ben, "Plotter");
    const height = (page: Page): Locator => page.getByLabel("Height up", { exact: true });
    const before = await height(ben).inputValue();
    await height(ben).fill("71");
    await question.getByRole("button", { name: "Not now" }).click();
    await expect.poll(() => height(ben).inputValue()).toBe(before);
    expect(await ben.getByRole("alert").count()).toBe(0);
    await openPanel(ben, "Queue");
    expect(await queuePanel(ben).getByRole("listitem").count()).toBe(jobCount);
    await queuePanel(ben).getByRole("radio", { name: "Start the next" }).click();
    await question.getByRole("button", { name: "Take over" }).click();
    await queuePanel(ben)
      .getByRole("radio", { name: "Start the next" })
      .and(ben.locator(":checked"))
      .waitFor();
    await anna.getByText(/^\S+ \(\d\) on .* is operating\.$/).waitFor();
    await queuePanel(ben).getByRole("radio", { name: "Wait for paper" }).click();
    await anna.getByRole("button", { name: "Take over" }).waitFor();
    await plotButton(ben).and(ben.locator(":enabled")).waitFor();
    await openPanel(anna, "Plotter");
    await height(anna).fill("72");
    await anna.getByRole("dialog").getByRole("button", { name: "Take over" }).click();
    await openPanel(ben, "Plotter");
    await expect.poll(() => height(ben).inputValue()).toBe("72");
    await openPanel(ben, "Queue");
    await queuePanel(ben).getByRole("radio", { name: "Start the next" }).click();
    await question.getByRole("button", { name: "Take over" }).click();
    await anna.getByRole("button", { name: "Take over" }).waitFor();
    await queuePanel(ben).getByRole("radio", { name: "Wait for paper" }).click();
  });

  it("one that was offline catches up with the plot", async () => {
    await openPanel(anna, "Queue");
    await anna.context().setOffline(true);
    await anna.getByText("server can’t be reached").first().waitFor();
    await queuePanel(anna)
      .getByText(/last seen \d+/)
      .waitFor();
    expect(await queuePanel(anna).getByRole("button", { name: "Pause" }).isDisabled()).toBe(true);
    expect(await queuePanel(anna).innerText()).not.toMatch(/done \d/);
    await queuePanel(ben).getByRole("button", { name: "Pause" }).click();
    await queuePanel(ben).getByRole("button", { name: "Resume" }).waitFor();
    expect(await queuePanel(anna).getByText("Paused").count()).toBe(0);
    await anna.context().setOffline(false);
    await queuePanel(anna).getByText("Paused").waitFor();
    await expect.poll(async () => (await share(anna)) === (await share(ben))).toBe(true);
    await anna.getByText("server can’t be reached").first().waitFor({ state: "detached" });
  });

  it("every browser may stop it", async () => {
    await queuePanel(anna).getByRole("button", { name: "Cancel" }).click();
    await queuePanel(anna).getByRole("alertdialog").getByRole("button", { name: "Cancel" }).click();
    for (const page of pages()) await historyPanel(page).getByText("Cancelled", { exact: true }).waitFor();
  });

  it("the question keeps what was typed into a dialog", async () => {
    await openView(anna, "Prepare");
    await openPanel(anna, "Plotter");
    await anna.getByRole("button", { name: "Machines…" }).click();
    const sheet = anna.getByRole("dialog", { name: "Machines", exact: true });
    const question = anna.getByRole("dialog", { name: "Another page is operating" });
    await sheet.getByRole("button", { name: "Copy AxiDraw V3 to a new machine" }).click();
    await sheet.getByLabel("Name", { exact: true }).fill("Old friend");
    await sheet.getByRole("button", { name: "Save and use" }).click();
    await question.getByRole("button", { name: "Not now" }).click();
    expect(await sheet.getByLabel("Name", { exact: true }).inputValue()).toBe("Old friend");
    await sheet.getByRole("button", { name: "Save and use" }).click();
    await question.getByRole("button", { name: "Take over" }).click();
    await sheet.getByRole("button", { name: "Edit Old friend" }).waitFor();
    await anna.keyboard.press("Escape");
    await sheet.waitFor({ state: "detached" });
  });

  it("a device that is not paired shows how to pair", async () => {
    const page = await browser.newPage({ ...PLAIN, viewport: VIEWPORT });
    await page.goto(server.url);
    await page.getByRole("heading", { name: "Pair this device" }).waitFor();
    expect(await page.getByText("can’t be reached").count()).toBe(0);
    await page.close();
  });

  it("the page opens without the server, and says so", async () => {
    const page = await browser.newPage({ viewport: VIEWPORT });
    await page.goto(server.url);
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
    await server.stop();
    await page.reload();
    await page.getByText("server can’t be reached").first().waitFor();
    await dropFile(page, "lines.svg", ruledSheet());
    await waitForPlan(page);
    expect(await plotButton(page).isDisabled()).toBe(true);
    await page.close();
  });
});
