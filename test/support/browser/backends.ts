/** Starts the page with either backend in the same way, so that one test can run against both. */
import { once } from "node:events";
import type { Browser, Page } from "playwright-core";
import { PLAIN } from "./browser.js";
import { temporaryFolder } from "../processes/folders.js";
import { startServerProcess } from "../processes/server-process.js";
import { startStaticApp } from "./static-app.js";

export const BACKENDS = ["server", "browser"] as const;
type BackendName = (typeof BACKENDS)[number];

export interface StartedPage {
  page: Page;
  /**
   * Kills what runs the plots (the server's process, or the tab) without any warning, starts it again and opens a
   * page that has nothing in its localStorage.
   */
  killAndReopen(): Promise<void>;
  /** What the backend has stored about its plotters, as JSON. */
  storedPlotters(): Promise<string>;
  close(): Promise<void>;
}

/** Board seconds per second on the virtual board, at first and after `killAndReopen`. */
const VIRTUAL_SPEED = 10;
const SPEED_AFTER_KILL = 50;

export async function startPage(backend: BackendName, browser: Browser): Promise<StartedPage> {
  const context = await browser.newContext({ ...PLAIN, viewport: { width: 1024, height: 700 } });
  const open = async (url: string): Promise<Page> => {
    const page = await context.newPage();
    page.on("dialog", (dialog) => void dialog.accept());
    await page.goto(url);
    return page;
  };

  if (backend === "browser") {
    const app = await startStaticApp();
    const urlAt = (speed: number): string => `${app.url}/?virtual-speed=${speed}`;
    const started: StartedPage = {
      page: await open(urlAt(VIRTUAL_SPEED)),
      killAndReopen: async () => {
        await started.page.evaluate(() => localStorage.clear());
        await crash(started.page);
        started.page = await open(urlAt(SPEED_AFTER_KILL));
      },
      storedPlotters: async () => JSON.stringify(await storedRecords(started.page, "plotters")),
      close: async () => {
        await context.close();
        await app.close();
      },
    };
    return started;
  }

  const data = temporaryFolder("backends");
  const serve = (virtualSpeed: number) => startServerProcess({ dataDir: data.path, virtualSpeed });
  let server = await serve(VIRTUAL_SPEED);
  const started: StartedPage = {
    page: await open(server.url),
    killAndReopen: async () => {
      const ended = once(server.process, "exit");
      server.process.kill("SIGKILL");
      await ended;
      await started.page.close();
      // Another port is another origin, so nothing is in localStorage.
      server = await serve(SPEED_AFTER_KILL);
      started.page = await open(server.url);
    },
    storedPlotters: async () => (await fetch(`${server.url}/api/v1/state`)).text(),
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

/** All records of a store in the database of the page's own backend. */
export const storedRecords = (page: Page, store: "jobs" | "plotters"): Promise<unknown[]> =>
  page.evaluate(
    (name) =>
      new Promise<unknown[]>((resolve, reject) => {
        const opening = indexedDB.open("plotwright-host");
        opening.onerror = () => reject(new Error("no database"));
        opening.onsuccess = () => {
          const reading = opening.result.transaction(name).objectStore(name).getAll();
          reading.onsuccess = () => {
            opening.result.close();
            resolve(reading.result as unknown[]);
          };
        };
      }),
    store,
  );
