/**
 * `npm run screenshots [-- FOLDER]`: every state of the page, at the size of a desk and of a phone, as PNG files
 * in test/screenshots/, and the README's picture in docs/. Look at them after changing anything that is seen.
 */
import { mkdirSync, readFileSync } from "node:fs";
import path from "node:path";
import type { Browser, Page } from "playwright-core";
import { launchBrowser } from "../test/support/browser.js";
import {
  dropFile,
  historyPanel,
  openTab,
  plotBar,
  queuePanel,
  waitForPlan,
} from "../test/support/page-actions.js";
import { startServerProcess, temporaryFolder } from "../test/support/server-process.js";
import { ROOT, ensureBuild } from "./setup.mjs";

const SIZES = { desk: { width: 1440, height: 900 }, phone: { width: 390, height: 844 } } as const;
const folder = path.resolve(process.argv[2] ?? path.join(ROOT, "test", "screenshots"));
const sample = (name: string): string => readFileSync(path.join(ROOT, "samples", `${name}.svg`), "utf8");

interface Shooting {
  readonly page: Page;
  readonly shoot: (state: string) => Promise<void>;
}

/** Enough strokes that planning them takes long enough to be seen. */
function manyStrokes(): string {
  const lines = Array.from({ length: 60_000 }, (_, i) => {
    const x = (i * 7919) % 290;
    const y = (i * 104_729) % 205;
    return `M${x} ${y}l3 2`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210"><path fill="none" stroke="#000" d="${lines.join("")}"/></svg>`;
}

const WITH_WARNINGS = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="120mm" viewBox="0 0 200 120">
  <text x="20" y="60">hello</text><image href="photo.png" x="100" y="20" width="60" height="60"/>
  <circle cx="60" cy="60" r="40" fill="none" stroke="#c00"/></svg>`;

async function beforePlotting({ page, shoot }: Shooting): Promise<void> {
  await waitForPlan(page);
  await shoot("1-first-visit");
  await dropFile(page, "three-colour-hills.svg", sample("three-colour-hills"));
  await page.waitForTimeout(300);
  await waitForPlan(page);
  await shoot("2-loaded");
  await dropFile(page, "many-strokes.svg", manyStrokes());
  await page.waitForTimeout(250);
  await shoot("3-planning");
  await dropFile(page, "photo.jpg", "\u0000\u0001\u0002", "image/jpeg");
  await page.waitForTimeout(600);
  await shoot("4-not-a-drawing");
  await dropFile(page, "torn.svg", sample("hello-paper").slice(0, 2_000));
  await page.waitForTimeout(600);
  await shoot("5-torn-file");
  await dropFile(page, "poster.svg", WITH_WARNINGS);
  await page.waitForTimeout(600);
  await shoot("6-not-everything-drawn");
}

async function plotting({ page, shoot }: Shooting): Promise<void> {
  await dropFile(page, "hello-paper.svg", sample("hello-paper"));
  await page.waitForTimeout(300);
  await waitForPlan(page);
  await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
  await openTab(page, "Queue");
  await queuePanel(page)
    .getByRole("button", { name: /^Start / })
    .waitFor();
  await shoot("7-queued");
  await queuePanel(page)
    .getByRole("button", { name: /^Start / })
    .click();
  await queuePanel(page).getByRole("progressbar").waitFor();
  await page.waitForTimeout(4_000);
  await shoot("8-plotting");
  await queuePanel(page).getByRole("button", { name: "Pause" }).click();
  await queuePanel(page).getByRole("button", { name: "Resume" }).waitFor();
  await shoot("9-paused");
  await queuePanel(page).getByRole("button", { name: "Resume" }).click();
  await historyPanel(page).getByText("Done").first().waitFor({ timeout: 180_000 });
  await shoot("10-done");
  await openTab(page, "Plotter");
  await shoot("10-plotter");
  await openTab(page, "Set up");
}

async function session(
  browser: Browser,
  size: keyof typeof SIZES,
  colorScheme: "light" | "dark",
): Promise<void> {
  const data = temporaryFolder("screenshots");
  const server = await startServerProcess({ dataDir: data.path, virtualSpeed: 20 });
  const context = await browser.newContext({
    viewport: SIZES[size],
    colorScheme,
    hasTouch: size === "phone",
  });
  const page = await context.newPage();
  const shoot = async (state: string): Promise<void> => {
    const name = `${size}-${colorScheme}-${state}.png`;
    await page.screenshot({ path: path.join(folder, name), timeout: 120_000 });
    console.log(name);
  };
  try {
    await page.goto(server.url);
    await beforePlotting({ page, shoot });
    if (colorScheme === "light") await plotting({ page, shoot });
    await server.stop();
    await page.waitForTimeout(1_500);
    await shoot("11-server-gone");
  } finally {
    await context.close();
    await server.stop();
    data.remove();
  }
}

async function pictureForReadme(browser: Browser): Promise<void> {
  const data = temporaryFolder("screenshots");
  const server = await startServerProcess({ dataDir: data.path });
  const page = await browser.newPage({ viewport: { width: 1240, height: 780 }, colorScheme: "light" });
  try {
    await page.goto(server.url);
    await waitForPlan(page);
    await dropFile(page, "three-colour-hills.svg", sample("three-colour-hills"));
    await page.getByText("1 Sun").waitFor();
    await waitForPlan(page);
    // Without a graphics card a frame may take seconds.
    await page.waitForTimeout(10_000);
    await page.screenshot({ path: path.join(ROOT, "docs", "screenshot.png") });
  } finally {
    await page.close();
    await server.stop();
    data.remove();
  }
}

ensureBuild();
mkdirSync(folder, { recursive: true });
const browser = await launchBrowser();
try {
  await pictureForReadme(browser);
  await session(browser, "desk", "light");
  await session(browser, "phone", "light");
  await session(browser, "desk", "dark");
} finally {
  await browser.close();
}
