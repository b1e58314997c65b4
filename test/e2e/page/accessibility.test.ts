/**
 * The page under axe's rules (WCAG 2.2 A and AA), in each state that looks different, light and dark, on
 * desktop and phone.
 */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { overlaps, seriousFindings } from "../../support/browser/axe.js";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import {
  chooseSample,
  dropFile,
  openPanel,
  openView,
  plotBar,
  queuePanel,
  statusCard,
  waitForPlan,
  waitForPlotButton,
  waitForSamples,
} from "../../support/browser/page-actions.js";
import {
  DESK,
  FONTS,
  inStates,
  LOOKS,
  PHONE,
  planned,
  SCHEMES,
  SHIPPED_FONT,
  useFont,
  type Font,
  type Look,
  type Scheme,
} from "../../support/browser/in-states.js";
import { PAGE_STATES } from "../../support/browser/page-states.js";
import type { PageState } from "../../support/browser/page-states/page-state.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";
import { IS_FULL } from "../../support/runs/full-run.js";

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

async function firstVisit({ width, height }: Look = DESK, font: Font = SHIPPED_FONT): Promise<Page> {
  const context = await browser.newContext({
    viewport: { width, height },
    hasTouch: width < 760,
    ...PLAIN,
  });
  await useFont(context, font);
  const page = await context.newPage();
  await page.goto(server.url);
  await waitForSamples(page);
  return page;
}

async function openPage(look: Look = DESK, font: Font = SHIPPED_FONT): Promise<Page> {
  const page = await firstVisit(look, font);
  await chooseSample(page);
  return page;
}

/** Opens every collapsed group of the open panel, so that its content is checked too. */
async function unfold(page: Page): Promise<void> {
  const folded = page.locator(".panel button[aria-expanded=false]");
  while ((await folded.count()) > 0) await folded.first().click();
}

describe("someone without a mouse", () => {
  it("reaches every control by Tab, and each has a name", async () => {
    const page = await openPage();
    // From the top, not from where the sample was clicked.
    await page.reload();
    await waitForPlan(page);
    await waitForPlotButton(page);
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

describe("the About sheet", () => {
  it("is opened from the list of shortcuts, and shows the licences of the bundled parts", async () => {
    const page = await openPage();
    await page.keyboard.press("?");
    await page.getByRole("button", { name: "About plotwright" }).click();
    const sheet = page.getByRole("dialog", { name: "About plotwright" });
    await expect.poll(() => sheet.textContent()).toMatch(/zustand [\d.]+ \(MIT\)/);
    expect(await sheet.textContent()).toMatch(/Hershey fonts.*css-tree/s);
    expect(await seriousFindings(page)).toEqual([]);
    await page.context().close();
  });
});

/** The full run has the phone here too; `npm test` has it below, in light colours. */
const FIRST_LOOKS = IS_FULL ? [DESK, PHONE] : [DESK];
/** Dark as well in `npm test`: only the state with the most controls. */
const FULL_SCHEMES: readonly Scheme[] = IS_FULL ? SCHEMES : ["light"];

describe("axe finds nothing serious, light and dark", () => {
  it.each(FIRST_LOOKS)("axe finds nothing serious on the first visit, $name", async (look) => {
    const page = await firstVisit(look);
    for (const colorScheme of FULL_SCHEMES) {
      await page.emulateMedia({ colorScheme });
      expect(await seriousFindings(page)).toEqual([]);
    }
    await page.context().close();
  });

  describe.each(FONTS)("in $name", (font) => {
    it.each(FIRST_LOOKS)(
      "axe finds nothing serious with a sample on the paper and every group of settings open, $name",
      async (look) => {
        const page = await openPage(look, font);
        for (const panel of ["Drawing", "Paper", "Layers", "Lines", "Speed", "Plotter", "Queue"] as const) {
          await openPanel(page, panel);
          await unfold(page);
          for (const colorScheme of SCHEMES) {
            await page.emulateMedia({ colorScheme });
            expect(await seriousFindings(page)).toEqual([]);
          }
        }
        await page.context().close();
      },
    );
  });

  it("axe finds nothing serious with a file that cannot be read, a queue, a running plot, and the question before cancelling", async () => {
    const page = await openPage();
    await openPanel(page, "Queue");
    await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
    await queuePanel(page)
      .getByRole("button", { name: /^Start / })
      .click();
    await statusCard(page).getByRole("progressbar").waitFor();
    await queuePanel(page).getByRole("progressbar").waitFor();
    await statusCard(page).getByText("done", { exact: false }).first().waitFor();
    expect(await seriousFindings(page)).toEqual([]);
    await openView(page, "Prepare");
    await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
    await dropFile(page, "torn.svg", "<svg><path");
    await page.getByText(/torn/).first().waitFor();
    await planned(page);
    expect(await seriousFindings(page)).toEqual([]);
    await queuePanel(page).getByRole("button", { name: "Cancel" }).click();
    for (const colorScheme of FULL_SCHEMES) {
      await page.emulateMedia({ colorScheme });
      expect(await seriousFindings(page)).toEqual([]);
    }
    await page.context().close();
  });
});

// Every panel once, on a phone, which shows one at a time; the full run has all states at all sizes, dark too.
const LOOKED_AT = IS_FULL ? LOOKS : [PHONE];
const STATES = PAGE_STATES.filter(({ isPassing, isOnlyPlace }) => IS_FULL || isPassing || isOnlyPlace);
const LASTING = STATES.filter(({ isPassing }) => !isPassing);
const GROUPS: readonly (readonly [string, readonly PageState[]])[] = [
  ["states that leave nothing behind", STATES.filter(({ isPassing }) => isPassing)],
  ...LASTING.map((state) => [state.name, [state]] as const),
];

/** The other fonts only in the full run, on a desk. */
const LOOKS_IN_FONTS = LOOKED_AT.flatMap((look) =>
  (look === DESK ? FONTS : [SHIPPED_FONT]).map((font) => ({
    look,
    font,
    size: `${look.width} × ${look.height}`,
    fontName: font.name,
  })),
);

describe.each(LOOKS_IN_FONTS)(
  "axe finds nothing serious at $size in $fontName, and nothing overflows or lies over something else",
  ({ look, font }) => {
    it.each(GROUPS)("%s", { timeout: 240_000 }, async (_name, group) => {
      const found: string[] = [];
      let lookedAt = 0;
      const check = async (page: Page, { name }: PageState, scheme: Scheme): Promise<void> => {
        lookedAt++;
        const findings = await seriousFindings(page);
        found.push(...findings.map((finding) => `${name}, ${scheme}: ${finding}`));
        const wide = await page.evaluate(() =>
          [...document.querySelectorAll(".panel, .group-body, .card, .watch > *, dialog")]
            .filter(({ scrollWidth, clientWidth }) => scrollWidth > clientWidth + 1)
            .map(({ className }) => className),
        );
        if (wide.length > 0) found.push(`${name}: content is cut off in ${wide.join(", ")}`);
        found.push(...(await overlaps(page)).map((pair) => `${name}: ${pair}`));
        const { scrollWidth, scrollHeight } = await page.evaluate(() => ({
          scrollWidth: document.documentElement.scrollWidth,
          scrollHeight: document.documentElement.scrollHeight,
        }));
        if (scrollWidth > look.width) found.push(`${name}: ${scrollWidth} px wide`);
        if (look !== PHONE && scrollHeight > look.height) found.push(`${name}: ${scrollHeight} px high`);
      };
      await inStates(browser, group, look, check, FULL_SCHEMES, font);
      expect(found).toEqual([]);
      expect(lookedAt).toBe(FULL_SCHEMES.length * group.length);
    });
  },
);
