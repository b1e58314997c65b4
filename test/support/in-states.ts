/** Brings the page into its states (page-states.ts) for a screen size, light and dark. */
import type { Browser, BrowserContext, Page } from "playwright-core";
import { PLAIN } from "./browser.js";
import { chooseSample, nextFrames } from "./page-actions.js";
import type { PageState } from "./page-states/page-state.js";
import { startServerProcess, temporaryFolder, type ServerProcess } from "./server-process.js";

/** The size of a screen. */
export interface Look {
  readonly name: string;
  readonly width: number;
  readonly height: number;
}
export const DESK: Look = { name: "desk", width: 1440, height: 900 };
export const WIDE: Look = { name: "wide", width: 1920, height: 1080 };
export const TABLET: Look = { name: "tablet", width: 1024, height: 768 };
export const PHONE: Look = { name: "phone", width: 390, height: 844 };
export const LOOKS: readonly Look[] = [DESK, WIDE, TABLET, PHONE];

export const SCHEMES = ["light", "dark"] as const;
export type Scheme = (typeof SCHEMES)[number];

type LookAtIt = (page: Page, state: PageState, scheme: Scheme) => Promise<void>;

/**
 * Brings the page into each of the states and calls `lookAtIt` in each of the colour schemes. States that leave nothing
 * behind share one page; each of the others has its own server.
 */
export async function inStates(
  browser: Browser,
  states: readonly PageState[],
  look: Look,
  lookAtIt: LookAtIt,
  schemes: readonly Scheme[] = SCHEMES,
): Promise<void> {
  const passing = states.filter(({ isPassing }) => isPassing);
  const lasting = states.filter(({ isPassing }) => !isPassing);
  const groups = [passing, ...lasting.map((state) => [state])].filter((group) => group.length > 0);
  for (const group of groups) await inGroup(browser, group, look, lookAtIt, schemes);
}

/** Waits until the last change has been planned, if the page shows a plan at all. */
export async function planned(page: Page): Promise<void> {
  await nextFrames(page);
  await page.locator(".plot-time-value[data-stale]").waitFor({ state: "detached" });
}

async function inGroup(
  browser: Browser,
  states: readonly PageState[],
  { width, height }: Look,
  lookAtIt: LookAtIt,
  schemes: readonly Scheme[],
): Promise<void> {
  const data = temporaryFolder("page-state");
  const { device, isPairing, isFirstVisit, virtualSpeed = 20 } = states[0];
  const args = [
    ...(device === undefined ? [] : ["--device", device]),
    ...(isPairing ? ["--pair-always"] : []),
  ];
  const open = (port: string): Promise<ServerProcess> =>
    startServerProcess({ dataDir: data.path, virtualSpeed, args: [...args, "--port", port] });
  let server = await open("0");
  const restart = async (): Promise<void> => {
    const { port } = new URL(server.url);
    server.process.kill("SIGKILL");
    await server.stop();
    server = await open(port);
  };
  const contexts: BrowserContext[] = [];
  const openOther = async (path = "/"): Promise<Page> => {
    const context = await browser.newContext({
      viewport: { width, height },
      hasTouch: width < 760,
      ...PLAIN,
    });
    contexts.push(context);
    const other = await context.newPage();
    await other.goto(`${server.url}${path}`);
    return other;
  };
  try {
    const page = await openOther();
    // The screenshots of the documentation show it.
    if (!isFirstVisit) await chooseSample(page, "Flower meadow");
    for (const state of states) {
      await state.reach({ page, server, restart, openOther });
      // The plan under way is a state of its own, which is not a passing one.
      if (state.isPassing) await planned(page);
      for (const colorScheme of schemes) {
        await page.emulateMedia({ colorScheme });
        await lookAtIt(page, state, colorScheme);
      }
      await page.keyboard.press("Escape");
    }
  } finally {
    for (const context of contexts) await context.close();
    await server.stop();
    data.remove();
  }
}
