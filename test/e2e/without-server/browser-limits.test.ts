/** The page without a server in a browser that is too old, does not let it use a plotter, or stores nothing. */
import { chromium, type Browser, type Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { browserOptions, launchBrowser, PLAIN } from "../../support/browser/browser.js";
import {
  dropFile,
  historyPanel,
  openPanel,
  openView,
  plotBar,
  queuePanel,
  waitForPlan,
} from "../../support/browser/page-actions.js";
import { startStaticApp, type StaticApp, type StaticAppOptions } from "../../support/browser/static-app.js";

const PATIENCE_MS = 90_000;
/** Any name that is not this computer's makes a page insecure. */
const INSECURE_HOST = "plotter.test";
const LINE = `<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="40mm" viewBox="0 0 80 40"><path d="M10 10h60" stroke="black"/></svg>`;
/** A drawing of 3 MB. */
const LARGE = LINE.replace("<path", `<!--${"x".repeat(3_000_000)}--><path`);

let browser: Browser;
let app: StaticApp | null = null;
let page: Page;

beforeAll(async () => {
  browser = await launchBrowser();
});
afterAll(() => browser.close());
afterEach(async () => {
  await page.context().close();
  await app?.close();
  app = null;
});

/** A page of the app's origin, without the app. */
async function openOrigin(from: Browser, options: StaticAppOptions = {}): Promise<void> {
  app = await startStaticApp(1, options);
  const context = await from.newContext({ ...PLAIN, viewport: { width: 1024, height: 700 } });
  page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  page.on("dialog", (dialog) => void dialog.accept());
  await page.goto(`${app.url}/icon.svg`);
}

const openApp = async (url = app?.url): Promise<void> => void (await page.goto(`${url}/?virtual-speed=10`));

async function lay(name: string, text: string): Promise<void> {
  await dropFile(page, `${name}.svg`, text);
  await page.getByText(name, { exact: true }).first().waitFor({ state: "attached" });
  await waitForPlan(page);
}

async function addToQueue(): Promise<void> {
  await openPanel(page, "Queue");
  await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
}
const queued = (name: string) => queuePanel(page).getByRole("button", { name: `More for ${name}` });
const startOf = (name: string) => queuePanel(page).getByRole("button", { name: `Start ${name}` });

async function plotsOnTheVirtualBoard(): Promise<void> {
  await lay("line", LINE);
  await addToQueue();
  await startOf("line").click();
  await openView(page, "Prepare");
  await historyPanel(page).getByText("Done", { exact: true }).waitFor();
}

describe("a browser that does not let the page use a plotter", { timeout: 200_000 }, () => {
  async function expectVirtualBoardOnly(words: RegExp): Promise<void> {
    await page.getByText(words).waitFor();
    expect(await page.getByRole("button", { name: "Connect a plotter…" }).count()).toBe(0);
    await plotsOnTheVirtualBoard();
  }

  it("the page says that the browser has no Web Serial, and plots on the virtual board", async () => {
    await openOrigin(browser);
    await page.addInitScript(() =>
      Object.defineProperty(Navigator.prototype, "serial", { value: undefined }),
    );
    await openApp();
    await expectVirtualBoardOnly(/Open this page in Chrome or Edge on a computer/);
  });

  it("the page says that it is insecure, and plots on the virtual board", async () => {
    const { args = [], ...options } = await browserOptions();
    const rule = `--host-resolver-rules=MAP ${INSECURE_HOST} 127.0.0.1`;
    const own = await chromium.launch({ ...options, args: [...args, rule] });
    try {
      await openOrigin(own);
      await openApp(app?.url.replace("127.0.0.1", INSECURE_HOST));
      expect(await page.evaluate(() => isSecureContext)).toBe(false);
      await expectVirtualBoardOnly(/Open it at its https address, or at http:\/\/localhost/);
    } finally {
      await own.close();
    }
  });
});

describe("a browser that is too old", { timeout: 200_000 }, () => {
  const advice = () => page.getByText("it needs Chrome or Edge 105, Firefox 121, Safari 16.4, or later");

  it("to draw outside the page's thread is named, and the page is not blank", async () => {
    await openOrigin(browser);
    await page.addInitScript(() => Reflect.deleteProperty(globalThis, "OffscreenCanvas"));
    await openApp();
    await advice().waitFor();
    expect(await page.getByRole("button").count()).toBe(0);
  });

  it("to read the page's code is named, and the page is not blank", async () => {
    await openOrigin(browser);
    const unreadable = { contentType: "text/javascript", body: "const a = 1 |||| 2;" };
    await page.route(/assets\/index-[^/]*\.js$/, (route) => route.fulfill(unreadable));
    await openApp();
    await advice().waitFor();
  });

  it("or too new gets no such advice", async () => {
    await openOrigin(browser);
    await openApp();
    await page.getByText("Drop a drawing here").waitFor();
    expect(await advice().count()).toBe(0);
  });
});

describe("a browser whose worker can't draw", { timeout: 200_000 }, () => {
  it("says so in the drawing's place, and plots", async () => {
    await openOrigin(browser);
    const failing = { contentType: "text/javascript", body: `throw new Error("no canvas");` };
    await page.route(/assets\/draw\.worker-[^/]*\.js$/, (route) => route.fulfill(failing));
    await openApp();
    await page
      .getByText(/The drawing can’t be shown here, but it can be plotted/)
      .first()
      .waitFor();
    await plotsOnTheVirtualBoard();
  });
});

describe("a browser's storage", { timeout: 200_000 }, () => {
  it("a refused storage is reported, and the page plots without it", async () => {
    const refuse = `IDBFactory.prototype.open = () => { throw new DOMException("blocked", "SecurityError"); };`;
    await openOrigin(browser, { workerScript: refuse });
    await openApp();
    await page.getByText(/The browser stores nothing for this site/).waitFor();
    await plotsOnTheVirtualBoard();
  });

  it("a full storage stops neither a plot whose drawing is stored, nor opening it", async () => {
    const workerScript = `
      const put = IDBObjectStore.prototype.put;
      IDBObjectStore.prototype.put = function (value, key) {
        if (this.name === "jobs" && value.job.state !== "queued") throw new DOMException("", "QuotaExceededError");
        return put.call(this, value, key);
      };`;
    await openOrigin(browser, { workerScript });
    await openApp();
    await plotsOnTheVirtualBoard();
    await page
      .getByText(/The last changes are only in this tab.* storage for this site is full/)
      .first()
      .waitFor();
    await lay("other", LINE);
    await historyPanel(page).getByRole("button", { name: "More for line" }).click();
    await page.getByRole("button", { name: "Open line" }).click();
    await page.getByText("other", { exact: true }).first().waitFor({ state: "detached" });
  });

  it("a full storage is reported, and nothing is lost until there is room", async () => {
    await openOrigin(browser);
    const session = await page.context().newCDPSession(page);
    const origin = String(app?.url);
    // Before its first use: Chromium remembers for a while how much room there is.
    await session.send("Storage.overrideQuotaForOrigin", { origin, quotaSize: 2_000_000 });
    await openApp();
    await lay("line", LINE);
    await addToQueue();
    await queued("line").waitFor();

    // A drawing that has no room is not added. It stays on the page.
    await lay("large", LARGE);
    await page.getByText(/can’t store this drawing, so it will not be here at the next visit/).waitFor();
    await addToQueue();
    await page
      .getByText(/The job was not added; the drawing is still on the page\..* storage for this site is full/)
      .waitFor();
    await page.getByText("large", { exact: true }).first().waitFor();
    await queued("line").waitFor();

    // With room it is added, the message is gone, and all of it is stored.
    await session.send("Storage.overrideQuotaForOrigin", { origin });
    await addToQueue();
    await queued("large").waitFor();
    await page.getByText(/The last changes are only in this tab/).waitFor({ state: "detached" });
    await page.reload();
    await queued("line").waitFor();
    await queued("large").waitFor();
  });

  it("a storage that the user clears is filled again, and the page says that the drawings are gone", async () => {
    await openOrigin(browser);
    const session = await page.context().newCDPSession(page);
    await openApp();
    await plotsOnTheVirtualBoard();
    await lay("waiting", LINE);
    await addToQueue();
    await queued("waiting").waitFor();
    await session.send("Storage.clearDataForOrigin", {
      origin: String(app?.url),
      storageTypes: "indexeddb",
    });
    await page.getByText(/The data of this site were cleared in the browser/).waitFor();

    await startOf("waiting").click();
    await page
      .getByText(/The browser no longer has this drawing\. Add it again\./)
      .first()
      .waitFor();
    await lay("later", LINE);
    await addToQueue();
    await queued("later").waitFor();
    expect(await page.getByText(/The last changes are only in this tab/).count()).toBe(0);

    await page.reload();
    await queued("later").waitFor();
    await historyPanel(page).getByRole("button", { name: "More for line" }).waitFor();
  });
});
