/** A drawing on the paper, and what is set for it. */
import type { Page } from "playwright-core";
import { ruledSheet } from "../../drawings/drawings.js";
import { dropFile, openGroup, openPanel, plotBar, waitForPicture, waitForSamples } from "../page-actions.js";
import { type PageState, lay, sampleText } from "./page-state.js";

const WITH_WARNINGS = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="120mm" viewBox="0 0 200 120">
  <image href="photo.png" x="100" y="20" width="60" height="60"/>
  <path filter="url(#blur)" d="M20 100h150" stroke="#000"/>
  <circle cx="60" cy="60" r="40" fill="none" stroke="#c00"/></svg>`;

const STEPS = `<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="120mm" viewBox="0 0 120 120"><path d="M10 10v25h25v25h25v25h25" fill="none" stroke="#000"/></svg>`;

const WIDE = `<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210"><path d="M10 20H310M50 50H100" fill="none" stroke="#000"/></svg>`;

const FILLED = `<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="120mm" viewBox="0 0 120 120"><path d="M10 10h60v60h-60z" fill="#c00"/><circle cx="70" cy="70" r="30" fill="#00c"/></svg>`;

const TALL = `<svg xmlns="http://www.w3.org/2000/svg" width="140mm" height="280mm" viewBox="0 0 100 200"><path d="M0 0L100 200M100 0L0 200" fill="none" stroke="#000"/></svg>`;

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

export const DRAWING_STATES: readonly PageState[] = [
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
    name: "29-stroke",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "lines", ruledSheet());
      await page.locator(".stage:visible").click();
      await page.getByRole("region", { name: "Selected stroke" }).waitFor();
    },
  },
  {
    name: "33-out-of-reach",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "tall", TALL);
      await openPanel(page, "Paper");
      await page.getByRole("radio", { name: "Portrait" }).check();
      await page.getByRole("button", { name: "Turn for this machine" }).waitFor();
    },
  },
  {
    name: "37-all-settings",
    isPassing: true,
    reach: async ({ page }) => {
      for (const panel of ["Drawing", "Paper", "Layers", "Lines", "Speed"] as const) {
        await openPanel(page, panel);
        const folded = page.locator(".panel .group-head[aria-expanded=false]");
        while ((await folded.count()) > 0) await folded.first().click();
      }
      await page.getByLabel("Speed along x", { exact: true }).waitFor();
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
  {
    name: "43-pens",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "hills", sampleText("three-colour-hills"));
      await openGroup(page, "Layers", "Pens");
      await page.getByRole("button", { name: "A pen for each colour" }).click();
      await page.locator(".layer-stop").first().scrollIntoViewIfNeeded();
    },
  },
  {
    name: "44-placed-by-hand",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "steps", STEPS);
      const place = page.getByRole("button", { name: "Place the drawing by hand" });
      if ((await place.getAttribute("aria-pressed")) === "false") await place.click();
    },
  },
  {
    name: "48-off-the-paper",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "wide", WIDE);
      await page.getByRole("group", { name: "Drawing off the paper" }).waitFor();
    },
  },
  {
    name: "49-filled-shapes",
    isPassing: true,
    reach: async ({ page }) => {
      await openPanel(page, "Drawing");
      await lay(page, "filled", FILLED);
      await page.getByRole("group", { name: "Filled shapes" }).waitFor();
    },
  },
  {
    name: "50-several-drawings",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "steps", STEPS);
      await openPanel(page, "Drawing");
      const grid = page.getByRole("button", { name: "Copies in a grid" });
      if ((await grid.getAttribute("aria-expanded")) === "false") await grid.click();
      await page.getByRole("button", { name: /^Make 2 × 3/ }).click();
      const list = page.getByRole("list", { name: "Drawings on the sheet" });
      await list.getByRole("listitem").nth(5).waitFor();
      // One is selected: its place and size are fields.
      for (const box of (await list.getByRole("checkbox").all()).slice(1)) await box.uncheck();
      await page.getByLabel("From the left", { exact: true }).waitFor();
    },
  },
  {
    name: "51-over-several-sheets",
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, "hills", sampleText("three-colour-hills"));
      await openGroup(page, "Paper", "Over several sheets");
      for (const label of ["Sheets across", "Sheets down"]) await page.getByLabel(label).fill("2");
      await page.keyboard.press("Enter");
      await page.getByText("4 sheets, together", { exact: false }).waitFor();
    },
  },
  ...(["Speed", "Time", "Order", "Ink"] as const).map((view, index): PageState => ({
    name: `${52 + index}-view-${view.toLowerCase()}`,
    isPassing: true,
    reach: async ({ page }) => {
      await lay(page, `hills ${view}`, sampleText("three-colour-hills"));
      const menu = page.getByRole("combobox", { name: "Colour by" });
      if (await menu.isVisible()) await menu.selectOption(view);
      else await page.getByRole("radio", { name: view, exact: true }).check();
      await waitForPicture(page);
    },
  })),
];
