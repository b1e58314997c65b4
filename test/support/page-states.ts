/** Every visible state of the page, and how a user gets there: for screenshots and accessibility checks. */
import { readFileSync } from "node:fs";
import path from "node:path";
import type { Page } from "playwright-core";
import { ROOT } from "../../scripts/setup.mjs";
import { machineById } from "../../src/index.js";
import { ruledSheet } from "./drawings.js";
import {
  dropFile,
  historyPanel,
  openTab,
  openView,
  plotBar,
  queuePanel,
  statusCard,
  waitForPlan,
  waitForSamples,
} from "./page-actions.js";
import type { ServerProcess } from "./server-process.js";

interface Stand {
  readonly page: Page;
  readonly server: ServerProcess;
  /** A new server in place of one that ended. */
  restart(): Promise<void>;
  /** The page in another browser, which the server tells apart from this one. */
  openOther(path?: string): Promise<Page>;
}

export interface PageState {
  readonly name: string;
  readonly virtualSpeed?: number;
  /** Instead of the virtual board. */
  readonly device?: string;
  /** The server lets in only devices that are paired. */
  readonly isPairing?: true;
  /** Leaves nothing behind once a sheet that it opened is closed. */
  readonly isPassing?: true;
  /** Begins with an empty paper; other states begin with a sample on it. */
  readonly isFirstVisit?: true;
  /** Shows a part of the page that no passing state shows: part of every test run, not only of the full one. */
  readonly isOnlyPlace?: true;
  reach(stand: Stand): Promise<void>;
}

export const sampleText = (name: string): string =>
  readFileSync(path.join(ROOT, "samples", `${name}.svg`), "utf8");

const WITH_WARNINGS = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="120mm" viewBox="0 0 200 120">
  <image href="photo.png" x="100" y="20" width="60" height="60"/>
  <path filter="url(#blur)" d="M20 100h150" stroke="#000"/>
  <circle cx="60" cy="60" r="40" fill="none" stroke="#c00"/></svg>`;

const TWO_PENS = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="200mm" height="120mm" viewBox="0 0 200 120"><g fill="none">
  <g inkscape:groupmode="layer" inkscape:label="Outline" stroke="#222"><path d="M20 20h20v20h-20z"/></g>
  <g inkscape:groupmode="layer" inkscape:label="!Red circle" stroke="#c8102e"><circle cx="90" cy="60" r="30"/></g>
  </g></svg>`;

const STEPS = `<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="120mm" viewBox="0 0 120 120"><path d="M10 10v25h25v25h25v25h25" fill="none" stroke="#000"/></svg>`;

const TALL = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="200mm" viewBox="0 0 100 200"><path d="M0 0L100 200M100 0L0 200" fill="none" stroke="#000"/></svg>`;

/** Enough strokes that the planning is visible. */
function manyStrokes(): string {
  const lines = Array.from({ length: 60_000 }, (_, i) => `M${(i * 7919) % 290} ${(i * 104_729) % 205}l3 2`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210"><path fill="none" stroke="#000" d="${lines.join("")}"/></svg>`;
}

/**
 * From now on the page keeps its planning message, which could otherwise disappear before the test sees it.
 * No function in it may have a name: the script runner would add a helper call that the page does not have.
 */
const notePlanning = (page: Page): Promise<void> =>
  plotBar(page).evaluate((bar) => {
    const planning = new Promise<void>((resolve) => {
      new MutationObserver(() => {
        if (bar.textContent?.includes("Planning…")) resolve();
      }).observe(bar, { subtree: true, childList: true, characterData: true });
    });
    (window as unknown as { planning: Promise<void> }).planning = planning;
  });

async function lay(page: Page, name: string, text: string): Promise<void> {
  await openTab(page, "Set up");
  await dropFile(page, `${name}.svg`, text);
  await page.getByText(name).first().waitFor();
  await waitForPlan(page);
}

async function inPrepare(page: Page): Promise<Page> {
  await openView(page, "Prepare");
  return page;
}

/** The links that the server printed: for an operator, and for a watcher. */
async function pairingPaths(server: ServerProcess): Promise<readonly string[]> {
  for (;;) {
    const paths = server.output().match(/\/pair\?token=[\w-]+/g) ?? [];
    if (paths.length >= 2) return paths;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

async function start(page: Page, name: string, text: string): Promise<void> {
  await lay(page, name, text);
  await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
  await openTab(page, "Queue");
  await queuePanel(page).getByRole("progressbar").waitFor();
}

/** A job's buttons: on the status card in Watch, otherwise in the queue, on a phone in the bar at the bottom. */
const button = (page: Page, name: string | RegExp) =>
  statusCard(page).or(queuePanel(page)).or(plotBar(page)).getByRole("button", { name });

export const PAGE_STATES: readonly PageState[] = [
  {
    name: "01-first-visit",
    isPassing: true,
    isFirstVisit: true,
    reach: ({ page }) => waitForSamples(page),
  },
  {
    name: "02-loaded",
    isPassing: true,
    reach: ({ page }) => lay(page, "hills", sampleText("three-colour-hills")),
  },
  { name: "03-report", isPassing: true, reach: ({ page }) => lay(page, "poster", WITH_WARNINGS) },
  {
    name: "04-not-a-drawing",
    reach: async ({ page }) => {
      await dropFile(page, "torn.svg", sampleText("hello-paper").slice(0, 2_000));
      await page.getByText("torn can’t be drawn").waitFor();
    },
  },
  {
    name: "05-planning",
    reach: async ({ page }) => {
      await notePlanning(page);
      await dropFile(page, "many.svg", manyStrokes());
      await page.evaluate(() => (window as unknown as { planning: Promise<void> }).planning);
    },
  },
  {
    name: "06-queued",
    reach: async ({ page }) => {
      for (const name of ["hello", "note"]) {
        await lay(page, name, sampleText("hello-paper"));
        for (let copy = 0; copy < 2; copy++) {
          await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
        }
      }
      await openTab(page, "Queue");
      await button(page, /^Start /)
        .nth(1)
        .waitFor();
    },
  },
  {
    name: "07-plotting",
    virtualSpeed: 5,
    reach: async ({ page }) => {
      await start(page, "lines", ruledSheet());
      await queuePanel(page).getByText(/left/).first().waitFor();
    },
  },
  {
    name: "08-asking-to-cancel",
    virtualSpeed: 2,
    reach: async ({ page }) => {
      await start(page, "lines", ruledSheet());
      await button(page, "Cancel").click();
      await page.getByRole("alertdialog").first().waitFor();
    },
  },
  {
    name: "09-held",
    virtualSpeed: 2,
    reach: async ({ page }) => {
      await start(page, "lines", ruledSheet());
      await button(page, "Pause").click();
      await button(page, "Resume").waitFor();
    },
  },
  {
    name: "10-waiting-for-pen",
    reach: async ({ page }) => {
      await start(page, "two-pens", TWO_PENS);
      await button(page, "Continue").waitFor();
    },
  },
  {
    name: "11-interrupted",
    virtualSpeed: 8,
    reach: async (stand) => {
      await start(stand.page, "lines", ruledSheet());
      await queuePanel(stand.page).getByText("1 %").first().waitFor();
      await stand.restart();
      await button(stand.page, "Go on from there").waitFor();
    },
  },
  {
    name: "12-done",
    reach: async ({ page }) => {
      await start(page, "few lines", ruledSheet(3));
      await historyPanel(page).getByText("Done").first().waitFor();
    },
  },
  {
    name: "13-by-hand",
    isPassing: true,
    reach: async ({ page }) => {
      await openTab(page, "Plotter");
      await page.getByRole("button", { name: "Move by hand" }).click();
      await page.getByRole("group", { name: "Jog pad" }).waitFor();
      await page.getByRole("group", { name: "Jog pad" }).scrollIntoViewIfNeeded();
    },
  },
  {
    name: "14-set-up",
    isPassing: true,
    reach: async ({ page }) => {
      await openTab(page, "Plotter");
      await page.getByRole("button", { name: "Set up a plotter…" }).click();
      await page.getByRole("button", { name: "Next" }).click();
      await page.getByRole("button", { name: "It is in the middle" }).click();
      await page.getByText("Which way did it go?").waitFor();
    },
  },
  {
    name: "15-machines",
    isPassing: true,
    reach: async ({ page }) => {
      await openTab(page, "Plotter");
      await page.getByRole("button", { name: "Machines…" }).click();
      await page.getByRole("button", { name: "Copy AxiDraw V3 to a new machine", exact: true }).click();
      await page.getByText("Pen servo").waitFor();
    },
  },
  {
    name: "16-console",
    isPassing: true,
    reach: async ({ page }) => {
      await openTab(page, "Plotter");
      await page.getByRole("button", { name: "Console" }).click();
      await page.getByLabel("Command", { exact: true }).fill("V");
      await page.getByRole("button", { name: "Send" }).click();
      await page.getByText(/EBBv/).waitFor();
    },
  },
  ...(["Share", "Access", "Plotters", "Servers", "Webhooks", "Camera"] as const).map((section, index) => ({
    name: `${17 + index}-studio-${section.toLowerCase()}`,
    isPassing: true as const,
    reach: async ({ page }: Stand): Promise<void> => {
      await page.getByRole("button", { name: "Sharing, plotters, camera" }).click();
      await page.getByRole("radio", { name: section }).check();
      await page.waitForLoadState("networkidle").catch(() => undefined);
    },
  })),
  {
    name: "23-no-board",
    device: "/dev/no-such-plotter",
    reach: async ({ page }) => {
      await openTab(page, "Plotter");
      await page.getByText("Not connected").first().waitFor();
    },
  },
  {
    name: "24-server-gone",
    reach: async ({ page, server }) => {
      await server.stop();
      await page.getByText("server can’t be reached").first().waitFor();
    },
  },
  {
    name: "25-pairing",
    isPairing: true,
    isFirstVisit: true,
    isOnlyPlace: true,
    reach: ({ page }) => page.getByRole("heading", { name: "Pair this device" }).waitFor(),
  },
  {
    name: "26-monitor",
    isPairing: true,
    isFirstVisit: true,
    isOnlyPlace: true,
    virtualSpeed: 2,
    reach: async (stand) => {
      const [operatePath, watchPath] = await pairingPaths(stand.server);
      const operator = await stand.openOther(operatePath);
      await operator.waitForURL(`${stand.server.url}/`);
      await lay(operator, "hills", sampleText("three-colour-hills"));
      await plotBar(operator).getByRole("button", { name: "Add to queue" }).click();
      await start(operator, "two-pens", TWO_PENS);
      await stand.page.goto(`${stand.server.url}${watchPath}`);
      await queuePanel(stand.page).getByText("hills").waitFor();
    },
  },
  {
    name: "27-full-screen",
    isOnlyPlace: true,
    virtualSpeed: 2,
    reach: async ({ page }) => {
      await start(page, "lines", ruledSheet());
      await page.getByRole("button", { name: "Full screen" }).click();
      await page.getByRole("button", { name: "Exit full screen" }).waitFor();
    },
  },
  {
    name: "28-first-plot",
    isPassing: true,
    reach: async ({ page }) => {
      await openTab(page, "Plotter");
      await page.getByText("First plot with this plotter").scrollIntoViewIfNeeded();
    },
  },
  {
    name: "29-stroke",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "lines", ruledSheet());
      await page.locator(".stage:visible").click();
      await page.getByRole("region", { name: "Selected stroke" }).waitFor();
    },
  },
  {
    name: "30-queue-menu",
    isOnlyPlace: true,
    reach: async ({ page }) => {
      for (const name of ["hello", "a long name of a drawing, with its date"]) {
        await lay(page, name, sampleText("hello-paper"));
        await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
      }
      await openTab(page, "Queue");
      await queuePanel(page).getByRole("button", { name: "More for hello" }).click();
      await page.getByRole("button", { name: "Open hello" }).waitFor();
    },
  },
  {
    name: "31-other-operates",
    virtualSpeed: 2,
    reach: async ({ page, openOther }) => {
      await start(await openOther(), "lines", ruledSheet());
      await queuePanel(page).getByText("lines").waitFor({ state: "attached" });
      await page.getByText("is operating.").waitFor();
    },
  },
  {
    name: "32-take-over",
    isOnlyPlace: true,
    reach: async ({ page, openOther }) => {
      const other = await openOther();
      await openTab(other, "Queue");
      await queuePanel(other).getByRole("radio", { name: "Start the next" }).click();
      await page.getByText("is operating.").waitFor();
      await openTab(page, "Queue");
      await queuePanel(page).getByRole("radio", { name: "Wait for paper" }).click();
      await page.getByRole("dialog", { name: "Another page is operating" }).waitFor();
    },
  },
  {
    name: "33-out-of-reach",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "tall", TALL);
      await page.getByRole("radio", { name: "Portrait" }).check();
      await page.getByRole("button", { name: "Turn for this machine" }).waitFor();
    },
  },
  {
    name: "34-server-gone-while-plotting",
    virtualSpeed: 2,
    reach: async ({ page, server }) => {
      await start(page, "lines", ruledSheet());
      await statusCard(page).getByText("left").first().waitFor();
      await server.stop();
      await page.getByText("last seen").first().waitFor();
    },
  },
  {
    name: "35-stopped",
    virtualSpeed: 8,
    reach: async ({ page }) => {
      await start(page, "lines", ruledSheet());
      await statusCard(page).getByText("1 %").waitFor();
      await button(page, "Emergency stop").click();
      await statusCard(page).getByText("Plotting", { exact: true }).waitFor({ state: "detached" });
    },
  },
  {
    name: "36-prepare-while-plotting",
    virtualSpeed: 2,
    reach: async ({ page }) => {
      await start(page, "two-pens", TWO_PENS);
      await lay(await inPrepare(page), "hills", sampleText("three-colour-hills"));
    },
  },
  {
    name: "37-all-settings",
    isPassing: true,
    reach: async ({ page }) => {
      await openTab(page, "Set up");
      const folded = page.locator(".column-setup button[aria-expanded=false]:visible");
      // On a phone the sheet may cover the button.
      while ((await folded.count()) > 0) await folded.first().dispatchEvent("click");
      await page.locator("#group-motion summary").dispatchEvent("click");
      await page.getByLabel("Speed along x", { exact: true }).waitFor();
    },
  },
  {
    name: "38-ringing",
    isPassing: true,
    reach: async ({ page }) => {
      await openTab(page, "Plotter");
      const link = page
        .getByRole("region", { name: "Plotter set-up" })
        .getByRole("button", { name: "Measure ringing…" });
      // On a phone the plot's bar lies over the end of a long panel.
      await link.evaluate((element) => element.scrollIntoView({ block: "center" }));
      await link.click();
      const dialog = page.getByRole("dialog", { name: "Measure ringing" });
      await dialog.getByLabel("Ripples in 10 mm, x").fill("5");
      await dialog.getByLabel("Ripples in 10 mm, y").fill("8");
      await dialog.getByRole("row", { name: /^Fast/ }).waitFor();
    },
  },
  {
    name: "39-ringing-pick",
    reach: async ({ page, server }) => {
      const springs = { xHz: 15, yHz: 25, damping: 0.05 };
      const measured = { ...machineById("axidraw-v3"), id: "measured", name: "Measured plotter", springs };
      await page.request.put(`${server.url}/api/v1/machines/measured`, { data: measured });
      await page.reload();
      await waitForPlan(page);
      await openTab(page, "Plotter");
      await page.getByRole("button", { name: "Machines…" }).click();
      await page
        .getByRole("dialog")
        .getByRole("button", { name: /^Measured plotter/ })
        .click();
      await page.keyboard.press("Escape");
      await page.getByRole("button", { name: "Measure ringing…" }).last().click();
      const dialog = page.getByRole("dialog", { name: "Measure ringing" });
      await dialog.getByRole("radio", { name: "Pick by eye" }).check();
      await dialog.getByRole("radio", { name: "15 / 25 Hz" }).waitFor();
    },
  },
  {
    name: "40-simulated-pen",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "steps", STEPS);
      const menu = page.getByRole("combobox", { name: "Colour by" });
      if (await menu.isVisible()) await menu.selectOption("Pen (simulated)");
      else await page.getByRole("radio", { name: "Pen (simulated)" }).check();
      await page.locator("[data-max-mm]").waitFor();
    },
  },
];
