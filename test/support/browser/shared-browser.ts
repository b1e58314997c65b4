/** Starts Chromium once for all files with browser tests. Each file connects to it and opens its own contexts. */
import { chromium } from "playwright-core";
import { browserOptions } from "./browser.js";

export default async function setup(): Promise<() => Promise<void>> {
  const server = await chromium.launchServer(await browserOptions());
  process.env["PLOTWRIGHT_BROWSER"] = server.wsEndpoint();
  return () => server.close();
}
