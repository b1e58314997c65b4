/** A user's actions on the page, shared by the browser tests and the screenshots. */
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
/** In Watch: how far the plot is, and its buttons. */
export const statusCard = (page: Page): Locator => page.getByRole("region", { name: "Plot under way" });
/** The newest finished plots. */
export const historyPanel = (page: Page): Locator => page.getByRole("region", { name: "Gallery" });

/** Watch opens by itself when a plot starts. */
export const openView = (page: Page, name: "Prepare" | "Watch"): Promise<void> =>
  page.getByRole("group", { name: "View" }).getByRole("button", { name, exact: true }).click();

type Panel = "Drawing" | "Paper" | "Layers" | "Lines" | "Speed" | "Plotter" | "Queue";

/** Opens one of the panels beside the sheet. */
export async function openPanel(page: Page, name: Panel): Promise<void> {
  // With the number of waiting plots behind it.
  const button = page
    .getByRole("navigation", { name: "Panels" })
    .getByRole("button", { name: new RegExp(`^${name}( ?\\d+)?$`) });
  if ((await button.getAttribute("aria-expanded")) !== "true") await button.click();
  // Its content is loaded when it is first opened.
  await page.locator(".panel").locator(".card, .group").first().waitFor();
}

/** Opens or closes a group of settings, in the panel that has it. */
export async function openGroup(page: Page, panel: Panel, title: string, isOpen = true): Promise<void> {
  await openPanel(page, panel);
  const head = page.locator(".group-head").filter({ has: page.getByText(title, { exact: true }) });
  if ((await head.getAttribute("aria-expanded")) !== String(isOpen)) await head.click();
}

/** Waits until the page has rendered all earlier changes, including those of the next frame. */
export const nextFrames = (page: Page): Promise<void> =>
  page.evaluate(
    () => new Promise<void>((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve()))),
  );

/** Waits until the preview shows the latest settings and plan. */
export async function waitForPicture(page: Page): Promise<void> {
  await nextFrames(page);
  await page.locator(".stage canvas[aria-busy=false]:visible").waitFor();
  await nextFrames(page);
}

/** Waits until the drawing on the paper is planned: the figures are there, and no plan is running. */
export async function waitForPlan(page: Page): Promise<void> {
  await plotBar(page).getByText("Strokes").waitFor({ state: "attached" });
  await plotBar(page).getByText("Time", { exact: true }).waitFor({ state: "attached" });
}

/** Waits until Plot can be pressed. After a load the server may answer later than the plan is there. */
export const waitForPlotButton = (page: Page): Promise<void> =>
  plotBar(page).getByRole("button", { name: "Plot", exact: true, disabled: false }).waitFor();

/** Waits until the empty sheet of a first visit offers the samples, with the pictures of those in view. */
export async function waitForSamples(page: Page): Promise<void> {
  await page.locator(".sample").nth(5).waitFor({ state: "attached" });
  await page.locator(".sample img").first().waitFor();
}

/** How a first visit begins: one click on a sample, by default the one that is planned fastest. Waits for its plan. */
export async function chooseSample(page: Page, name = "Whirling triangles"): Promise<void> {
  await page.getByRole("button", { name }).click();
  await waitForPlan(page);
}

/**
 * Number of pixels of each colour (0xrrggbb) that the screen shows at an element or in a box, decoded by the
 * browser itself.
 */
export async function colorCounts(
  ...[target, clip]: [Locator] | [Page, { x: number; y: number; width: number; height: number }]
): Promise<Map<number, number>> {
  const png = (await (clip ? target.screenshot({ clip }) : target.screenshot())).toString("base64");
  const context = "context" in target ? target.context() : target.page().context();
  const blank = await context.newPage();
  try {
    const entries = await blank.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext("2d");
      if (context === null) throw new Error("no 2d context");
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      const counts = new Map<number, number>();
      for (let i = 0; i < data.length; i += 4) {
        const color = ((data[i] ?? 0) << 16) | ((data[i + 1] ?? 0) << 8) | (data[i + 2] ?? 0);
        counts.set(color, (counts.get(color) ?? 0) + 1);
      }
      return [...counts];
    }, png);
    return new Map(entries);
  } finally {
    await blank.close();
  }
}
