/**
 * `npm run screenshots [-- FOLDER [STATE…]]`: every state of the page, at four sizes of screen, light and
 * dark, as PNG files in test/screenshots/, and the README's picture in docs/. Look at them after each visible
 * change. Each state is also checked by axe; serious findings are printed, and set exit code 1.
 */
import { mkdirSync } from "node:fs";
import path from "node:path";
import type { Browser, Page } from "playwright-core";
import { seriousFindings } from "../test/support/axe.js";
import { launchBrowser } from "../test/support/browser.js";
import { dropFile, waitForPlan } from "../test/support/page-actions.js";
import { inStates, LOOKS, type Look } from "../test/support/in-states.js";
import { PAGE_STATES, sampleText } from "../test/support/page-states.js";
import { startServerProcess, temporaryFolder } from "../test/support/server-process.js";
import { ROOT, ensureBuild } from "./setup.mjs";

const [folderName, ...onlyStates] = process.argv.slice(2);
const folder = path.resolve(folderName ?? path.join(ROOT, "test", "screenshots"));
const findings: string[] = [];

async function shootAll(browser: Browser, look: Look): Promise<void> {
  const states = PAGE_STATES.filter(({ name }) => onlyStates.length === 0 || onlyStates.includes(name));
  await inStates(browser, states, look, async (page, state, scheme) => {
    const name = `${look.name}-${scheme}-${state.name}`;
    await drawn(page);
    await page.screenshot({ path: path.join(folder, `${name}.png`), timeout: 120_000 });
    const found = await seriousFindings(page);
    findings.push(...found.map((finding) => `${name}: ${finding}`));
    console.log([name, ...found].join("\n  "));
  });
}

/** Waits until the picture on the paper is current: without a graphics card a frame takes its time. */
async function drawn(page: Page): Promise<void> {
  for (let frame = 0; frame < 3; frame++) await page.evaluate(() => new Promise(requestAnimationFrame));
  await page.waitForTimeout(300);
}

async function pictureForReadme(browser: Browser): Promise<void> {
  const data = temporaryFolder("screenshots");
  const server = await startServerProcess({ dataDir: data.path });
  const page = await browser.newPage({ viewport: { width: 1240, height: 760 }, colorScheme: "light" });
  try {
    await page.goto(server.url);
    await page.getByText("Drop a drawing here").waitFor();
    await dropFile(page, "three-colour-hills.svg", sampleText("three-colour-hills"));
    await page.getByText("1 Sun").first().waitFor();
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
  if (onlyStates.length === 0) await pictureForReadme(browser);
  for (const look of LOOKS) await shootAll(browser, look);
} finally {
  await browser.close();
}
if (findings.length > 0) process.exitCode = 1;
