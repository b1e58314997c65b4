/** The server, other browsers on it, and the sheets about them. */
import { ruledSheet } from "../../drawings/drawings.js";
import { openPanel, plotBar, queuePanel, statusCard } from "../page-actions.js";
import type { ServerProcess } from "../../processes/server-process.js";
import { type PageState, type Stand, lay, sampleText, start, TWO_PENS } from "./page-state.js";

/** The links that the server printed: for an operator, and for a watcher. */
async function pairingPaths(server: ServerProcess): Promise<readonly string[]> {
  for (;;) {
    const paths = server.output().match(/\/pair\?token=[\w-]+/g) ?? [];
    if (paths.length >= 2) return paths;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

export const SHARING_STATES: readonly PageState[] = [
  ...(["Share", "Access", "Plotters", "Servers", "Webhooks", "Camera"] as const).map((section, index) => ({
    name: `${17 + index}-sharing-${section.toLowerCase()}`,
    isPassing: true as const,
    reach: async ({ page }: Stand): Promise<void> => {
      await page.getByRole("button", { name: "Sharing, plotters, camera" }).click();
      await page.getByRole("radio", { name: section }).check();
      await page.waitForLoadState("networkidle").catch(() => undefined);
    },
  })),
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
      await statusCard(stand.page).getByRole("progressbar").waitFor();
      await openPanel(stand.page, "Queue");
      await queuePanel(stand.page).getByText("hills").waitFor();
    },
  },
  {
    name: "31-other-operates",
    virtualSpeed: 2,
    reach: async ({ page, openOther }) => {
      await start(await openOther(), "lines", ruledSheet());
      await openPanel(page, "Queue");
      await queuePanel(page).getByText("lines").waitFor();
      await page.getByText("is operating.").waitFor();
    },
  },
  {
    name: "32-take-over",
    isOnlyPlace: true,
    reach: async ({ page, openOther }) => {
      const other = await openOther();
      await openPanel(other, "Queue");
      await queuePanel(other).getByRole("radio", { name: "Start the next" }).click();
      await page.getByText("is operating.").waitFor();
      await openPanel(page, "Queue");
      // A click on the chosen option changes nothing, so it opens no dialog.
      await queuePanel(page)
        .getByRole("radio", { name: "Start the next", checked: true })
        .waitFor({ state: "attached" });
      await queuePanel(page).getByRole("radio", { name: "Wait for paper" }).click();
      await page.getByRole("dialog", { name: "Another page is operating" }).waitFor();
    },
  },
  {
    name: "41-about",
    isPassing: true,
    reach: async ({ page }) => {
      await page.getByRole("button", { name: "Keyboard shortcuts" }).click();
      await page.getByRole("button", { name: "About plotwright" }).click();
      await page.getByRole("dialog", { name: "About plotwright" }).getByText("zustand").waitFor();
    },
  },
  {
    name: "42-connecting",
    reach: async ({ page }) => {
      // Never answered, so that it stays so.
      await page.route("**/api/v1/events", () => undefined);
      await page.reload();
      await plotBar(page).getByText("Connecting to plotwright…").waitFor();
    },
  },
];
