/** What a visible state of the page is, and the steps that states of several subjects share. */
import type { Page } from "playwright-core";
import type { ServerProcess } from "../../processes/server-process.js";
import { readFileSync } from "node:fs";
import path from "node:path";
import { ROOT } from "../../../../scripts/setup.mjs";
import { dropFile, openPanel, plotBar, queuePanel, statusCard, waitForPlan } from "../page-actions.js";

export interface Stand {
  readonly page: Page;
  readonly server: ServerProcess;
  /** A new server in place of one that ended. */
  restart(): Promise<void>;
  /** The page in another browser, which the server tells apart from this one. */
  openOther(path?: string): Promise<Page>;
}

export interface PageState {
  readonly name: string;
  readonly virtualSpeed?: number;
  /** Instead of the virtual board. */
  readonly device?: string;
  /** The server lets in only devices that are paired. */
  readonly isPairing?: true;
  /** Leaves nothing behind once a sheet that it opened is closed. */
  readonly isPassing?: true;
  /** Begins with an empty paper; other states begin with a sample on it. */
  readonly isFirstVisit?: true;
  /** Shows a part of the page that no passing state shows: part of every test run, not only of the full one. */
  readonly isOnlyPlace?: true;
  reach(stand: Stand): Promise<void>;
}

export const sampleText = (name: string): string =>
  readFileSync(path.join(ROOT, "samples", `${name}.svg`), "utf8");

export const TWO_PENS = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="200mm" height="120mm" viewBox="0 0 200 120"><g fill="none">
  <g inkscape:groupmode="layer" inkscape:label="Outline" stroke="#222"><path d="M20 20h20v20h-20z"/></g>
  <g inkscape:groupmode="layer" inkscape:label="!Red circle" stroke="#c8102e"><circle cx="90" cy="60" r="30"/></g>
  </g></svg>`;

export async function lay(page: Page, name: string, text: string): Promise<void> {
  await dropFile(page, `${name}.svg`, text);
  await page.getByText(name).first().waitFor();
  await waitForPlan(page);
}

/** Plots a drawing. Watch then opens by itself; the queue is opened beside it. */
export async function start(page: Page, name: string, text: string): Promise<void> {
  await lay(page, name, text);
  await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
  await statusCard(page).getByRole("progressbar").waitFor();
  await openPanel(page, "Queue");
  await queuePanel(page).getByRole("progressbar").waitFor();
}

/** A job's buttons: on the status card in Watch, otherwise in the queue, on a phone in the bar at the bottom. */
export const button = (page: Page, name: string | RegExp) =>
  statusCard(page).or(queuePanel(page)).or(plotBar(page)).getByRole("button", { name });
