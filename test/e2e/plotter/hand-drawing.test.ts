/** Drawing on the page while the plotter draws it, on a virtual board that counts its steps. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { strokesOf, type Line } from "../../../src/index.js";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import { FAKE_SERIAL_SCRIPT } from "../../support/browser/fake-serial-script.js";
import { DrawnSheet, fingerOf, mouseOf } from "../../support/browser/hand-input.js";
import { historyPanel, openPanel, openView, statusCard } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";
import { startStaticApp, type StaticApp } from "../../support/browser/static-app.js";
import { farthestFrom } from "../../support/drawings/drawn-truth.js";
import { PtyBoard } from "../../support/processes/pty-board.js";
import { IS_FULL } from "../../support/runs/full-run.js";

const BOARD_SPEED = 4;
const PATIENCE_MS = 240_000;
/** What the page promises. */
const TOLERANCE_MM = 0.2;
/** Seconds of pointer input. */
const INPUT_S = IS_FULL ? 60 : 4;
const STROKE_S = 2;

type Drawn = readonly { readonly penDown: boolean; readonly xy: ArrayLike<number> }[];

const button = (page: Page, name: string | RegExp) => statusCard(page).getByRole("button", { name });
const inkOf = (drawn: Drawn): Line[] =>
  drawn
    .filter(({ penDown, xy }) => penDown && xy.length >= 2)
    .map(({ xy }) => Array.from({ length: xy.length / 2 }, (_, i) => [xy[2 * i], xy[2 * i + 1]] as const));

/** Loops of a hand, each somewhere else on the sheet. */
const loops =
  (k: number) =>
  (s: number): readonly [number, number] => {
    const [x, y] = [60 + 45 * (k % 5), 50 + 35 * (Math.floor(k / 5) % 4)];
    return [x + 22 * Math.cos(3 * s + k) + 6 * Math.cos(11 * s), y + 16 * Math.sin(4 * s + k)];
  };

function mustMatch(expected: readonly Line[], drawn: Drawn): void {
  const ink = inkOf(drawn);
  expect(ink.length).toBeGreaterThan(0);
  expect(farthestFrom(strokesOf(expected), ink.flat(2))).toBeLessThan(TOLERANCE_MM);
  expect(farthestFrom(strokesOf(ink), expected.flat(2))).toBeLessThan(TOLERANCE_MM);
}

const finished = async (page: Page): Promise<void> => {
  await button(page, "Finish").click();
  await statusCard(page).getByText("Done", { exact: true }).waitFor({ timeout: PATIENCE_MS });
};

describe("drawing by hand with a server", () => {
  let board: PtyBoard;
  let test: PageTest;
  beforeAll(async () => {
    board = await PtyBoard.open({ speed: BOARD_SPEED });
    test = await PageTest.firstVisit("hand-drawing", {}, ["--device", board.path]);
    // The test closes the connection.
    await test.page.addInitScript(() => {
      const kept: WebSocket[] = ((window as unknown as { sockets: WebSocket[] }).sockets = []);
      window.WebSocket = class extends WebSocket {
        constructor(...args: ConstructorParameters<typeof WebSocket>) {
          super(...args);
          kept.push(this);
        }
      };
    });
    await test.page.reload();
    await openView(test.page, "Watch");
  }, PATIENCE_MS);
  afterAll(async () => {
    await test.close();
    await board.close();
  });
  let before = 0;
  const drawn = async (): Promise<Drawn> => (await board.report()).drawn.slice(before);

  it(
    `follows ${INPUT_S} s of the mouse within 0.2 mm, loses nothing, and is a job that can be plotted again`,
    async () => {
      const { page } = test;
      const sheet = await DrawnSheet.open(page, mouseOf(page));
      for (let k = 0; k * STROKE_S < INPUT_S; k++) await sheet.stroke(loops(k), STROKE_S);
      const expected = await sheet.expected();
      expect(expected.length).toBe(INPUT_S / STROKE_S);
      await statusCard(page).getByText("The pen has drawn everything.").waitFor({ timeout: PATIENCE_MS });
      expect(await button(page, "Undo").isDisabled()).toBe(true);
      await finished(page);
      mustMatch(expected, await drawn());
      before = (await board.report()).drawn.length;
      await button(page, /^Plot again/).click();
      await openPanel(page, "Queue");
      await page
        .getByRole("button", { name: /^Start Drawn by hand/ })
        .first()
        .click();
      await button(page, "Pause").waitFor();
      await statusCard(page).getByText("Done", { exact: true }).waitFor({ timeout: PATIENCE_MS });
      mustMatch(expected, await drawn());
    },
    PATIENCE_MS,
  );

  it(
    "takes back with Ctrl Z what the pen has not drawn, and only that",
    async () => {
      const { page } = test;
      before = (await board.report()).drawn.length;
      const sheet = await DrawnSheet.open(page, mouseOf(page));
      await sheet.stroke(loops(1), 0.7);
      await button(page, "Pause").click();
      await button(page, "Resume").waitFor();
      await sheet.stroke(loops(7), 0.7);
      await page.keyboard.press("Control+z");
      await sheet.stroke(loops(13), 0.7);
      const [first, , third] = await sheet.expected();
      await button(page, "Resume").click();
      await finished(page);
      mustMatch([first, third], await drawn());
    },
    PATIENCE_MS,
  );

  it(
    "says what happens when the connection is lost, and what has arrived can be plotted again",
    async () => {
      const { page } = test;
      const sheet = await DrawnSheet.open(page, mouseOf(page));
      await sheet.stroke(loops(2), 1);
      await statusCard(page)
        .getByText(/behind|has drawn everything/)
        .waitFor();
      await page.evaluate(() => (window as unknown as { sockets: WebSocket[] }).sockets.at(-1)!.close());
      await statusCard(page)
        .getByText(/can be plotted again/)
        .waitFor();
      await button(page, "Open the whole drawing in Prepare").click();
      await page
        .locator(".drawn-size")
        .getByText(/^Drawn by hand/)
        .first()
        .waitFor();
      await openPanel(page, "Queue");
      await historyPanel(page)
        .getByRole("button", { name: /^Plot again: Drawn by hand/ })
        .first()
        .waitFor();
    },
    PATIENCE_MS,
  );

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});

describe("drawing by hand without a server, with a finger on a phone and a turned desk", () => {
  let browser: Browser;
  let app: StaticApp;
  let page: Page;
  beforeAll(async () => {
    browser = await launchBrowser();
    app = await startStaticApp(BOARD_SPEED);
    const context = await browser.newContext({
      ...PLAIN,
      viewport: { width: 390, height: 844 },
      hasTouch: true,
    });
    await context.addInitScript(FAKE_SERIAL_SCRIPT);
    page = await context.newPage();
    await page.goto(app.url);
  }, PATIENCE_MS);
  afterAll(async () => {
    await browser.close();
    await app.close();
  });

  it(
    "follows it within 0.2 mm, and loses nothing",
    async () => {
      await openPanel(page, "Plotter");
      await page.getByRole("button", { name: "Connect a plotter…" }).click();
      await expect.poll(() => app.serial.isOpen).toBe(true);
      await page.getByRole("button", { name: "Close the panel" }).click();
      await openView(page, "Watch");
      await page.getByRole("button", { name: /Turn/ }).first().click();
      const sheet = await DrawnSheet.open(page, fingerOf(await page.context().newCDPSession(page)));
      for (let k = 0; k < 3; k++) await sheet.stroke(loops(k), 1);
      const expected = await sheet.expected();
      expect(expected.length).toBe(3);
      await finished(page);
      mustMatch(expected, app.serial.board.drawn());
    },
    PATIENCE_MS,
  );
});
