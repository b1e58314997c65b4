/** Brings the page into its states (page-states.ts) for a screen size, light and dark. */
import type { Browser, BrowserContext, Page } from "playwright-core";
import { nodeModule } from "../../../scripts/setup.mjs";
import { PLAIN } from "./browser.js";
import { chooseSample, nextFrames } from "./page-actions.js";
import type { PageState } from "./page-states/page-state.js";
import { temporaryFolder } from "../processes/folders.js";
import { startServerProcess, type ServerProcess } from "../processes/server-process.js";

/** The size of a screen. */
export interface Look {
  readonly name: string;
  readonly width: number;
  readonly height: number;
}
export const DESK: Look = { name: "desk", width: 1440, height: 900 };
const WIDE: Look = { name: "wide", width: 1920, height: 1080 };
const TABLET: Look = { name: "tablet", width: 1024, height: 768 };
export const PHONE: Look = { name: "phone", width: 390, height: 844 };
export const LOOKS: readonly Look[] = [DESK, WIDE, TABLET, PHONE];

export const SCHEMES = ["light", "dark"] as const;
export type Scheme = (typeof SCHEMES)[number];

/** A font of the page: `file` replaces the one that the page ships, as where a browser uses a font of its system. */
export interface Font {
  readonly name: string;
  readonly file: string | null;
}
const fontFile = (name: string): string =>
  nodeModule("@fontsource", name, "files", `${name}-latin-400-normal.woff2`);
export const SHIPPED_FONT: Font = { name: "the shipped font", file: null };
/** Arimo has the widths of Arial; DejaVu Sans is among the widest fonts of systems. */
export const FONTS: readonly Font[] = [
  SHIPPED_FONT,
  { name: "Arimo", file: fontFile("arimo") },
  { name: "DejaVu Sans", file: fontFile("dejavu-sans") },
];

export async function useFont(context: BrowserContext, { file }: Font): Promise<void> {
  if (file !== null) await context.route("**/*.woff2", (route) => route.fulfill({ path: file }));
}

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
  font: Font = SHIPPED_FONT,
): Promise<void> {
  const passing = states.filter(({ isPassing }) => isPassing);
  const lasting = states.filter(({ isPassing }) => !isPassing);
  const groups = [passing, ...lasting.map((state) => [state])].filter((group) => group.length > 0);
  for (const group of groups) await inGroup(browser, group, look, lookAtIt, schemes, font);
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
  font: Font,
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
    await useFont(context, font);
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
