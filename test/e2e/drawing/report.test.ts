/** The page lists the parts of a file that are not drawn, and marks them on the paper. */
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import {
  chooseSample,
  colorCounts,
  dropFile,
  openPanel,
  waitForPicture,
  waitForPlan,
} from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="140mm" viewBox="0 0 200 140">
  <circle cx="60" cy="70" r="40" fill="none" stroke="#000"/>
  <image href="photo.png" x="120" y="20" width="60" height="60"/>
  <rect x="120" y="100" width="50" height="20" fill="url(#g)" stroke="none"/>
  <linearGradient id="g"><stop stop-color="#f00"/></linearGradient></svg>`;
/** The fill of a marked place on white, and as the overlay paints it at 14 %. */
const isMarked = (rgb: number): boolean => {
  const [r, g, b] = [(rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255];
  return r > 225 && g > 210 && g < 242 && b > 195 && b < 225 && r - b > 20;
};

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("report");
  await test.drop("poster", SVG);
  await test.panel("Drawing");
});

afterAll(async () => test.close());

async function markedPixels(page: Page): Promise<number> {
  await waitForPlan(page);
  await waitForPicture(page);
  const counts = await colorCounts(page.getByRole("img", { name: "Preview", exact: true }));
  return [...counts].reduce((sum, [rgb, count]) => sum + (isMarked(rgb) ? count : 0), 0);
}

describe("the report", () => {
  it("names what is not drawn, and what the user can do about it", async () => {
    await test.page.locator(".report li").first().waitFor();
    const notes = await test.page.locator(".report li").allInnerTexts();
    expect(notes.join("\n")).toMatch(/1 picture is not drawn[^\n]*Trace/);
    expect(notes.length).toBeGreaterThanOrEqual(1);
    for (const note of notes) expect(note).toMatch(/\.\s/);
  });

  it("shows its place on the paper, and hides it with the next click", async () => {
    const before = await markedPixels(test.page);
    const show = test.page
      .locator(".report li", { hasText: "picture" })
      .getByRole("button", { name: "Show where" });
    await show.click();
    expect(await show.getAttribute("aria-pressed")).toBe("true");
    const marked = (await markedPixels(test.page)) - before;
    // 60 × 60 mm of a paper shown at 2 px per mm or more.
    expect(marked).toBeGreaterThan(10_000);
    await show.click();
    expect(Math.abs((await markedPixels(test.page)) - before)).toBeLessThan(50);
  });

  it("is absent for a drawing that is drawn completely", async () => {
    await test.drop("ring", SVG.replace(/<(image|rect|linearGradient)[\s\S]*?(?=<\/svg>)/, ""));
    expect(await test.page.locator(".report").count()).toBe(0);
  });

  it("reads a page in px as a paper with one click, and goes back with another", async () => {
    const size = async (): Promise<string> =>
      (await test.page.locator(".drawn-size span").innerText()).replace(/\u202f/g, " ");
    const file = (height: number): string =>
      `<svg xmlns="http://www.w3.org/2000/svg" width="2480" height="${height}"><path d="M300 300H1500V900" fill="none" stroke="#000"/></svg>`;
    await test.drop("scan", file(3508));
    const note = test.page.locator(".report li", { hasText: "px per inch" });
    await note.getByRole("button", { name: "Read as A4 at 300 px per inch" }).click();
    await test.planned();
    // 1200 × 600 px, on upright A4 or turned with it.
    expect(await size()).toMatch(/^Drawn (101\.6 × 50\.8|50\.8 × 101\.6) mm, 100 %/);
    expect(await test.page.locator(".report").count()).toBe(0);
    await test.panel("Paper");
    const field = test.page.getByLabel("Resolution of the file");
    expect(await field.first().inputValue()).toBe("300");
    await test.page.getByRole("button", { name: "Guess the resolution" }).click();
    await test.planned();
    await test.panel("Drawing");
    expect(await note.count()).toBe(1);
    // Another file is read with its own px again.
    await note.getByRole("button", { name: "Read as A4 at 300 px per inch" }).click();
    await test.planned();
    await test.drop("other scan", file(3000));
    await test.panel("Paper");
    expect(await field.first().inputValue()).toBe("96");
  });

  it("works with a finger on a phone, with the paper in view", async () => {
    const context = await test.browser.newContext({
      viewport: { width: 390, height: 844 },
      hasTouch: true,
      isMobile: true,
    });
    const phone = await context.newPage();
    await phone.goto(test.server.url);
    await chooseSample(phone);
    await dropFile(phone, "poster.svg", SVG);
    await openPanel(phone, "Drawing");
    const show = phone
      .locator(".report li", { hasText: "picture" })
      .getByRole("button", { name: "Show where" });
    await show.scrollIntoViewIfNeeded();
    const { height } = (await show.boundingBox())!;
    expect(height).toBeGreaterThanOrEqual(40);
    await show.tap();
    expect(await markedPixels(phone)).toBeGreaterThan(2_000);
    await context.close();
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});

describe("filled shapes", () => {
  const squares = (count: number): string =>
    Array.from(
      { length: count },
      (_, k) => `<rect x="${10 + 12 * k}" y="${10 + 6 * k}" width="20" height="20" fill="#335577"/>`,
    ).join("");
  const svgOf = (body: string): string =>
    `<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210">${body}</svg>`;
  const choice = () => test.page.getByRole("group", { name: "Filled shapes" });
  const way = (name: string) => choice().getByRole("button", { name });
  /** How many pixels of each small picture have ink. */
  const inked = (): Promise<number[]> =>
    choice()
      .locator("canvas")
      .evaluateAll((canvases) =>
        canvases.map((canvas) => {
          const { width, height } = canvas as HTMLCanvasElement;
          const context = (canvas as HTMLCanvasElement).getContext("2d")!;
          const { data } = context.getImageData(0, 0, width, height);
          return data.filter((value, i) => i % 4 === 3 && value > 0).length;
        }),
      );
  const pressed = async (): Promise<string[]> =>
    (await choice().locator("[aria-pressed=true]").allInnerTexts()).map((text) => text.trim());

  it("are counted, and each way to draw them is shown on this drawing", async () => {
    await test.panel("Drawing");
    await test.drop("squares", svgOf(squares(3)));
    await choice()
      .getByText(/^3 filled shapes/)
      .waitFor();
    await test.page.getByRole("button", { name: "3 filled shapes become outlines" }).waitFor();
    await expect.poll(async () => (await inked()).length).toBe(3);
    const [outline, hatch, hide] = await inked();
    expect(hatch).toBeGreaterThan(1.5 * outline);
    expect(hide).toBeLessThan(outline);
    expect(hide).toBeGreaterThan(0);
    expect(await pressed()).toEqual(["Outline"]);
  });

  it("are drawn as chosen, and the next file is asked about again", async () => {
    await way("Hatch").click();
    await test.planned();
    expect(await pressed()).toEqual(["Hatch"]);
    expect(await test.page.getByText("become outlines").count()).toBe(0);
    await way("Hide what is under them").click();
    await test.planned();
    expect(await pressed()).toEqual(["Hide what is under them"]);
    await test.drop("more squares", svgOf(squares(4)));
    expect(await pressed()).toEqual(["Outline"]);
    await test.drop("lines", svgOf('<path d="M10 10H90" stroke="#000"/>'));
    expect(await choice().count()).toBe(0);
  });
});
