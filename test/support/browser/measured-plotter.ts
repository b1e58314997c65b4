/** A plotter whose swing was measured, chosen on the page. */
import type { Page } from "playwright-core";
import { machineById } from "../../../src/index.js";
import { openPanel, waitForPlan } from "./page-actions.js";

export const SPRINGS = { xHz: 15, yHz: 25, damping: 0.05 };
const MEASURED = { ...machineById("axidraw-v3"), id: "measured", name: "Measured plotter", springs: SPRINGS };

/** Needs a drawing on the paper, and restores it afterwards. */
export async function chooseMeasuredPlotter(page: Page, serverUrl: string): Promise<void> {
  await page.request.put(`${serverUrl}/api/v1/machines/${MEASURED.id}`, { data: MEASURED });
  await page.reload();
  await waitForPlan(page);
  await openPanel(page, "Plotter");
  await page.getByRole("button", { name: "Machines…" }).click();
  await page
    .getByRole("dialog")
    .getByRole("button", { name: /^Measured plotter/ })
    .click();
  await page.keyboard.press("Escape");
}
