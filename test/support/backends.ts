/** Starts the page with either backend in the same way, so that one test can run against both. */
import { once } from "node:events";
import type { Browser, Page } from "playwright-core";
import { startServerProcess, temporaryFolder } from "./server-process.js";
import { buildStaticApp, startStaticApp } from "./static-app.js";

export const BACKENDS = ["server", "browser"] as const;
export type BackendName = (typeof BACKENDS)[number];

export interface StartedPage {
  page: Page;
  /**
   * Kills what runs the plots (the server's process, or the tab) without any warning, starts it again and opens a
   * page that has nothing in its localStorage.
   */
  killAndReopen(): Promise<void>;
  close(): Promise<void>;
}

const PATIENCE_MS = 90_000;
/** Board seconds per second on the virtual board. */
const VIRTUAL_SPEED = 10;

export async function startPage(backend: BackendName, browser: Browser): Promise<StartedPage> {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  const open = async (url: string): Promise<Page> => {
    const page = await context.newPage();
    page.setDefaultTimeout(PATIENCE_MS);
    page.on("dialog", (dialog) => void dialog.accept());
    await page.goto(url);
    return page;
  };

  if (backend === "browser") {
    const built = buildStaticApp();
    const app = await startStaticApp(built.path);
    const url = `${app.url}/?virtual-speed=${VIRTUAL_SPEED}`;
    const started: StartedPage = {
      page: await open(url),
      killAndReopen: async () => {
        await started.page.evaluate(() => localStorage.clear());
        await crash(started.page);
        started.page = await open(url);
      },
      close: async () => {
        await context.close();
        await app.close();
        built.remove();
      },
    };
    return started;
  }

  const data = temporaryFolder("backends");
  const serve = () => startServerProcess({ dataDir: data.path, virtualSpeed: VIRTUAL_SPEED });
  let server = await serve();
  const started: StartedPage = {
    page: await open(server.url),
    killAndReopen: async () => {
      const ended = once(server.process, "exit");
      server.process.kill("SIGKILL");
      await ended;
      await started.page.close();
      // Another port is another origin, so nothing is in localStorage.
      server = await serve();
      started.page = await open(server.url);
    },
    close: async () => {
      await context.close();
      await server.stop();
      data.remove();
    },
  };
  return started;
}

/** Ends the page's process at once: nothing of the page or its workers runs any more. */
export async function crash(page: Page): Promise<void> {
  const session = await page.context().newCDPSession(page);
  const crashed = page.waitForEvent("crash");
  // It gets no answer.
  session.send("Page.crash").catch(() => undefined);
  await crashed;
}
