/**
 * `npm run screenshots [-- FOLDER [STATE…]]`: every state of the page, at four sizes of screen, light and
 * dark, as PNG files in test/screenshots/, and the README's picture in docs/. Look at them after each visible
 * change. Each state is also checked by axe; serious findings are printed, and set exit code 1.
 */
import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import type { Browser, Page } from "playwright-core";
import { seriousFindings } from "../test/support/browser/axe.js";
import { launchBrowser } from "../test/support/browser/browser.js";
import { dropFile, openPanel, waitForPlan } from "../test/support/browser/page-actions.js";
import { inStates, LOOKS, type Look } from "../test/support/browser/in-states.js";
import { PAGE_STATES } from "../test/support/browser/page-states.js";
import { sampleText } from "../test/support/browser/page-states/page-state.js";
import { temporaryFolder } from "../test/support/processes/folders.js";
import { startServerProcess } from "../test/support/processes/server-process.js";
import { ROOT, ensureBuild } from "./setup.mjs";

const DOCS_ONLY = process.argv.includes("--docs");
const [folderName, ...onlyStates] = process.argv.slice(2).filter((argument) => argument !== "--docs");
const folder = path.resolve(folderName ?? path.join(ROOT, "test", "screenshots"));
const findings: string[] = [];

async function shootAll(browser: Browser, look: Look): Promise<void> {
  const states = DOCS_ONLY
    ? []
    : PAGE_STATES.filter(({ name }) => onlyStates.length === 0 || onlyStates.includes(name));
  await inStates(browser, states, look, async (page, state, scheme) => {
    const name = `${look.name}-${scheme}-${state.name}`;
    await drawn(page);
    await page.screenshot({ path: path.join(folder, `${name}.png`), timeout: 120_000 });
    const found = await seriousFindings(page);
    findings.push(...found.map((finding) => `${name}: ${finding}`));
    console.log([name, ...found].join("\n  "));
  });
}

/** Waits until the canvas shows the current drawing: without a graphics card a frame is slow. */
async function drawn(page: Page): Promise<void> {
  for (let frame = 0; frame < 3; frame++) await page.evaluate(() => new Promise(requestAnimationFrame));
  await page.waitForTimeout(300);
}

/** The pictures of README and documents, in docs/screenshots/, as WebP: a third of the size of PNG. `--docs`: only these. */
async function pictureForReadme(browser: Browser): Promise<void> {
  const data = temporaryFolder("screenshots");
  const server = await startServerProcess({ dataDir: data.path, virtualSpeed: 4 });
  const look = { reducedMotion: "reduce", colorScheme: "light" } as const;
  const desk = await browser.newPage({ ...look, viewport: { width: 1240, height: 760 } });
  try {
    await desk.goto(server.url);
    await desk.getByText("Drop a drawing here").waitFor();
    await dropFile(desk, "three-colour-hills.svg", sampleText("three-colour-hills"));
    await openPanel(desk, "Layers");
    await desk.getByText("1 Sun").first().waitFor();
    await waitForPlan(desk);
    await savePicture(desk, "prepare");
    await dropFile(desk, "moonrise.svg", sampleText("moonrise"));
    await desk.getByText("moonrise").first().waitFor();
    await waitForPlan(desk);
    await desk
      .getByRole("region", { name: "Plot", exact: true })
      .getByRole("button", { name: "Plot", exact: true })
      .click();
    // Watch opens by itself. By then enough is drawn for a picture.
    await desk.waitForTimeout(90_000);
    await savePicture(desk, "watch");
    const phone = await browser.newPage({ ...look, viewport: { width: 390, height: 844 }, hasTouch: true });
    await phone.goto(server.url);
    await phone.getByText("moonrise").first().waitFor();
    await savePicture(phone, "phone");
    await phone.close();
  } finally {
    await desk.close();
    await server.stop();
    data.remove();
  }
}

async function savePicture(page: Page, name: string): Promise<void> {
  // Without a graphics card a frame may take seconds.
  await page.waitForTimeout(10_000);
  const session = await page.context().newCDPSession(page);
  const { data } = await session.send("Page.captureScreenshot", { format: "webp", quality: 85 });
  const file = path.join(ROOT, "docs", "screenshots", `${name}.webp`);
  mkdirSync(path.dirname(file), { recursive: true });
  writeFileSync(file, Buffer.from(data, "base64"));
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
