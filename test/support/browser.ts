/** Chromium for the tests that need a real one. */
import { chromium, type Browser, type LaunchOptions } from "playwright-core";
import { findBrowser } from "../../scripts/find-browser.mjs";

/** How long the page may take to show something: it is slow if the computer is busy. */
const PATIENCE_MS = 90_000;

/** Throws, with advice, if no browser is installed: a browser test is never skipped. */
export async function browserOptions(): Promise<LaunchOptions> {
  const executablePath = await findBrowser();
  if (executablePath === null) {
    throw new Error(
      "No Chromium, Chrome or Edge found. Install one, or set CHROMIUM_PATH to its program file.",
    );
  }
  // As on a computer without a graphics card: drawn by the processor, which is faster than an emulated card.
  const args = process.getuid?.() === 0 ? ["--no-sandbox"] : [];
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
