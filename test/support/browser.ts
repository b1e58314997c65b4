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
  // Software WebGL, so that the preview is drawn as on a machine with a graphics card.
  const args = ["--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--ignore-gpu-blocklist"];
  const isRoot = process.getuid?.() === 0;
  return chromium.launch({ executablePath, args: isRoot ? [...args, "--no-sandbox"] : args });
}
