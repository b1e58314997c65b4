/** A page of one's own with plotwright/plotter: the same lines as in a program draw on a board by Web Serial. */
import path from "node:path";
import { buildSync } from "esbuild";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../../scripts/setup.mjs";
import { strokesOf, type Line } from "../../../src/index.js";
import { openPlotter } from "../../../server/plotter/open-plotter.js";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import { FAKE_SERIAL_SCRIPT } from "../../support/browser/fake-serial-script.js";
import { startStaticApp, type StaticApp } from "../../support/browser/static-app.js";
import { compareDrawn } from "../../support/drawings/drawn-truth.js";

/** A program: `choice` says which plotter. */
const PROGRAM = `async ({ openPlotter }, choice, circles) => {
  const plotter = await openPlotter(choice);
  const shares = [];
  const { plottedS } = await plotter.plot(circles, {
    paper: "A3", speed: 60, prepare: { order: "none" },
    onProgress: ({ progress }) => shares.push(progress),
  });
  const { penUp, xMm, yMm } = plotter.state;
  await plotter.close();
  return { shares, plottedS, penUp, xMm, yMm };
}`;
interface Outcome {
  readonly shares: readonly number[];
  readonly plottedS: number;
  readonly penUp: boolean;
  readonly xMm: number;
  readonly yMm: number;
}

const circle = (xMm: number, yMm: number): Line =>
  Array.from({ length: 33 }, (_, i) => {
    const angle = (2 * Math.PI * i) / 32;
    return [xMm + 3 * Math.cos(angle), yMm + 3 * Math.sin(angle)];
  });
/** 500 circles, of which a page on a board of 100 times the speed draws the first 20. */
const CIRCLES = Array.from({ length: 500 }, (_, i) =>
  circle(15 + 10 * (i % 25), 15 + 10 * Math.floor(i / 25)),
);
const FEW = CIRCLES.slice(0, 20);

const bundle = (): string =>
  buildSync({
    entryPoints: [path.join(ROOT, "web/serial/open-plotter.ts")],
    bundle: true,
    format: "iife",
    globalName: "library",
    write: false,
  }).outputFiles[0].text;

describe("a program of ten lines", () => {
  let browser: Browser;
  let app: StaticApp;
  let page: Page;
  beforeAll(async () => {
    browser = await launchBrowser();
    app = await startStaticApp(100);
    page = await browser.newPage(PLAIN);
    await page.addInitScript(FAKE_SERIAL_SCRIPT);
    await page.route("**/own", (route) => route.fulfill({ contentType: "text/html", body: "<p>" }));
    await page.goto(`${app.url}/own`);
  });
  afterAll(async () => {
    await browser.close();
    await app.close();
  });

  const inPage = (choice: string, circles: readonly Line[]): Promise<Outcome> =>
    page.evaluate<Outcome>(`(async () => {
      ${bundle()}
      return (${PROGRAM})(library, ${choice}, ${JSON.stringify(circles)});
    })()`);

  it("plots 500 circles on the virtual plotter and reports progress", async () => {
    const run = (0, eval)(PROGRAM) as (library: object, choice: object, circles: Line[]) => Promise<Outcome>;
    const { shares, plottedS, ...end } = await run({ openPlotter }, { virtual: { speed: 200 } }, CIRCLES);
    expect(plottedS).toBeGreaterThan(100);
    expect(shares.length).toBeGreaterThan(1);
    expect(end).toEqual({ penUp: true, xMm: 0, yMm: 0 });
  });

  it("draws the same in a page, on a board by Web Serial", async () => {
    const { shares, ...end } = await inPage("{ webSerial: true }", FEW);
    expect(shares.at(-1)).toBeCloseTo(1, 1);
    expect(end).toMatchObject({ penUp: true, xMm: 0, yMm: 0 });
    const { gapMm, overlapMm, awayMm } = compareDrawn(strokesOf(FEW), app.serial.board.drawn());
    expect(gapMm).toBeLessThan(0.05);
    expect(overlapMm).toBeLessThan(0.05);
    expect(awayMm).toBeLessThan(0.05);
  });

  it("draws on the virtual plotter in a page without a board", async () => {
    const { penUp } = await inPage("{ virtual: { speed: 100 } }", FEW.slice(0, 10));
    expect(penUp).toBe(true);
  });

  it("learns in words that a page can't open a port by its path", async () => {
    await expect(inPage('{ device: "auto" }', FEW)).rejects.toThrow(/use webSerial, or url/);
  });
});
