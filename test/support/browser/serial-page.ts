/**
 * The page without a server, from static files: its worker plots on a board that is on a fake serial port, outside the
 * browser. For tests that compare what the board has drawn with the drawing.
 */
import type { Browser, BrowserContext, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect } from "vitest";
import type { VirtualMachine } from "../../../src/internal.js";
import { ENDED_STATES, jobSchema, type Job } from "../../../src/schema/index.js";
import { storedRecords } from "./backends.js";
import { launchBrowser, PLAIN } from "./browser.js";
import { compareDrawn } from "../drawings/drawn-truth.js";
import type { FakeSerial } from "./fake-serial.js";
import { FAKE_SERIAL_SCRIPT } from "./fake-serial-script.js";
import { grblDevice, type GrblDevice, type GrblOptions } from "./grbl-device.js";
import { dropFile, plotBar, statusCard, waitForPlan } from "./page-actions.js";
import { startStaticApp, type StaticApp } from "./static-app.js";
import { strokesOf } from "./svg-strokes.js";
import type { TabbedBrowser } from "./tabbed-browser.js";

const PATIENCE_MS = 90_000;
/** Missing or doubled where the board kept its counters. */
const MAX_OFF_MM = 0.05;
/** A computer so busy that the board seems to be silent interrupts a plot once more. */
const MAX_INTERRUPTIONS = 4;

async function newContext(browser: Browser): Promise<TabbedBrowser> {
  const context = await browser.newContext({ ...PLAIN, viewport: { width: 900, height: 600 } });
  return { context, close: () => context.close() };
}

/** Long lines that do not touch each other. */
const comb = (lines: number): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="100mm" viewBox="0 0 150 100" fill="none" stroke="black">${Array.from(
    { length: lines },
    (_, i) => `<path d="M20 ${20 + Math.min(4, 76 / lines) * i}h100"/>`,
  ).join("")}</svg>`;

/** The pages of one browser context, and the board that all of them can use. */
export class SerialPages {
  private constructor(
    readonly app: StaticApp,
    readonly context: BrowserContext,
    private readonly boardSpeed: number,
    private readonly closeBrowser: () => Promise<void>,
  ) {}

  /** `boardSpeed`: board seconds per second. */
  static async start(
    browser: Browser,
    boardSpeed: number,
    open: (browser: Browser) => Promise<TabbedBrowser> = newContext,
  ): Promise<SerialPages> {
    const app = await startStaticApp(boardSpeed);
    const { context, close } = await open(browser);
    await context.addInitScript(FAKE_SERIAL_SCRIPT);
    return new SerialPages(app, context, boardSpeed, close);
  }

  async close(): Promise<void> {
    await this.closeBrowser();
    await this.app.close();
  }

  get serial(): FakeSerial {
    return this.app.serial;
  }

  get board(): FakeSerial["board"] {
    return this.serial.board;
  }

  /** A Grbl in place of the EiBotBoard. */
  plugGrbl(options: Omit<GrblOptions, "speed">): GrblDevice {
    const device = grblDevice({ ...options, speed: this.boardSpeed });
    this.serial.plug(device);
    return device;
  }

  async openPage(): Promise<Page> {
    const page = await this.context.newPage();
    // Asked before a page that plots is closed or reloaded.
    page.on("dialog", (dialog) => void dialog.accept());
    await page.goto(`${this.app.url}/?virtual-speed=${this.boardSpeed}`);
    return page;
  }

  /** Allows the page to use what is plugged in, and waits until it is connected. */
  async connect(page: Page): Promise<void> {
    await page.getByRole("button", { name: "Connect a plotter…" }).click();
    await this.untilConnected(page);
  }

  /** Connects the plotter and plots the drawing on the paper. */
  async plot(page: Page): Promise<void> {
    await waitForPlan(page);
    await this.connect(page);
    await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
  }

  /** Begins to plot `lines` lines, of 4 s each. */
  async plotComb(page: Page, lines: number): Promise<void> {
    await dropFile(page, "comb.svg", comb(lines));
    await this.plot(page);
  }

  /** A port that the page may use is found by itself. */
  async untilConnected(page: Page): Promise<void> {
    await page.getByRole("button", { name: "Connect a plotter…" }).waitFor({ state: "detached" });
    await expect.poll(() => this.app.serial.isOpen, { timeout: PATIENCE_MS }).toBe(true);
  }

  /** Resumes the interrupted plot, as a user does, and waits for its end. */
  async recover(page: Page): Promise<void> {
    for (let interruptions = 1; interruptions <= MAX_INTERRUPTIONS; interruptions++) {
      await expectState(page, /^Interrupted/);
      await this.untilConnected(page);
      await statusCard(page).getByRole("button", { name: "Go on from there" }).click();
      await expectState(page, /^Paused/);
      const corner = statusCard(page).getByRole("checkbox", { name: "The carriage is in its corner" });
      if ((await corner.count()) > 0) await corner.check();
      await statusCard(page).getByRole("button", { name: "Resume" }).click();
      if ((await endOf(page)) !== "interrupted") break;
    }
    expect((await storedJob(page)).state).toBe("done");
  }

  combFaults(page: Page, lines: number): Promise<DrawnFaults> {
    return this.drawnFaults(page, comb(lines), this.board);
  }

  /** Compares what the machine has drawn with the drawing of the only job. */
  async drawnFaults(page: Page, svg: string, machine: Pick<VirtualMachine, "drawn">): Promise<DrawnFaults> {
    const { settings } = await storedJob(page);
    const { gapMm, overlapMm, awayMm } = compareDrawn(await strokesOf(svg, settings), machine.drawn());
    expect(awayMm).toBeLessThan(MAX_OFF_MM);
    return { gapMm, overlapMm, isGood: gapMm < MAX_OFF_MM && overlapMm < MAX_OFF_MM };
  }
}

/** Lengths of the lines that are missing on the paper, and that are drawn twice, mm. */
interface DrawnFaults {
  readonly gapMm: number;
  readonly overlapMm: number;
  readonly isGood: boolean;
}

/**
 * Opens a browser for the tests of a file. The returned function starts the pages of one test, which are closed after
 * the test.
 */
export function useSerialPages(): (
  boardSpeed: number,
  open?: (browser: Browser) => Promise<TabbedBrowser>,
) => Promise<SerialPages> {
  let browser: Browser;
  let pages: SerialPages | null = null;
  beforeAll(async () => {
    browser = await launchBrowser();
  });
  afterEach(async () => {
    await pages?.close();
    pages = null;
  });
  afterAll(() => browser.close());
  return async (boardSpeed, open) => {
    pages = await SerialPages.start(browser, boardSpeed, open);
    return pages;
  };
}

/** The first words of the line about the plotter. */
export const expectState = (page: Page, words: RegExp): Promise<void> =>
  expect.poll(() => page.locator(".machine-state").innerText(), { timeout: PATIENCE_MS }).toMatch(words);

/** The only job, as it is stored in the browser. */
export async function storedJob(page: Page): Promise<Job> {
  const [row] = await storedRecords(page, "jobs");
  return jobSchema.parse((row as { job: unknown }).job);
}

/** Waits until the plot has ended or is interrupted: an interrupted one would never end. */
async function endOf(page: Page): Promise<Job["state"]> {
  const isOver = ({ state }: Job): boolean => state === "interrupted" || ENDED_STATES.includes(state);
  const options = { timeout: 2 * PATIENCE_MS, interval: 200 };
  await expect.poll(async () => isOver(await storedJob(page)), options).toBe(true);
  return (await storedJob(page)).state;
}

/** Waits for the end of a plot that must not be interrupted. */
export async function done(page: Page): Promise<void> {
  expect(await endOf(page)).toBe("done");
}
