/**
 * The pen on the page against the virtual board's, over loopback in real Chromium: how often it is painted, and how far
 * it is from where the board is at that moment. Needs the built page (`npm run build:web`).
 */
import { setTimeout as delay } from "node:timers/promises";
import type { Page } from "playwright-core";
import { createServer } from "../server/index.js";
import { VirtualBoard } from "../src/index.js";
import { launchBrowser } from "../test/support/browser/browser.js";
import { chooseSample, plotBar, waitForPlan } from "../test/support/browser/page-actions.js";
import { temporaryFolder } from "../test/support/processes/folders.js";
import type { Report } from "./run.js";

const WATCHED_MS = 20_000;
const SAMPLE_MS = 4;
/** The pen travels, instead of resting or waiting for a lift. */
const MOVING_MM_PER_S = 20;

interface Place {
  /** Of the computer, ms. */
  readonly ms: number;
  readonly xMm: number;
  readonly yMm: number;
}

export default async function penBench(report: Report): Promise<void> {
  const boards = boardsOfThisProcess();
  const data = temporaryFolder("bench-pen");
  const server = await createServer({ port: 0, device: "virtual", virtualSpeed: 1, dataDir: data.path });
  const browser = await launchBrowser();
  try {
    const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
    await page.goto(server.url);
    await chooseSample(page);
    await waitForPlan(page);
    await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
    await page.locator("canvas[data-mm]").waitFor({ timeout: 60_000 });
    await delay(2_000);
    const [shown, real] = await Promise.all([shownPlaces(page), boardPlaces(boards.at(-1)!)]);
    const gaps = shown.slice(1).map(({ ms }, i) => ms - shown[i].ms);
    const drawn = [];
    const travelled = [];
    for (const place of shown) {
      const at = placeAt(real, place.ms);
      if (!at) continue;
      const awayMm = Math.hypot(place.xMm - at.xMm, place.yMm - at.yMm);
      if (!at.penUp) drawn.push(awayMm);
      else if (at.mmPerS > MOVING_MM_PER_S) travelled.push((1_000 * awayMm) / at.mmPerS);
    }
    const renderer = await page.evaluate(rendererName);
    report(
      "The pen on the page",
      [
        {
          "updates a second, p95": Math.round(1_000 / p95(gaps)),
          "of the median": Math.round(1_000 / median(gaps)),
          "from the board while drawing, p95 mm": Number(p95(drawn).toFixed(2)),
          "on travel, p95 ms": Number(p95(travelled).toFixed(1)),
        },
      ],
      `${(WATCHED_MS / 1_000).toFixed()} s of the page's first sample on the virtual board, Chromium ${browser.version()}, ${renderer}.`,
    );
  } finally {
    await browser.close();
    await server.close();
    data.remove();
  }
}

/** The virtual boards to which a connection is opened from now on. */
function boardsOfThisProcess(): VirtualBoard[] {
  const boards: VirtualBoard[] = [];
  const { transport } = VirtualBoard.prototype;
  VirtualBoard.prototype.transport = function (this: VirtualBoard) {
    boards.push(this);
    return transport.call(this);
  };
  return boards;
}

const nowMs = (): number => performance.timeOrigin + performance.now();

async function boardPlaces(board: VirtualBoard): Promise<(Place & { penUp: boolean })[]> {
  const places = [];
  const untilMs = nowMs() + WATCHED_MS;
  while (nowMs() < untilMs) {
    const { xMm, yMm, penUp } = board.state();
    places.push({ ms: nowMs(), xMm, yMm, penUp });
    await delay(SAMPLE_MS);
  }
  return places;
}

function placeAt(
  places: readonly (Place & { penUp: boolean })[],
  ms: number,
): (Place & { penUp: boolean; mmPerS: number }) | null {
  const next = places.findIndex((place) => place.ms >= ms);
  if (next < 1) return null;
  const [a, b] = [places[next - 1], places[next]];
  const share = (ms - a.ms) / (b.ms - a.ms);
  const mmPerS = (1_000 * Math.hypot(b.xMm - a.xMm, b.yMm - a.yMm)) / (b.ms - a.ms);
  const between = (from: number, to: number): number => from + share * (to - from);
  return { ms, xMm: between(a.xMm, b.xMm), yMm: between(a.yMm, b.yMm), penUp: a.penUp, mmPerS };
}

const sorted = (values: readonly number[]): number[] => [...values].sort((a, b) => a - b);
const p95 = (values: readonly number[]): number => sorted(values)[Math.floor(0.95 * values.length)];
const median = (values: readonly number[]): number => sorted(values)[values.length >> 1];

/** Every place that the page's pen is painted at, as the canvas says. */
const shownPlaces = (page: Page): Promise<Place[]> =>
  page.evaluate(async (watchedMs) => {
    const canvas = document.querySelector<HTMLCanvasElement>("canvas[data-mm]")!;
    const places: { ms: number; xMm: number; yMm: number }[] = [];
    const observer = new MutationObserver(() => {
      const [xMm, yMm] = canvas.dataset["mm"]!.split(" ").map(Number);
      places.push({ ms: performance.timeOrigin + performance.now(), xMm, yMm });
    });
    observer.observe(canvas, { attributes: true, attributeFilter: ["data-mm"] });
    await new Promise((resolve) => setTimeout(resolve, watchedMs));
    return places;
  }, WATCHED_MS);

/** What draws the strokes; for `page.evaluate`. */
export function rendererName(): string {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  return gl ? String(gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER)) : "no WebGL2";
}
