/** The view that shows where the time goes, the drawing that draws itself, and the corner that is where the carriage is. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { dropFile, plotBar, waitForPlan } from "../../support/browser/page-actions.js";
import { snapshotSchema } from "../../../src/schema/index.js";
import { PageTest } from "../../support/browser/page-test.js";

const PATIENCE_MS = 120_000;
/** Rows of dashes whose gaps are 0.2 mm: most of the time goes into lifting the pen. */
const DASHES = `<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="100mm" viewBox="0 0 150 100"><path fill="none" stroke="#000" d="${Array.from(
  { length: 120 },
  (_, i) => `M${10 + (i % 40) * 3.2} ${20 + 20 * Math.floor(i / 40)}h3`,
).join("")}"/></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.firstVisit("views");
  await test.drop("dashes", DASHES);
}, PATIENCE_MS);

afterAll(async () => test.close());

describe("Time", () => {
  const legend = () => test.page.getByRole("figure", { name: "Where the time goes" });
  const seconds = async (): Promise<number> => {
    await test.planned();
    const text = await test.page.getByRole("slider", { name: "Moment of the plot" }).getAttribute("max");
    return Number(text);
  };

  it("says what the time goes into, and what a change would save", async () => {
    await test.look("Time");
    const shares = (await legend().innerText()).match(/(\d+) % is/g)!.map((share) => parseInt(share));
    expect(shares).toHaveLength(3);
    expect(shares.reduce((sum, share) => sum + share)).toBeGreaterThan(98);
    expect(shares[2]).toBeGreaterThan(shares[0]);
    await legend()
      .getByText(/^Joining gaps below 0.3 mm saves/)
      .waitFor();
  });

  it("has its words below the sheet, on a desk and on a phone with a panel open", async () => {
    const { page } = test;
    for (const size of [
      { width: 1440, height: 900 },
      { width: 390, height: 844 },
    ]) {
      await page.setViewportSize(size);
      await test.panel("Paper");
      const paper = await test.onScreen("paper");
      expect((await legend().boundingBox())!.y).toBeGreaterThanOrEqual(paper.bottom);
    }
    await page.setViewportSize({ width: 1440, height: 900 });
    await page.getByRole("button", { name: "Close the panel" }).click();
  });

  it("makes a change with one click, which saves what it said, and takes it back with another", async () => {
    const beforeS = await seconds();
    const change = legend().getByRole("listitem").filter({ hasText: "Joining gaps" });
    await change.getByRole("button", { name: "Try" }).click();
    await change.getByRole("button", { name: "Undo" }).waitFor();
    // 117 of the 120 strokes are joined to the one before.
    await expect.poll(seconds).toBeLessThan(beforeS / 3);
    const strokes = plotBar(test.page).locator("dd").filter({ hasText: /^3$/ });
    await strokes.first().waitFor();
    await change.getByRole("button", { name: "Undo" }).click();
    await expect.poll(seconds).toBeCloseTo(beforeS, 3);
  });
});

describe("Start here", () => {
  it("moves the corner of the drawing to where the carriage is", async () => {
    const { page } = test;
    await test.panel("Plotter");
    await test.group("Plotter", "Move by hand");
    const place = page.getByRole("region", { name: "Plotter set-up" });
    await place.getByLabel("From home, right").fill("30");
    await place.getByLabel("From home, down").fill("40");
    await place.getByRole("button", { name: "Go there" }).click();
    const plotter = async () => {
      const answer = await fetch(`${test.server.url}/api/v1/state`);
      return snapshotSchema.parse(await answer.json()).plotters[0];
    };
    await expect.poll(async () => (await plotter()).xMm).toBeCloseTo(30, 1);
    await expect.poll(async () => (await plotter()).connection).toBe("idle");
    await place.getByRole("button", { name: "Start here" }).click();
    const { x0, y0 } = await test.queuedBox();
    expect(x0).toBeCloseTo(30, 1);
    expect(y0).toBeCloseTo(40, 1);
  });
});

describe("a drawing that is opened", () => {
  const shownShare = (page: PageTest["page"]): Promise<number> =>
    page
      .getByRole("slider", { name: "Moment of the plot" })
      .evaluate((line: HTMLInputElement) => Number(line.value) / Number(line.max));

  it("draws itself once, and is whole at the first key", async () => {
    const context = await test.browser.newContext({ reducedMotion: "no-preference" });
    const page = await context.newPage();
    await page.goto(test.server.url);
    /** The moments that the time line shows, from the plan's arrival until the drawing is whole. */
    const moments = page.evaluate(async () => {
      const seen: number[] = [];
      for (;;) {
        const line = document.querySelector<HTMLInputElement>(".time-line input[type=range]");
        if (line) seen.push(Number(line.value) / Number(line.max));
        if (seen.length > 1 && seen.at(-1)! > 0.999) return seen;
        await new Promise(requestAnimationFrame);
      }
    });
    await dropFile(page, "dashes.svg", DASHES);
    const seen = await moments;
    expect(seen[0]).toBeLessThan(0.5);
    expect(seen).toEqual([...seen].sort((a, b) => a - b));
    await dropFile(page, "again.svg", DASHES);
    await page.getByText("again", { exact: true }).first().waitFor();
    await waitForPlan(page);
    await page.keyboard.press("Shift");
    expect(await shownShare(page)).toBeGreaterThan(0.999);
    await context.close();
  });

  it("is whole at once with reduced motion", async () => {
    await test.drop("again", DASHES);
    expect(await shownShare(test.page)).toBeGreaterThan(0.999);
    expect(test.complaints).toEqual([]);
  });
});

describe("the graph of speed and acceleration", () => {
  it("has the width of the window and the colours of the theme, also after a change", async () => {
    const { page } = test;
    const picture = page.getByRole("img", { name: "Speed and acceleration over time" }).locator("canvas");
    const accents = (): Promise<number> =>
      picture.evaluate((canvas: HTMLCanvasElement) => {
        const hex = getComputedStyle(canvas).getPropertyValue("--accent").trim();
        const [r, g, b] = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
        const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
        return data.filter((red, i) => i % 4 === 0 && red === r && data[i + 1] === g && data[i + 2] === b)
          .length;
      });
    await page.getByRole("button", { name: "Speed and acceleration over time" }).click();
    await picture.waitFor();
    for (const width of [1440, 1024]) {
      await page.setViewportSize({ width, height: 900 });
      await expect
        .poll(async () => {
          const { x, width: ofPicture } = (await picture.boundingBox())!;
          return x + ofPicture;
        })
        .toBeLessThanOrEqual(width);
    }
    for (const colorScheme of ["dark", "light"] as const) {
      await page.emulateMedia({ colorScheme });
      await expect.poll(accents).toBeGreaterThan(50);
    }
    await page.setViewportSize({ width: 1440, height: 900 });
  });
});
