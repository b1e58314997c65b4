/** What a user does on the page, in words: shared by the browser tests and the screenshots. */
import type { Locator, Page } from "playwright-core";

/** Drops a file on the middle of the page, as from the desktop. */
export async function dropFile(
  page: Page,
  name: string,
  text: string,
  type = "image/svg+xml",
): Promise<void> {
  const transfer = await page.evaluateHandle(
    ([fileName, content, mime]) => {
      const data = new DataTransfer();
      data.items.add(new File([content], fileName, { type: mime }));
      return data;
    },
    [name, text, type] as const,
  );
  for (const event of ["dragenter", "dragover", "drop"]) {
    await page.dispatchEvent("body", event, { dataTransfer: transfer });
  }
}

export const plotBar = (page: Page): Locator => page.getByRole("region", { name: "Plot", exact: true });
export const queuePanel = (page: Page): Locator => page.getByRole("region", { name: "Queue" });
export const historyPanel = (page: Page): Locator => page.getByRole("region", { name: "History" });

/** Waits until the drawing on the paper is planned: the time that it will take is there, and no plan is under way. */
export async function waitForPlan(page: Page): Promise<void> {
  await plotBar(page).getByText("Strokes").waitFor();
  await plotBar(page).getByRole("status").getByText("Time", { exact: true }).waitFor();
}

export interface Pixels {
  readonly width: number;
  readonly height: number;
  /** RGBA, row by row. */
  readonly data: readonly number[];
}

/** What the screen shows at an element, decoded by the browser itself. */
export async function pixelsOf(target: Locator): Promise<Pixels> {
  const png = (await target.screenshot()).toString("base64");
  const blank = await target.page().context().newPage();
  try {
    return await blank.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext("2d");
      if (context === null) throw new Error("no 2d context");
      context.drawImage(bitmap, 0, 0);
      const { width, height, data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      return { width, height, data: [...data] };
    }, png);
  } finally {
    await blank.close();
  }
}
