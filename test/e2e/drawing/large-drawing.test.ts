/** A drawing too large to be drawn in one part: the picture is complete in the end, zoomed out and zoomed in. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { colorCounts, waitForPicture, waitForPlan } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

/** Waves side by side, in short pieces and closer than the pen is wide: where one is missing, paper shows. */
const LINES = 800;
const POINTS = 221;
const wave = (line: number): string =>
  Array.from({ length: POINTS }, (_, i) => {
    const y = 60 + line / 10 + 0.4 * Math.sin(i * 1.1);
    return `${20 + i / 2} ${y.toFixed(3)}`;
  }).join("L");
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="200mm" viewBox="0 0 150 200" fill="none"
  stroke="#000">${Array.from({ length: LINES }, (_, line) => `<path d="M${wave(line)}"/>`).join("")}</svg>`;

let test: PageTest;
/** CSS px of the page: the middle of the paper, and of the drawing. */
let middle: { x: number; y: number };

const canvas = () => test.page.getByRole("img", { name: "Preview", exact: true });
const allDrawn = () => waitForPicture(test.page);
/** Requests made in between must still be pending at the end: otherwise there would be nothing to wait for. */
async function outdated(ask: () => Promise<void>): Promise<void> {
  await canvas().evaluate((element) => {
    const busy = new Promise<void>((resolve) => {
      const look = (): void => {
        if (element.ariaBusy === "true") resolve();
      };
      new MutationObserver(look).observe(element, { attributes: true });
    });
    (window as unknown as { busy: Promise<void> }).busy = busy;
  });
  await ask();
  await test.page.evaluate(() => (window as unknown as { busy: Promise<void> }).busy);
}

/** Number of pixels of the preview within `reach` px of the drawing's middle that are as bright as paper. */
async function paperPixels(reach: number): Promise<number> {
  const box = (await canvas().boundingBox())!;
  const clip = { x: middle.x - reach, y: middle.y - reach, width: 2 * reach, height: 2 * reach };
  expect(clip.x > box.x + 26 && clip.y > box.y + 26).toBe(true);
  const counts = await colorCounts(test.page, clip);
  return [...counts].reduce((sum, [color, count]) => sum + ((color & 0xff) > 128 ? count : 0), 0);
}

beforeAll(async () => {
  test = await PageTest.open("large-drawing");
  await test.look("Ink");
  await test.drop("waves", SVG);
  await test.panel("Paper");
  await test.page.getByRole("radio", { name: "Fit paper", exact: true }).check();
  await waitForPlan(test.page);
  const box = (await canvas().boundingBox())!;
  // Between rulers and legend, where stage.ts places the paper.
  middle = { x: box.x + (48 + box.width - 26) / 2, y: box.y + (48 + box.height - 56) / 2 };
});

afterAll(async () => test.close());

describe("a large drawing", () => {
  it("is complete once it is drawn", async () => {
    await allDrawn();
    expect(await paperPixels(80)).toBe(0);
  });

  it("is complete after zooming and panning", async () => {
    const { mouse, keyboard } = test.page;
    await mouse.move(middle.x, middle.y);
    await outdated(async () => {
      await keyboard.down("Control");
      for (let i = 0; i < 5; i++) await mouse.wheel(0, -100);
      await keyboard.up("Control");
      await mouse.wheel(0, 60);
    });
    // Off the paper, so that no tooltip for a stroke appears.
    await mouse.move(700, 20);
    await allDrawn();
    expect(await paperPixels(200)).toBe(0);
    expect(test.complaints).toEqual([]);
  });

  it("is complete after the window is resized, and back at the whole paper", async () => {
    await test.page.setViewportSize({ width: 1300, height: 800 });
    await test.page.getByRole("button", { name: "Whole paper" }).click();
    await test.page.setViewportSize({ width: 1440, height: 900 });
    await test.page.mouse.move(700, 20);
    await allDrawn();
    expect(await paperPixels(80)).toBe(0);
  });
});
