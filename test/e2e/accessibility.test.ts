/** The page under axe's rules (WCAG 2.2 A and AA), in each state that looks different, light and dark, desk and phone. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { seriousFindings } from "../support/axe.js";
import { launchBrowser } from "../support/browser.js";
import { dropFile, plotBar, queuePanel, waitForPlan } from "../support/page-actions.js";
import { PAGE_STATES, inState, type Look } from "../support/page-states.js";
import { startServerProcess, temporaryFolder, type ServerProcess } from "../support/server-process.js";

const data = temporaryFolder("accessibility");
let browser: Browser;
let server: ServerProcess;

beforeAll(async () => {
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path, virtualSpeed: 1 });
});

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

async function openPage(width: number, height: number, colorScheme: "light" | "dark"): Promise<Page> {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme });
  const page = await context.newPage();
  await page.goto(server.url);
  await waitForPlan(page);
  return page;
}

/** Opens every folded group of settings, so that what is in it is looked at too. */
async function unfold(page: Page): Promise<void> {
  const folded = page.locator("button[aria-expanded=false]:visible");
  while ((await folded.count()) > 0) await folded.first().click();
}

describe("someone without a mouse", () => {
  it("reaches every control by Tab, and each says what it is", async () => {
    const page = await openPage(1440, 900, "light");
    const names = new Set<string>();
    for (let press = 0; press < 120; press++) {
      await page.keyboard.press("Tab");
      const name = await page.evaluate(() => {
        const element = document.activeElement;
        if (element === null || element === document.body) return null;
        const labels = (element as HTMLInputElement).labels;
        return (
          element.getAttribute("aria-label") ??
          (labels?.[0]?.textContent || null) ??
          element.textContent ??
          ""
        ).trim();
      });
      if (name === null) break;
      names.add(name);
    }
    expect([...names]).not.toContain("");
    for (const button of ["Plot", "Add to queue", "Pen up", "Zoom in"]) expect([...names]).toContain(button);
    await page.context().close();
  });
});

describe("axe finds nothing serious", () => {
  it.each([
    [1440, 900, "light"],
    [1440, 900, "dark"],
    [390, 844, "light"],
    [390, 844, "dark"],
  ] as const)("on the first visit at %i × %i, %s", async (width, height, scheme) => {
    const page = await openPage(width, height, scheme);
    await unfold(page);
    expect(await seriousFindings(page)).toEqual([]);
    await page.context().close();
  });

  it("with a file that can't be read, a queue, a plot under way, and the question before cancelling", async () => {
    const page = await openPage(1440, 900, "light");
    await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
    await queuePanel(page)
      .getByRole("button", { name: /^Start / })
      .click();
    await queuePanel(page).getByRole("progressbar").waitFor();
    await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
    await dropFile(page, "torn.svg", "<svg><path");
    await page.getByText(/torn/).first().waitFor();
    expect(await seriousFindings(page)).toEqual([]);
    await queuePanel(page).getByRole("button", { name: "Cancel" }).click();
    expect(await seriousFindings(page)).toEqual([]);
    await page.context().close();
  });
});

/** Those that look like no other; `npm run screenshots` puts all of them before axe. */
const CHECKED = [
  "03-report",
  "10-waiting-for-pen",
  "11-interrupted",
  "13-by-hand",
  "14-set-up",
  "15-machines",
  "17-studio-share",
  "19-studio-plotters",
  "23-server-gone",
];

describe("axe finds nothing serious on a phone", () => {
  const look: Look = { name: "phone", width: 390, height: 844, colorScheme: "light" };
  const checked = PAGE_STATES.filter(({ name }) => CHECKED.includes(name));
  it.each(checked.map((state) => [state.name, state] as const))("%s", async (_name, state) => {
    await inState(browser, state, look, async (page) => {
      expect(await seriousFindings(page)).toEqual([]);
      const widthPx = await page.evaluate(() => document.documentElement.scrollWidth);
      expect(widthPx).toBeLessThanOrEqual(look.width);
    });
  });
});
