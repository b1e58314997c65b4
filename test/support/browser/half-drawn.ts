/** Checks that the page shows a plot's progress: in its text, and as the drawn part of the sheet. */
import type { Page } from "playwright-core";
import { expect } from "vitest";
import type { Job } from "../../../src/schema/index.js";
import { colorCounts, statusCard, waitForPicture } from "./page-actions.js";

const LINE_COLOR = "#1040c0";
/** `--desk-ghost` of the light theme. */
const GHOST_COLOR = "#dcdad4";
/** So that a line covers whole pixels of the screen. */
export const SHARP = { deviceScaleFactor: 2 };

const lines = (from: number, to: number): string =>
  Array.from({ length: to - from }, (_, i) => `<path d="M10 ${10 + 3 * (from + i)}h120"/>`).join("");
const layer = (name: string, content: string): string =>
  `<g inkscape:groupmode="layer" inkscape:label="${name}">${content}</g>`;

/** 40 lines of one colour: a first half and a second, which waits for its pen if it is named with a "!". */
export const combOf = (first: string, second: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
    width="150mm" height="150mm" viewBox="0 0 150 150" stroke="${LINE_COLOR}">
    ${layer(first, lines(0, 20))}${layer(second, lines(20, 40))}</svg>`;

const colorOf = (hex: string): number => Number.parseInt(hex.slice(1), 16);

/** The share of the drawing's visible pixels that have the lines' own colour; null if the drawing is not visible. */
async function drawnShare(page: Page, canvasName: string): Promise<number | null> {
  await waitForPicture(page);
  const counts = await colorCounts(page.getByRole("img", { name: canvasName, exact: true }));
  const drawn = counts.get(colorOf(LINE_COLOR)) ?? 0;
  const left = counts.get(colorOf(GHOST_COLOR)) ?? 0;
  return drawn + left > 1_000 ? drawn / (drawn + left) : null;
}

/** Expects the drawn share on the canvas to equal the job's progress. */
export async function expectShareOnCanvas(page: Page, { progress }: Job, canvasName: string): Promise<void> {
  const distance = async (): Promise<number> =>
    Math.abs(((await drawnShare(page, canvasName)) ?? Infinity) - progress);
  await expect.poll(distance).toBeLessThan(0.15);
}

/** Expects that Watch shows the job, which does not move, in that state and at its position. */
export async function expectPartlyDrawn(page: Page, job: Job, state: string): Promise<void> {
  const { name, progress, stats, remainingS } = job;
  expect(progress).toBeGreaterThan(0.2);
  expect(progress).toBeLessThan(0.8);
  expect(remainingS! / stats!.durationS).toBeCloseTo(1 - progress, 1);
  const pill = page.locator(".machine-state");
  await expect.poll(() => pill.innerText()).toMatch(new RegExp(`^${state}: ${name}\\s+\\d+\\s*%$`));
  const shownPct = Number(/(\d+)\s*%$/.exec(await pill.innerText())![1]);
  expect(Math.abs(shownPct - 100 * progress)).toBeLessThanOrEqual(1);
  const bar = statusCard(page).getByRole("progressbar");
  expect(Math.abs(Number(await bar.getAttribute("aria-valuenow")) - 100 * progress)).toBeLessThanOrEqual(1);
  expect(await statusCard(page).innerText()).toContain("left");
  await expectShareOnCanvas(page, job, "The plot: what is drawn, and what is left");
}
