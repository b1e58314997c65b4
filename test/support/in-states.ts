/** Brings the page into its states (page-states.ts) for a screen size, light and dark. */
import type { Browser, BrowserContext, Page } from "playwright-core";
import { chooseSample } from "./page-actions.js";
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

const SCHEMES = ["light", "dark"] as const;
export type Scheme = (typeof SCHEMES)[number];

type LookAtIt = (page: Page, state: PageState, scheme: Scheme) => Promise<void>;

/**
 * Brings the page into each of the states and calls `lookAtIt`, light and dark. States that leave nothing
 * behind share one page; each of the others has its own server.
 */
export async function inStates(
  browser: Browser,
  states: readonly PageState[],
  look: Look,
  lookAtIt: LookAtIt,
): Promise<void> {
  const passing = states.filter(({ isPassing }) => isPassing);
  const lasting = states.filter(({ isPassing }) => !isPassing);
  const groups = [passing, ...lasting.map((state) => [state])].filter((group) => group.length > 0);
  for (const group of groups) await inGroup(browser, group, look, lookAtIt);
}

async function inGroup(
  browser: Browser,
  states: readonly PageState[],
  { width, height }: Look,
  lookAtIt: LookAtIt,
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
  // Colour transitions have ended when the check runs.
  const reducedMotion = "reduce" as const;
  const contexts: BrowserContext[] = [];
  const openOther = async (path = "/"): Promise<Page> => {
    const context = await browser.newContext({
      viewport: { width, height },
      hasTouch: width < 760,
      reducedMotion,
      // Storing the page for offline use costs time.
      serviceWorkers: "block",
    });
    contexts.push(context);
    const other = await context.newPage();
    await other.goto(`${server.url}${path}`);
    return other;
  };
  try {
    const page = await openOther();
    if (!isFirstVisit) await chooseSample(page);
    for (const state of states) {
      await state.reach({ page, server, restart, openOther });
      for (const colorScheme of SCHEMES) {
        await page.emulateMedia({ colorScheme, reducedMotion });
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
