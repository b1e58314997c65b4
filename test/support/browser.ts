/** Chromium for the tests that need a real one. */
import { chromium, type Browser } from "playwright-core";
import { findBrowser } from "../../scripts/find-browser.mjs";

/** Throws, with what to do, where no browser is installed: a browser test is never skipped. */
export async function launchBrowser(): Promise<Browser> {
  const executablePath = await findBrowser();
  if (executablePath === null) {
    throw new Error(
      "No Chromium, Chrome or Edge found. Install one, or set CHROMIUM_PATH to its program file.",
    );
  }
  // As on a computer without a graphics card: drawn by the processor, which is quicker than a card that is imitated.
  const args = process.getuid?.() === 0 ? ["--no-sandbox"] : [];
  return chromium.launch({ executablePath, args, timeout: 120_000 });
}
