/** A plot that was killed half way: Watch shows its progress, and the drawn part in another colour than the rest. */
import { once } from "node:events";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { snapshotSchema, type Job } from "../../../src/schema/index.js";
import { launchBrowser } from "../../support/browser/browser.js";
import { combOf, expectPartlyDrawn, SHARP } from "../../support/browser/half-drawn.js";
import {
  dropFile,
  openPanel,
  plotBar,
  queuePanel,
  statusCard,
  waitForPlan,
} from "../../support/browser/page-actions.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";

const PATIENCE_MS = 120_000;
const NAME = "comb";
const LOST = "The plotter does not know where its carriage is";
const COMB = combOf("near", "far");

const data = temporaryFolder("interrupted");
let browser: Browser;
let server: ServerProcess;
let page: Page;
async function openPage(): Promise<void> {
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 },
    ...SHARP,
    colorScheme: "light",
  });
  page = await context.newPage();
  await page.goto(server.url);
}

async function theJob(): Promise<Job> {
  const answer: unknown = await (await fetch(`${server.url}/api/v1/state`)).json();
  return snapshotSchema.parse(answer).jobs[0];
}

const expectAt = async (state: string): Promise<void> => expectPartlyDrawn(page, await theJob(), state);

beforeAll(async () => {
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path, virtualSpeed: 8 });
  await openPage();
}, PATIENCE_MS);

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

describe("a plot whose server was killed", () => {
  it("is shown at its position at once, on a page that is opened then", async () => {
    await dropFile(page, `${NAME}.svg`, COMB);
    await page.getByText(NAME, { exact: true }).first().waitFor();
    await waitForPlan(page);
    await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
    await openPanel(page, "Queue");
    await queuePanel(page)
      .getByRole("button", { name: /^Start / })
      .click();
    await expect.poll(async () => (await theJob()).progress, { interval: 50 }).toBeGreaterThan(0.3);
    const ended = once(server.process, "exit");
    server.process.kill("SIGKILL");
    await ended;
    await page.context().close();
    server = await startServerProcess({ dataDir: data.path, virtualSpeed: 8 });
    await openPage();
    await expectAt("Interrupted");
  });

  it("leaves the sheet room on a phone with a panel open: the card has its title and what is to be ticked", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await openPanel(page, "Queue");
    const canvas = (await page.locator(".canvas:visible").boundingBox())!;
    expect(canvas.height / 844).toBeGreaterThan(0.2);
    const card = statusCard(page).getByRole("group", { name: LOST });
    expect(await card.getByRole("checkbox").isVisible()).toBe(true);
    const words = card.getByText("Push the carriage into its corner by hand", { exact: false });
    expect(await words.isVisible()).toBe(false);
    await page.getByRole("button", { name: "Close the panel" }).click();
    await words.waitFor();
    await page.setViewportSize({ width: 1440, height: 900 });
    await openPanel(page, "Queue");
  });

  it("is shown there when it is resumed and held, after a reload too", async () => {
    const { id } = await theJob();
    await fetch(`${server.url}/api/v1/jobs/${id}/recover`, { method: "POST" });
    await expect.poll(async () => (await theJob()).state).toBe("paused");
    await expectAt("Paused");
    await page.reload();
    await expectAt("Paused");
  });

  it("moves only after the user has said that the carriage is in its corner", async () => {
    const card = statusCard(page).getByRole("group", { name: LOST });
    await card.getByText(/lost its position: push the carriage to home/).waitFor();
    const resume = statusCard(page).getByRole("button", { name: "Resume" });
    expect(await resume.isDisabled()).toBe(true);
    await page.keyboard.press("p");
    expect((await theJob()).state).toBe("paused");
    const tick = card.getByRole("checkbox", { name: "The carriage is in its corner" });
    await tick.check();
    expect(await resume.isEnabled()).toBe(true);
    await tick.uncheck();
    expect(await resume.isDisabled()).toBe(true);
    await tick.check();
    await resume.click();
    // The request of this test that recovered the plot counts as another browser.
    await page.getByRole("dialog").getByRole("button", { name: "Take over" }).click();
    await expect.poll(async () => (await theJob()).state).toBe("plotting");
    await card.waitFor({ state: "detached" });
  });

  it("is asked about again after it is lost once more", async () => {
    const resume = statusCard(page).getByRole("button", { name: "Resume" });
    await server.stop();
    const args = ["--port", new URL(server.url).port];
    server = await startServerProcess({ dataDir: data.path, virtualSpeed: 8, args });
    await statusCard(page).getByRole("button", { name: "Go on from there" }).click();
    await resume.waitFor();
    expect(await resume.isDisabled()).toBe(true);
    await statusCard(page).getByRole("checkbox", { name: "The carriage is in its corner" }).check();
    await resume.click();
    await expect.poll(async () => (await theJob()).state).toBe("plotting");
  });
});

describe("an emergency stop", () => {
  it("does not look like a pause, and says what happened and whether the position holds", async () => {
    await statusCard(page).getByRole("button", { name: "Emergency stop" }).click();
    const card = statusCard(page).getByRole("group", { name: "Emergency stop" });
    await card.getByText(/^Stopped at once.* still knows its position/).waitFor();
    await statusCard(page).getByText("Stopped", { exact: true }).waitFor();
    expect(await statusCard(page).getByText("Paused").count()).toBe(0);
    await expect
      .poll(() => page.getByRole("banner").getByRole("status").innerText())
      .toMatch(/^Stopped: comb/);
    await statusCard(page).getByRole("button", { name: "Resume" }).click();
    await card.waitFor({ state: "detached" });
    await statusCard(page).getByRole("button", { name: "Pause" }).click();
    await statusCard(page).getByText("Paused", { exact: true }).waitFor();
    expect(await card.count()).toBe(0);
  });
});
