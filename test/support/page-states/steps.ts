/** Steps shared by states of several subjects. */
import { readFileSync } from "node:fs";
import path from "node:path";
import type { Page } from "playwright-core";
import { ROOT } from "../../../scripts/setup.mjs";
import { dropFile, openTab, plotBar, queuePanel, statusCard, waitForPlan } from "../page-actions.js";

export const sampleText = (name: string): string =>
  readFileSync(path.join(ROOT, "samples", `${name}.svg`), "utf8");

export const TWO_PENS = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="200mm" height="120mm" viewBox="0 0 200 120"><g fill="none">
  <g inkscape:groupmode="layer" inkscape:label="Outline" stroke="#222"><path d="M20 20h20v20h-20z"/></g>
  <g inkscape:groupmode="layer" inkscape:label="!Red circle" stroke="#c8102e"><circle cx="90" cy="60" r="30"/></g>
  </g></svg>`;

export async function lay(page: Page, name: string, text: string): Promise<void> {
  await openTab(page, "Set up");
  await dropFile(page, `${name}.svg`, text);
  await page.getByText(name).first().waitFor();
  await waitForPlan(page);
}

/** Plots a drawing. Watch then opens by itself, with the queue below it on a phone. */
export async function start(page: Page, name: string, text: string): Promise<void> {
  await lay(page, name, text);
  await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
  await queuePanel(page).getByRole("progressbar").waitFor();
}

/** A job's buttons: on the status card in Watch, otherwise in the queue, on a phone in the bar at the bottom. */
export const button = (page: Page, name: string | RegExp) =>
  statusCard(page).or(queuePanel(page)).or(plotBar(page)).getByRole("button", { name });
