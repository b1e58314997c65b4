/** The end of a plot: the page compares its time, offers to keep what was changed, and saves its picture. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { Job } from "../../../src/schema/index.js";
import { seriousFindings } from "../../support/browser/axe.js";
import { SCHEMES } from "../../support/browser/in-states.js";
import { openView, plotBar, statusCard } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const LIMIT_MS = 120_000;
const NAME = "done";
/** 90 lines of 250 mm: half a minute on the virtual board, so that there is time to change the speed. */
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="280mm" height="200mm" viewBox="0 0 280 200" fill="none" stroke="#c8102e">${Array.from(
  { length: 90 },
  (_, i) => `<path d="M15 ${10 + 2 * i}h250"/>`,
).join("")}</svg>`;

let test: PageTest;
beforeAll(async () => {
  test = await PageTest.firstVisit("done", {}, ["--virtual-speed", "12"]);
}, LIMIT_MS);
afterAll(async () => test.close());

const theJob = async (): Promise<Job> => (await test.jobs()).find(({ name }) => name === NAME)!;
const bytesOf = async (stream: AsyncIterable<Uint8Array>): Promise<Buffer> => {
  const chunks: Uint8Array[] = [];
  for await (const chunk of stream) chunks.push(chunk);
  return Buffer.concat(chunks);
};
const saved = async (format: "PNG" | "SVG"): Promise<{ name: string; bytes: Buffer }> => {
  const arriving = test.page.waitForEvent("download");
  await statusCard(test.page)
    .getByRole("button", { name: `Save ${format} picture` })
    .click();
  const download = await arriving;
  return { name: download.suggestedFilename(), bytes: await bytesOf(await download.createReadStream()) };
};

describe("a plot that has ended", () => {
  it(
    "says how long it took and what it drew",
    async () => {
      const { page } = test;
      await test.drop(NAME, SVG);
      await plotBar(page).getByRole("button", { name: "Plot", exact: true }).click();
      await expect.poll(async () => (await theJob())?.state).toBe("plotting");
      await page.getByRole("combobox", { name: "Speed now" }).selectOption("75");
      await expect.poll(async () => (await theJob()).speedPct).toBe(75);
      await expect.poll(async () => (await theJob()).state, { timeout: LIMIT_MS }).toBe("done");
      await statusCard(page).getByText("22.5 m of ink in 90 strokes").waitFor();
      await statusCard(page)
        .getByText(/(longer|shorter) than the expected/)
        .waitFor();
    },
    LIMIT_MS,
  );

  it(
    "offers to keep the speed at which it ran, once",
    async () => {
      const { page } = test;
      await statusCard(page).getByText("It ran at 75 % of its speeds: keep that from now on?").waitFor();
      for (const colorScheme of SCHEMES) {
        await page.emulateMedia({ colorScheme });
        expect(await seriousFindings(page)).toEqual([]);
      }
      const { speedMmPerS } = (await theJob()).settings.motion.draw;
      await statusCard(page).getByRole("button", { name: "Keep", exact: true }).click();
      await statusCard(page).getByText("keep that from now on?").waitFor({ state: "detached" });
      await openView(page, "Prepare");
      await plotBar(page).getByRole("button", { name: "Add to queue" }).click();
      const next = async (): Promise<Job | undefined> =>
        (await test.jobs()).find(({ state }) => state === "queued");
      await expect
        .poll(async () => (await next())?.settings.motion.draw.speedMmPerS)
        .toBe(0.75 * speedMmPerS);
      await openView(page, "Watch");
    },
    LIMIT_MS,
  );

  it(
    "saves its picture as SVG and PNG, as it was plotted",
    async () => {
      const svg = await saved("SVG");
      expect(svg.name).toBe("done, plotted.svg");
      const text = svg.bytes.toString("utf8");
      expect(text.match(/<path/g)?.length).toBe(90);
      expect(text).toContain("#c8102e");
      const png = await saved("PNG");
      expect(png.name).toBe("done, plotted.png");
      expect(png.bytes.subarray(1, 4).toString("latin1")).toBe("PNG");
      expect(png.bytes.readUInt32BE(16)).toBe(3_000);
      const inked = await test.page.evaluate(async (base64) => {
        const bytes = Uint8Array.from(atob(base64), (one) => one.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        const context = canvas.getContext("2d")!;
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        let red = 0;
        let transparent = 0;
        for (let i = 0; i < data.length; i += 4) {
          if (data[i] > 150 && data[i + 1] < 80) red++;
          if (data[i + 3] < 255) transparent++;
        }
        return { red, transparent };
      }, png.bytes.toString("base64"));
      expect(inked.red).toBeGreaterThan(5_000);
      expect(inked.transparent).toBe(0);
      expect(test.complaints).toEqual([]);
    },
    LIMIT_MS,
  );
});
