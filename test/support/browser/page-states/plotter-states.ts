/** The plotter: moved by hand, set up, measured, or absent. */
import { chooseMeasuredPlotter } from "../measured-plotter.js";
import { openPanel } from "../page-actions.js";
import type { PageState } from "./page-state.js";

export const PLOTTER_STATES: readonly PageState[] = [
  {
    name: "13-by-hand",
    isPassing: true,
    reach: async ({ page }) => {
      await openPanel(page, "Plotter");
      await page.getByRole("button", { name: "Move by hand" }).click();
      await page.getByRole("group", { name: "Jog pad" }).scrollIntoViewIfNeeded();
    },
  },
  {
    name: "14-set-up",
    isPassing: true,
    reach: async ({ page }) => {
      await openPanel(page, "Plotter");
      await page.getByRole("button", { name: "Set up a plotter…" }).click();
      await page.getByRole("button", { name: "Next", exact: true }).click();
      await page.getByRole("button", { name: "It is in the middle" }).click();
      await page.getByText("Which way did it go?").waitFor();
    },
  },
  {
    name: "15-machines",
    isPassing: true,
    reach: async ({ page }) => {
      await openPanel(page, "Plotter");
      await page.getByRole("button", { name: "Machines…" }).click();
      await page.getByRole("button", { name: "Copy AxiDraw V3 to a new machine", exact: true }).click();
      await page.getByText("Pen servo", { exact: true }).waitFor();
    },
  },
  {
    name: "16-console",
    isPassing: true,
    reach: async ({ page }) => {
      await openPanel(page, "Plotter");
      await page.getByRole("button", { name: "Console" }).click();
      await page.getByLabel("Command", { exact: true }).fill("V");
      await page.getByRole("button", { name: "Send" }).click();
      await page.getByText(/EBBv/).waitFor();
    },
  },
  {
    name: "23-no-board",
    device: "/dev/no-such-plotter",
    reach: async ({ page }) => {
      await openPanel(page, "Plotter");
      await page.getByText("Not connected").first().waitFor();
    },
  },
  {
    name: "28-first-plot",
    isPassing: true,
    reach: async ({ page }) => {
      await openPanel(page, "Plotter");
      await page.getByText("First plot with this plotter").scrollIntoViewIfNeeded();
    },
  },
  {
    name: "38-ringing",
    isPassing: true,
    reach: async ({ page }) => {
      await openPanel(page, "Plotter");
      const link = page
        .getByRole("region", { name: "Plotter set-up" })
        .getByRole("button", { name: "Measure ringing…" });
      // On a phone the plot's bar lies over the end of a long panel.
      await link.evaluate((element) => element.scrollIntoView({ block: "center" }));
      await link.click();
      const dialog = page.getByRole("dialog", { name: "Measure ringing" });
      for (const [axis, ripples, lengthMm] of [
        ["x", "2", "20"],
        ["y", "3", "18"],
      ]) {
        await dialog.getByLabel(`Ripples, ${axis}`).fill(ripples);
        await dialog.getByLabel(`Their length, ${axis}`).fill(lengthMm);
      }
      await dialog.getByRole("row", { name: /^Fast/ }).waitFor();
    },
  },
  {
    name: "39-ringing-pick",
    reach: async ({ page, server }) => {
      await chooseMeasuredPlotter(page, server.url);
      await page.getByRole("button", { name: "Measure ringing…" }).last().click();
      const dialog = page.getByRole("dialog", { name: "Measure ringing" });
      await dialog.getByRole("radio", { name: "Pick by eye" }).check();
      await dialog.getByRole("radio", { name: "15 / 25 Hz" }).waitFor();
    },
  },
];
