/** Chromium for the tests that need a real one. */
import { chromium, type Browser, type BrowserContextOptions, type LaunchOptions } from "playwright-core";
import { findBrowser } from "../../../scripts/find-browser.mjs";

/** How long the page may take to show something: it is slow if the computer is busy. */
const PATIENCE_MS = 90_000;

/** For a test's pages: without animations and without storing the page for offline use. Both cost time. */
export const PLAIN: BrowserContextOptions = { reducedMotion: "reduce", serviceWorkers: "block" };

/**
 * Features of the browser that are switched off. Chromium obeys only the last list on its command line, so this one
 * replaces Playwright's list and repeats what matters here.
 */
const FEATURES_OFF = [
  // Two hidden pages for the address bar, loaded with each window. They cost as much as the page that is tested.
  "WebUIOmniboxPopup",
  "WebUIOmniboxAimPopup",
  "WebUIOmniboxFullPopup",
  // A spare process for the next page, which tests rarely open.
  "SpareRendererForSitePerProcess",
  // From Playwright's list.
  "AimEnabled",
  "AvoidUnnecessaryBeforeUnloadCheckSync",
  "DestroyProfileOnBrowserClose",
  "HttpsFirstBalancedModeAutoEnable",
  "HttpsUpgrades",
  "LensOverlay",
  "MediaRouter",
  "NetworkTimeServiceQuerying",
  "OptimizationHints",
  "PaintHolding",
  "PreconnectToSearch",
  "TcpPortRandomizationWin",
  "ThirdPartyStoragePartitioning",
];

/** Throws, with advice, if no browser is installed: a browser test is never skipped. */
export async function browserOptions(): Promise<LaunchOptions> {
  const executablePath = await findBrowser();
  if (executablePath === null) {
    throw new Error(
      "No Chromium, Chrome or Edge found. Install one, or set CHROMIUM_PATH to its program file.",
    );
  }
  // As on a computer without a graphics card: drawn by the processor, which is faster than an emulated card.
  const args = [`--disable-features=${FEATURES_OFF.join(",")}`];
  if (process.getuid?.() === 0) args.push("--no-sandbox");
  return { executablePath, args, timeout: 120_000 };
}

/**
 * The browser that the test files share, or a separate one for a script. `close` ends only what was opened
 * here.
 */
export async function launchBrowser(): Promise<Browser> {
  const shared = process.env["PLOTWRIGHT_BROWSER"];
  const browser = await (shared === undefined
    ? chromium.launch(await browserOptions())
    : chromium.connect(shared));
  browser.on("context", (context) => context.setDefaultTimeout(PATIENCE_MS));
  return browser;
}
