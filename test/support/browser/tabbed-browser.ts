/**
 * A Chromium whose tabs are hidden when another one is in front, as a user's are. Playwright reports the pages of its
 * contexts as visible and focused at all times, and disables the throttling of hidden tabs. Here Chromium starts with its
 * usual settings, and Playwright connects to it.
 */
import { spawn } from "node:child_process";
import { once } from "node:events";
import { chromium, type BrowserContext } from "playwright-core";
import { browserOptions } from "./browser.js";
import { temporaryFolder } from "../processes/folders.js";

export interface TabbedBrowser {
  /** Its pages are tabs of one window. */
  readonly context: BrowserContext;
  close(): Promise<void>;
}

export async function startTabbedBrowser(): Promise<TabbedBrowser> {
  const { executablePath = "", args = [] } = await browserOptions();
  const profile = temporaryFolder("profile");
  const child = spawn(
    executablePath,
    [
      "--headless",
      ...args,
      "--remote-debugging-port=0",
      `--user-data-dir=${profile.path}`,
      "--window-size=1280,900",
      "about:blank",
    ],
    { stdio: ["ignore", "ignore", "pipe"] },
  );
  const ended = once(child, "exit");
  const address = await new Promise<string>((resolve, reject) => {
    let output = "";
    child.stderr.on("data", (chunk: Buffer) => {
      output += chunk.toString();
      const found = /DevTools listening on (ws:\S+)/.exec(output)?.[1];
      if (found !== undefined) resolve(found);
    });
    child.once("error", reject);
    child.once("exit", (code) => reject(new Error(`the browser ended with code ${code}: ${output}`)));
  });
  const browser = await chromium.connectOverCDP(address, { noDefaults: true });
  const [context] = browser.contexts();
  return {
    context,
    close: async () => {
      const session = await browser.newBrowserCDPSession();
      // It may end before it answers.
      await session.send("Browser.close").catch(() => undefined);
      await ended;
      profile.remove();
    },
  };
}
