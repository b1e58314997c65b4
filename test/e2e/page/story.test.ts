/**
 * The main use, end to end: open the page, drop a drawing, preview it, plot it, find it again after a
 * restart.
 */
import { readFileSync } from "node:fs";
import path from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../../scripts/setup.mjs";
import { launchBrowser } from "../../support/browser/browser.js";
import {
  chooseSample,
  colorCounts,
  dropFile,
  historyPanel,
  openPanel,
  plotBar,
  queuePanel,
  waitForPicture,
  waitForPlan,
  waitForPlotButton,
} from "../../support/browser/page-actions.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";

const DESKTOP = { width: 1440, height: 900 };
const PHONE = { width: 390, height: 844 };
const SAMPLE = "three-colour-hills.svg";

const data = temporaryFolder("story");
let browser: Browser;
let server: ServerProcess;
let page: Page;
const complaints: string[] = [];

async function openPage(viewport: { width: number; height: number }): Promise<Page> {
  const context = await browser.newContext({ viewport, colorScheme: "light" });
  const opened = await context.newPage();
  opened.on("pageerror", (error) => complaints.push(error.message));
  opened.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  await opened.goto(server.url);
  return opened;
}

beforeAll(async () => {
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path, virtualSpeed: 60 });
  page = await openPage(DESKTOP);
});

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

/** Preview colours that only a drawing's lines can have, and the number of pixels of each. */
async function inked(target: Page): Promise<[color: number, count: number][]> {
  await waitForPicture(target);
  const counts = await colorCounts(target.getByRole("img", { name: "Preview" }));
  return [...counts].filter(([color]) => saturation(rgbFromNumber(color)) > 60);
}

const pixelCount = (colors: readonly [number, number][]): number =>
  colors.reduce((sum, [, count]) => sum + count, 0);

/** From now on the page records each change of its progress bar. */
async function noteShares(): Promise<void> {
  await page.evaluate(() => {
    const shares: number[] = [];
    (window as unknown as { shares: number[] }).shares = shares;
    const region = document.querySelector('section[aria-label="Queue"]')!;
    const note = (): void => {
      const share = region.querySelector("[role=progressbar]")?.getAttribute("aria-valuenow");
      if (share !== undefined && share !== null) shares.push(Number(share));
    };
    new MutationObserver(note).observe(region, { subtree: true, childList: true, attributes: true });
  });
}

describe("a newcomer with a drawing", () => {
  it("finds an empty sheet with nothing to plot, and a note that no plotter is plugged in", async () => {
    await page.getByText("Drop a drawing here").waitFor();
    await page
      .getByText(/Virtual plotter/)
      .first()
      .waitFor();
    await plotBar(page).getByText("Choose a drawing, or try a sample.").waitFor();
    for (const name of ["Plot", "Add to queue"]) {
      expect(await plotBar(page).getByRole("button", { name, exact: true }).isDisabled()).toBe(true);
    }
  });

  it("puts a sample on it with one click, ready to plot", async () => {
    await chooseSample(page);
    await waitForPlotButton(page);
    await page.getByRole("group", { name: "Colour by" }).getByRole("radio", { name: "Speed" }).check();
    expect(pixelCount(await inked(page))).toBeGreaterThan(2_000);
  });

  it("drops a file and sees its time, distance and number of pen lifts", async () => {
    await dropFile(page, SAMPLE, readFileSync(path.join(ROOT, "samples", SAMPLE), "utf8"));
    await page.getByText(SAMPLE.replace(".svg", "")).first().waitFor();
    await waitForPlan(page);
    const figures = await plotBar(page).innerText();
    expect(figures).toMatch(/\d+\s*min/);
    expect(figures).toMatch(/Pen lifts\s*\d+/i);
  });

  it("sees it in the colours of the legend, which ends at the drawing's top speed", async () => {
    const legend = page.getByRole("img", { name: "Speed legend" });
    const stops = (await legend.getAttribute("data-stops")) ?? "[]";
    const inks = (JSON.parse(stops) as { mmPerS: number; color: string }[]).map(({ color }) =>
      rgbFromHex(color),
    );
    expect(inks.length).toBeGreaterThan(4);
    const drawn = await inked(page);
    expect(pixelCount(drawn)).toBeGreaterThan(2_000);
    const strangers = drawn.filter(
      ([color]) => distanceToMix(rgbFromNumber(color), [255, 255, 255], inks) > 24,
    );
    expect(pixelCount(strangers) / pixelCount(drawn)).toBeLessThan(0.02);
    // The comparison can fail: a green is not a colour of the legend.
    expect(distanceToMix(rgbFromHex("#2ecc40"), [255, 255, 255], inks)).toBeGreaterThan(24);
  });

  it("adds it to the queue, starts it, and watches it reach 100 %", async () => {
    await openPanel(page, "Queue");
    await noteShares();
    await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
    await queuePanel(page)
      .getByRole("button", { name: /^Start / })
      .click();
    await queuePanel(page).getByRole("progressbar").waitFor();
    await historyPanel(page).getByText("Done").waitFor({ timeout: 100_000 });
    const seen = await page.evaluate(() => (window as unknown as { shares: number[] }).shares);
    expect(seen).toEqual([...seen].sort((a, b) => a - b));
    expect(seen.at(-1)).toBeGreaterThan(90);
    const { jobs } = (await (await fetch(`${server.url}/api/v1/state`)).json()) as {
      jobs: { state: string; progress: number }[];
    };
    expect(jobs.map(({ state, progress: share }) => [state, share])).toEqual([["done", 1]]);
  });

  it("finds it in the history after a restart of the server", async () => {
    await page.goto("about:blank");
    await server.stop();
    server = await startServerProcess({ dataDir: data.path });
    await page.goto(server.url);
    await openPanel(page, "Queue");
    await historyPanel(page).getByText("Done").waitFor();
    await historyPanel(page).getByText(SAMPLE.replace(".svg", "")).waitFor();
  });

  it("can do it on a phone without scrolling sideways", async () => {
    const phone = await openPage(PHONE);
    await chooseSample(phone);
    const widthPx = await phone.evaluate(() => document.documentElement.scrollWidth);
    expect(widthPx).toBeLessThanOrEqual(PHONE.width);
    await phone.getByRole("button", { name: "Plot", exact: true }).waitFor();
    await phone.context().close();
  });

  it("logs no error in the browser's console", () => {
    expect(complaints).toEqual([]);
  });
});

/**
 * Checks whether the colours on the screen belong to a legend. The pixels at a line's edge are mixed with the
 * paper.
 */
type Rgb = readonly [r: number, g: number, b: number];

/** From 0xrrggbb. */
const rgbFromNumber = (value: number): Rgb => [(value >> 16) & 255, (value >> 8) & 255, value & 255];
const rgbFromHex = (hex: string): Rgb => rgbFromNumber(Number.parseInt(hex.slice(1), 16));

const saturation = ([r, g, b]: Rgb): number => Math.max(r, g, b) - Math.min(r, g, b);

/** Distance (0 … 441) from a colour to the nearest mix of `paper` with one of `inks`. */
function distanceToMix(color: Rgb, paper: Rgb, inks: readonly Rgb[]): number {
  let nearest = Infinity;
  for (const ink of inks) {
    const along = [ink[0] - paper[0], ink[1] - paper[1], ink[2] - paper[2]] as const;
    const from = [color[0] - paper[0], color[1] - paper[1], color[2] - paper[2]] as const;
    const lengthSquared = along[0] ** 2 + along[1] ** 2 + along[2] ** 2;
    const dot = from[0] * along[0] + from[1] * along[1] + from[2] * along[2];
    const share = lengthSquared === 0 ? 0 : Math.min(1, Math.max(0, dot / lengthSquared));
    nearest = Math.min(
      nearest,
      Math.hypot(from[0] - share * along[0], from[1] - share * along[1], from[2] - share * along[2]),
    );
  }
  return nearest;
}
