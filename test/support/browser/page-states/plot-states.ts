/** The queue, a plot under way, and plots that ended. */
import { ruledSheet } from "../../drawings/drawings.js";
import { DrawnSheet, mouseOf } from "../hand-input.js";
import { historyPanel, openPanel, openView, plotBar, queuePanel, statusCard } from "../page-actions.js";
import { type PageState, button, lay, sampleText, start, TWO_PENS } from "./page-state.js";

export const PLOT_STATES: readonly PageState[] = [
  {
    name: "06-queued",
    reach: async ({ page }) => {
      for (const name of ["hello", "note"]) {
        await lay(page, name, sampleText("hello-paper"));
        for (let copy = 0; copy < 2; copy++) {
          await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
        }
      }
      await openPanel(page, "Queue");
      await queuePanel(page).getByText("×2").nth(1).waitFor();
      await queuePanel(page).getByText("All done").waitFor();
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
    name: "30-queue-menu",
    isOnlyPlace: true,
    reach: async ({ page }) => {
      for (const name of ["hello", "a long name of a drawing, with its date"]) {
        await lay(page, name, sampleText("hello-paper"));
        await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
      }
      await openPanel(page, "Queue");
      await queuePanel(page).getByRole("button", { name: "More for hello" }).click();
      await page.getByRole("button", { name: "Open hello" }).waitFor();
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
      await openView(page, "Prepare");
      await lay(page, "hills", sampleText("three-colour-hills"));
    },
  },
  {
    name: "45-cancelled",
    virtualSpeed: 8,
    reach: async ({ page }) => {
      await start(page, "lines", ruledSheet());
      await statusCard(page).getByText("1 %").waitFor();
      await button(page, "Cancel").first().click();
      await page.getByRole("button", { name: "Cancel the plot" }).first().click();
      await button(page, /^Go on from where it was cancelled/)
        .first()
        .waitFor();
    },
  },
  {
    name: "46-gallery",
    isOnlyPlace: true,
    reach: async ({ page }) => {
      await start(page, "few lines", ruledSheet(3));
      await historyPanel(page).getByText("Done").first().waitFor();
      await page.getByRole("button", { name: "Show all finished plots" }).click();
      await page.getByRole("dialog", { name: "Gallery" }).locator(".thumb img").first().waitFor();
    },
  },
  {
    name: "48-drawing-by-hand",
    isOnlyPlace: true,
    virtualSpeed: 1,
    reach: async ({ page }) => {
      await openView(page, "Watch");
      const sheet = await DrawnSheet.open(page, mouseOf(page));
      await sheet.stroke((s) => [60 + 80 * s, 60 + 20 * Math.sin(9 * s)], 1);
      await statusCard(page)
        .getByText(/s behind/)
        .waitFor();
      await button(page, "Pause").click();
      await button(page, "Resume").waitFor();
    },
  },
  {
    name: "47-library",
    isOnlyPlace: true,
    reach: async ({ page }) => {
      await openPanel(page, "Drawing");
      await page.getByRole("button", { name: "Library", exact: true }).click();
      const library = page.getByRole("dialog", { name: "Library" });
      await library.getByRole("button", { name: /^Save “/ }).click();
      await library.locator(".thumb img").first().waitFor();
      await library.getByRole("textbox", { name: "New folder" }).fill("plants");
      await library.getByRole("button", { name: "Make" }).click();
      await library.getByText("This folder is empty.", { exact: false }).waitFor();
      await library.getByRole("button", { name: /^Save “/ }).click();
      await library.getByRole("button", { name: "Library", exact: true }).click();
      await library.getByRole("button", { name: "Open the folder plants" }).waitFor();
      await library.getByRole("button", { name: /^More for .*svg/ }).click();
      await library.getByRole("button", { name: /^Remove .*svg/ }).click();
      await library.getByRole("alertdialog").waitFor();
    },
  },
  {
    name: "56-timelapse",
    isOnlyPlace: true,
    reach: async ({ page, server }) => {
      const api = `${server.url}/api/v1`;
      const state = (await (await page.request.get(`${api}/state`)).json()) as { plotters: { id: string }[] };
      // Any picture will do.
      const camera = { url: `${server.url}/icon-192.png`, everyS: 1 };
      await page.request.put(`${api}/plotters/${state.plotters[0].id}/camera`, { data: camera });
      await start(page, "few lines", ruledSheet(3));
      await page.getByRole("region", { name: "Timelapse" }).getByRole("img").waitFor();
    },
  },
];
