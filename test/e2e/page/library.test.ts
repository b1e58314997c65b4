/** The library's dialog: drawings are saved in folders, found, opened on the paper and removed, by mouse and by keyboard. */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { seriousFindings } from "../../support/browser/axe.js";
import { launchBrowser, PLAIN } from "../../support/browser/browser.js";
import { SCHEMES } from "../../support/browser/in-states.js";
import { dropFile, openPanel, waitForPlan } from "../../support/browser/page-actions.js";
import { ruledSheet } from "../../support/drawings/drawings.js";
import { temporaryFolder } from "../../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../../support/processes/server-process.js";

const LIMIT_MS = 60_000;
const SVG = ruledSheet(5);
const POLYLINES = JSON.stringify({
  widthMm: 100,
  heightMm: 100,
  layers: [
    {
      name: "Cross",
      color: "#c8102e",
      strokes: [
        [10, 10, 90, 90],
        [90, 10, 10, 90],
      ],
    },
  ],
});

const data = temporaryFolder("library-page");
let browser: Browser;
let server: ServerProcess;
let page: Page;
const complaints: string[] = [];

beforeAll(async () => {
  browser = await launchBrowser();
  server = await startServerProcess({ dataDir: data.path });
  page = await (await browser.newContext({ ...PLAIN, viewport: { width: 1440, height: 900 } })).newPage();
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  await page.goto(server.url);
  await dropFile(page, "ruled.svg", SVG);
  await page.getByText("ruled", { exact: true }).first().waitFor({ state: "attached" });
  await waitForPlan(page);
}, LIMIT_MS);

afterAll(async () => {
  await browser.close();
  await server.stop();
  data.remove();
});

const library = () => page.getByRole("dialog", { name: "Library" });
const button = (name: string) => library().getByRole("button", { name, exact: true });
const onDisk = (...path: string[]): string => join(data.path, "library", ...path);
const fileNames = (): Promise<string[]> =>
  library().getByRole("article").locator(".job-name").allInnerTexts();
/** What has the focus. */
const focused = (): Promise<string> =>
  page.evaluate(() => {
    const element = document.activeElement;
    return element?.getAttribute("aria-label") ?? element?.textContent ?? "";
  });
const openLibrary = async (): Promise<void> => {
  await openPanel(page, "Drawing");
  await page.getByRole("button", { name: "Library", exact: true }).click();
  await library().waitFor();
};

describe("the library's dialog", () => {
  it(
    "saves the drawing that is on the paper, in a folder that it makes",
    async () => {
      await openLibrary();
      await library().getByText("This folder is empty.", { exact: false }).waitFor();
      await button("Save “ruled” here").click();
      await expect.poll(fileNames).toEqual(["ruled.svg"]);
      await library().getByRole("textbox", { name: "New folder" }).fill("plants");
      await library().getByRole("textbox", { name: "New folder" }).press("Enter");
      await button("plants").waitFor();
      await button("Save “ruled” here").click();
      await expect.poll(fileNames).toEqual(["ruled.svg"]);
      expect(readFileSync(onDisk("plants", "ruled.svg"), "utf8")).toBe(SVG);
      await button("Library").click();
      await expect.poll(fileNames).toEqual(["plants", "ruled.svg"]);
    },
    LIMIT_MS,
  );

  it("has its fields within its edges on a phone", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    const endOf = async (name: string): Promise<number> => {
      const { x, width } = (await button(name).boundingBox())!;
      return x + width;
    };
    expect(await endOf("Make")).toBeLessThanOrEqual((await endOf("Save “ruled” here")) + 0.5);
    await page.setViewportSize({ width: 1440, height: 900 });
  });

  it(
    "takes a file of another format, and shows a picture of it",
    async () => {
      await button("Open the folder plants").click();
      await library()
        .locator("input[type=file]")
        .setInputFiles({ name: "cross.json", mimeType: "application/json", buffer: Buffer.from(POLYLINES) });
      await expect.poll(fileNames).toEqual(["cross.json", "ruled.svg"]);
      const picture = button("Open cross.json").locator("img");
      await picture.waitFor();
      const red = await picture.evaluate((image: HTMLImageElement) => {
        const canvas = document.createElement("canvas");
        canvas.width = image.naturalWidth;
        canvas.height = image.naturalHeight;
        const context = canvas.getContext("2d")!;
        context.drawImage(image, 0, 0);
        const { data: pixels } = context.getImageData(0, 0, canvas.width, canvas.height);
        let count = 0;
        for (let i = 0; i < pixels.length; i += 4) {
          if (pixels[i + 3] > 100 && pixels[i] > 120 && pixels[i + 1] < 100) count++;
        }
        return count;
      });
      expect(red).toBeGreaterThan(100);
    },
    LIMIT_MS,
  );

  it(
    "overwrites nothing, and says so",
    async () => {
      await button("Save “ruled” here").click();
      await page.getByText("already", { exact: false }).first().waitFor();
      expect(readdirSync(onDisk("plants")).sort()).toEqual(["cross.json", "ruled.svg"]);
      // The browser reports the refusal.
      expect(complaints.splice(0)).toEqual([expect.stringContaining("409")]);
    },
    LIMIT_MS,
  );

  it(
    "finds drawings in the folder and below",
    async () => {
      await button("Library").click();
      const search = library().getByRole("textbox", { name: "Search in this folder and below" });
      await search.fill("CROSS");
      await expect.poll(fileNames).toEqual(["cross.json"]);
      await search.fill("nothing like it");
      await library().getByText("No drawing here or below has “nothing like it” in its name.").waitFor();
      await search.fill("");
      await expect.poll(fileNames).toEqual(["plants", "ruled.svg"]);
    },
    LIMIT_MS,
  );

  it.each(SCHEMES)("has nothing serious for axe to find, %s", async (colorScheme) => {
    await page.emulateMedia({ colorScheme });
    expect(await seriousFindings(page)).toEqual([]);
  });

  it(
    "is used without a mouse: into a folder, removing a drawing, and opening one",
    async () => {
      await button("Open the folder plants").focus();
      await page.keyboard.press("Enter");
      await expect.poll(fileNames).toEqual(["cross.json", "ruled.svg"]);
      expect(await focused()).toBe("plants");
      await button("More for ruled.svg").focus();
      await page.keyboard.press("Enter");
      // Closes the menu, not the dialog.
      await page.keyboard.press("Escape");
      await button("Remove ruled.svg").waitFor({ state: "detached" });
      expect(await focused()).toBe("More for ruled.svg");
      await page.keyboard.press("Enter");
      await button("Remove ruled.svg").focus();
      await page.keyboard.press("Enter");
      // The question has the focus on the answer that removes nothing.
      await expect.poll(focused).toBe("Keep it");
      await page.keyboard.press("Enter");
      await library().getByRole("alertdialog").waitFor({ state: "detached" });
      expect(existsSync(onDisk("plants", "ruled.svg"))).toBe(true);
      // The focus is not lost with the question.
      expect(await focused()).toBe("More for ruled.svg");
      await page.keyboard.press("Enter");
      await button("Remove ruled.svg").focus();
      await page.keyboard.press("Enter");
      await library().getByRole("alertdialog").getByRole("button", { name: "Remove" }).focus();
      await page.keyboard.press("Enter");
      await expect.poll(fileNames).toEqual(["cross.json"]);
      expect(existsSync(onDisk("plants", "ruled.svg"))).toBe(false);
      // On the row that is there now.
      await expect.poll(focused).toBe("More for cross.json");
      await button("Open cross.json").focus();
      await page.keyboard.press("Enter");
      await library().waitFor({ state: "detached" });
      await page.getByText("cross", { exact: true }).first().waitFor({ state: "attached" });
      await waitForPlan(page);
      expect(complaints).toEqual([]);
    },
    LIMIT_MS,
  );
});
