/**
 * The web site of `npm run build:site`: its links, every page of the documentation, and the app in Chromium. It is served
 * below a path, as on a host that has several projects.
 */
import { readFileSync, readdirSync, statSync } from "node:fs";
import path from "node:path";
import { gzipSync } from "node:zlib";
import type { Browser, BrowserContextOptions, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT, TEST_SITE } from "../../../scripts/setup.mjs";
import { PAGES } from "../../../scripts/site/pages.js";
import { seriousFindings } from "../../support/browser/axe.js";
import { launchBrowser } from "../../support/browser/browser.js";
import { IS_FULL } from "../../support/runs/full-run.js";
import { chooseSample, waitForPicture } from "../../support/browser/page-actions.js";
import { serveFolder, type StaticSite } from "../../support/browser/static-site.js";

const { base: BASE, folder, source: SOURCE } = TEST_SITE;
const DOC_FILES = PAGES.map(({ file }) => `docs/${file}`);
const PAGE_FILES = ["index.html", ...DOC_FILES, "404.html"];

let browser: Browser;
let site: StaticSite;

beforeAll(async () => {
  browser = await launchBrowser();
  site = await serveFolder(folder, BASE);
});
afterAll(async () => {
  await site.close();
  await browser.close();
});

const read = (file: string): string => readFileSync(path.join(folder, file), "utf8");
const htmlFiles = (): string[] =>
  readdirSync(folder, { recursive: true, encoding: "utf8" })
    .map((file) => file.replaceAll("\\", "/"))
    .filter((file) => file.endsWith(".html"));

/** What is wrong with a link of a page, or null. Links to other sites are not followed. */
function faultOf(from: string, link: string): string | null {
  const base = `http://site${BASE}`;
  const target = new URL(link.replaceAll("&amp;", "&"), `${base}${from}`);
  if (target.host !== "site") {
    const isSafe = target.protocol === "https:" || target.hostname === "127.0.0.1";
    return isSafe ? null : `${from}: ${link} is not https`;
  }
  if (!target.pathname.startsWith(BASE)) return `${from}: ${link} leaves the site`;
  const file = decodeURIComponent(target.pathname.slice(BASE.length));
  const isThere = statSync(path.join(folder, file), { throwIfNoEntry: false })?.isFile() ?? false;
  if (!isThere) return `${from}: ${link} leads nowhere`;
  const id = decodeURIComponent(target.hash.slice(1));
  if (id !== "" && !read(file).includes(` id="${id}"`)) return `${from}: ${link} has no such heading`;
  return null;
}

describe("the files of the site", () => {
  it("have only links that lead somewhere", () => {
    const links = htmlFiles().flatMap((from) =>
      [...read(from).matchAll(/\s(?:href|src)="([^"]*)"/g)].map((match) => ({ from, link: match[1] ?? "" })),
    );
    expect(links.length).toBeGreaterThan(1_000);
    const faults = links.map(({ from, link }) => faultOf(from, link)).filter((fault) => fault !== null);
    expect(faults).toEqual([]);
  });

  it("have a content security policy, and nothing inline that it forbids", () => {
    for (const file of htmlFiles()) {
      const html = read(file);
      expect([file, /<meta\s+http-equiv="Content-Security-Policy"/.test(html)]).toEqual([file, true]);
      expect([file, /<script(?![^>]*\ssrc=)|<style|\sstyle=|\son\w+=/.exec(html)?.[0]]).toEqual([
        file,
        undefined,
      ]);
    }
  });

  it("have pictures of at most 200 kB, each with a description", () => {
    const sizes = readdirSync(path.join(folder, "docs", "screenshots")).map(
      (name) => statSync(path.join(folder, "docs", "screenshots", name)).size,
    );
    expect(sizes.length).toBeGreaterThanOrEqual(3);
    expect(Math.max(...sizes)).toBeLessThanOrEqual(200_000);
    const withoutWords = DOC_FILES.flatMap(
      (file) => read(file).match(/<article>[\s\S]*<\/article>/)?.[0] ?? "",
    ).flatMap((article) => [...article.matchAll(/<img [^>]*alt=""/g)]);
    expect(withoutWords).toEqual([]);
  });

  it("have titles and descriptions that differ", () => {
    const titles = DOC_FILES.map((file) => /<title>(.*)<\/title>/.exec(read(file))?.[1]);
    expect(new Set(titles).size).toBe(DOC_FILES.length);
    const descriptions = DOC_FILES.map(
      (file) => /<meta name="description" content="([^"]*)">/.exec(read(file))?.[1] ?? "",
    );
    expect(new Set(descriptions).size).toBe(DOC_FILES.length);
    const lengths = descriptions.map((text) => text.length);
    expect(Math.min(...lengths)).toBeGreaterThan(30);
    expect(Math.max(...lengths)).toBeLessThanOrEqual(200);
  });

  it("lead to their sources", () => {
    for (const { file, source } of PAGES) {
      expect(read(`docs/${file}`)).toContain(`href="${SOURCE}/blob/main/${source}"`);
    }
    expect(read("index.html")).toContain(`href="${SOURCE}"`);
  });

  it("have the licence of each package in the scripts", () => {
    expect(read("docs/search.js")).toMatch(/minisearch[\s\S]*Permission is hereby granted/);
  });

  it("load little: a page of the documentation is at most 60 kB gzipped, with style and script", () => {
    const bytes = (file: string): number => gzipSync(readFileSync(path.join(folder, file))).length;
    const shared = bytes("docs/site.css") + bytes("docs/site.js") + bytes("docs/icon.svg");
    expect(Math.max(...PAGE_FILES.map((file) => shared + bytes(file)))).toBeLessThanOrEqual(60_000);
    // Loaded when a reader goes to the search field.
    expect(bytes("docs/search.js") + bytes("docs/search-index.json")).toBeLessThanOrEqual(300_000);
  });
});

/** Errors of the console, and requests that failed. */
function complaintsOf(page: Page): string[] {
  const complaints: string[] = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(`${page.url()}: ${message.text()}`);
  });
  page.on("requestfailed", (request) => {
    const words = request.failure()?.errorText ?? "";
    // A page that is left does not load the rest of its files.
    if (words !== "net::ERR_ABORTED") complaints.push(`${request.url()}: ${words}`);
  });
  return complaints;
}

describe("each page of the site", () => {
  // axe takes seconds for a long page, and all pages are made of the same parts: the full run checks each.
  const EXAMPLES = ["index.html", "docs/index.html", "docs/library.html", "docs/motion.html", "404.html"];
  it.each([
    ["light", PAGE_FILES],
    ["dark", IS_FULL ? PAGE_FILES : EXAMPLES],
  ] as const)("has no error and no serious finding of axe in %s", async (colorScheme, files) => {
    const viewport = { width: 1440, height: 900 };
    const page = await browser.newPage({ colorScheme, viewport, serviceWorkers: "block" });
    const complaints = complaintsOf(page);
    for (const file of files) {
      await page.goto(site.url + file);
      expect(await page.locator("h1").count()).toBe(1);
      const findings = IS_FULL || EXAMPLES.includes(file) ? await seriousFindings(page) : [];
      complaints.push(...findings.map((finding) => `${file}: ${finding}`));
    }
    await page.close();
    expect(complaints).toEqual([]);
  });

  it("fits a phone's width, and its code too, unless it is drawn with characters", async () => {
    const page = await browser.newPage({ viewport: { width: 390, height: 844 }, serviceWorkers: "block" });
    for (const file of PAGE_FILES) {
      await page.goto(site.url + file);
      const widthPx = await page.evaluate(() => document.documentElement.scrollWidth);
      expect([file, widthPx]).toEqual([file, 390]);
      const tooWide = await page.evaluate(() =>
        [...document.querySelectorAll("pre.wraps")]
          .filter((code) => code.scrollWidth > code.clientWidth)
          .map((code) => code.textContent),
      );
      expect([file, tooWide]).toEqual([file, []]);
    }
    await page.close();
  });

  it("asks no other server for anything", async () => {
    const page = await browser.newPage({ serviceWorkers: "block" });
    const foreign: string[] = [];
    page.on("request", (request) => {
      if (!request.url().startsWith(site.url)) foreign.push(request.url());
    });
    for (const file of PAGE_FILES) await page.goto(site.url + file);
    await page.close();
    expect(foreign).toEqual([]);
  });
});

describe("a reader", () => {
  const newReader = (options: BrowserContextOptions = {}): Promise<Page> =>
    browser.newPage({ serviceWorkers: "block", ...options });
  const PHONE = { viewport: { width: 390, height: 844 } };

  it("finds the way from the start page to the app and to installing it", async () => {
    const page = await newReader();
    const complaints = complaintsOf(page);
    await page.goto(site.url);
    await page.getByRole("link", { name: "Install", exact: true }).click();
    await page.getByRole("heading", { level: 1, name: "Install" }).waitFor();
    await page.getByRole("link", { name: "plotwright", exact: true }).click();
    await page.getByRole("link", { name: "Try it in the browser" }).click();
    await page.getByText("Drop a drawing here").waitFor();
    expect(complaints).toEqual([]);
    await page.close();
  });

  it("opens the menu on a phone", async () => {
    const page = await newReader(PHONE);
    await page.goto(`${site.url}docs/index.html`);
    const link = page.getByRole("navigation").getByRole("link", { name: "Brushless servo" });
    await expect.poll(() => link.isVisible()).toBe(false);
    await page.getByRole("button", { name: "Menu" }).click();
    await link.click();
    await page.waitForURL(/docs\/brushless-servo\.html$/);
    await page.close();
  });

  it.each([
    [
      "words of a heading",
      "corner costs",
      /^What one corner costs/,
      /comparison\.html#what-one-corner-costs$/,
    ],
    ["words of the text", "ModemManager udev", /Raspberry Pi/, /raspberry-pi\.html#3-access-to-the-plotter$/],
    ["an option of another program", "--pen_pos_down", /AxiDraw/, /from-axidraw\.html#/],
    ["a word with a typing error", "brushles", /brushless servo/i, /brushless-servo\.html/],
  ])("finds %s", async (_, words, name, address) => {
    const page = await newReader(PHONE);
    const complaints = complaintsOf(page);
    await page.goto(site.url);
    await page.keyboard.press("/");
    await page.getByRole("searchbox", { name: "Search" }).fill("xyzzy");
    await page.getByText("Nothing found for “xyzzy”.").waitFor();
    await page.getByRole("searchbox", { name: "Search" }).fill(words);
    await page.locator("#found mark").first().waitFor();
    await page.locator("#found").getByRole("link", { name }).first().click();
    await page.waitForURL(address);
    expect(complaints).toEqual([]);
    await page.close();
  });

  it("gets the highlighted text of an example without its colours by the button", async () => {
    const page = await newReader({ permissions: ["clipboard-read", "clipboard-write"] });
    await page.goto(`${site.url}docs/library.html`);
    const example = page.locator(".code", { hasText: "planSvg" }).first();
    expect(await example.locator(".hljs-keyword").count()).toBeGreaterThan(2);
    await example.hover();
    await example.getByRole("button", { name: "Copy" }).click();
    await example.getByRole("button", { name: "Copied" }).waitFor();
    const copied = await page.evaluate(() => navigator.clipboard.readText());
    expect(readFileSync(path.join(ROOT, "docs", "library.md"), "utf8")).toContain(copied);
    expect(copied).toMatch(/^import \{/);
    await page.close();
  });

  it("chooses a theme, which the next page keeps", async () => {
    const page = await newReader({ colorScheme: "light" });
    const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    await page.goto(site.url);
    const light = await background();
    await page.getByRole("combobox", { name: "Theme" }).selectOption("dark");
    const dark = await background();
    expect(dark).not.toBe(light);
    await page.goto(`${site.url}docs/first-plot.html`);
    expect(await background()).toBe(dark);
    await page.getByRole("combobox", { name: "Theme" }).selectOption("system");
    expect(await background()).toBe(light);
    await page.close();
  });

  it("gets a page with links for an unknown address", async () => {
    const page = await browser.newPage({ serviceWorkers: "block" });
    const response = await page.goto(`${site.url}docs/a/b/c.html`);
    expect(response?.status()).toBe(404);
    await page.getByRole("link", { name: "overview", exact: true }).click();
    await page.getByRole("heading", { level: 1, name: "plotwright" }).waitFor();
    await page.close();
  });

  it("can read every page without a network after one visit", async () => {
    const context = await browser.newContext();
    const page = await context.newPage();
    const host = await serveFolder(folder, BASE);
    await page.goto(`${host.url}docs/index.html`);
    await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
    await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
    await host.close();
    for (const file of ["docs/first-plot.html", "docs/motion.html", "docs/", ""]) {
      await page.goto(host.url + file);
      expect(await page.locator("h1").count()).toBe(1);
    }
    await page.goto(`${host.url}docs/first-plot.html`);
    const isDrawn = await page
      .locator("article img")
      .first()
      .evaluate((image) => (image as HTMLImageElement).naturalWidth > 0);
    expect(isDrawn).toBe(true);
    await page.getByRole("searchbox", { name: "Search" }).fill("emergency");
    await page.locator("#found mark").first().waitFor();
    await context.close();
  });
});

describe("the app of the site", () => {
  const openApp = async (page: Page, host: StaticSite): Promise<void> => {
    await page.goto(`${host.url}app/index.html`);
    await page.getByText("Drop a drawing here").waitFor();
  };

  it("loads at most 300 kB of code, gzipped, for an empty sheet, and shows no error under its policy", async () => {
    const page = await browser.newPage({ serviceWorkers: "block" });
    const complaints = complaintsOf(page);
    const loaded = new Map<string, number>();
    page.on("response", (response) => {
      if (!response.url().startsWith(site.url)) return;
      const file = new URL(response.url()).pathname.slice(BASE.length);
      loaded.set(file, gzipSync(readFileSync(path.join(folder, file))).length);
    });
    await openApp(page, site);
    await page.waitForLoadState("networkidle");
    // The samples' pictures come after the page, and the font is no code.
    const bytes = [...loaded]
      .filter(([file]) => !/\.(svg|woff2)$/.test(file))
      .reduce((sum, [, size]) => sum + size, 0);
    expect([...loaded.keys()].filter((file) => file.endsWith(".js")).length).toBeGreaterThan(2);
    expect(bytes).toBeLessThanOrEqual(300_000);
    await chooseSample(page);
    await waitForPicture(page);
    expect(complaints).toEqual([]);
    await page.close();
  });

  it("opens and plans a sample without a network after one visit", async () => {
    const context = await browser.newContext();
    const page = await context.newPage();
    const host = await serveFolder(folder, BASE);
    await openApp(page, host);
    await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
    await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
    await host.close();
    await openApp(page, host);
    await chooseSample(page);
    await context.close();
  });
});
