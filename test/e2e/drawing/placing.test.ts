/**
 * Placing the drawing on the paper: by hand, by numbers, by keys. The check is where the queued job would
 * draw.
 */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { PageTest } from "../../support/browser/page-test.js";

/**
 * 60 × 40 mm: a cross from corner to corner, which no frame hides, and a dash at the left that shows
 * mirroring.
 */
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">
  <path d="M0 0L60 40M60 0L0 40M6 20H16" fill="none" stroke="#000"/></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("placing");
  await test.drop("flag", SVG);
  await test.look("Ink");
  await test.panel("Paper");
});

afterAll(async () => test.close());

/** CSS px per mm, from the paper's width. */
let scale = 0;
let corner: [number, number] = [0, 0];

/** A point of the paper, in screen coordinates. */
const at = (xMm: number, yMm: number): [number, number] => [corner[0] + xMm * scale, corner[1] + yMm * scale];

async function drag(from: [number, number], to: [number, number], isFree = false): Promise<void> {
  const { mouse, keyboard } = test.page;
  await mouse.move(...from);
  if (isFree) await keyboard.down("Alt");
  await mouse.down();
  await mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 4 });
  await mouse.move(...to, { steps: 4 });
  await mouse.up();
  if (isFree) await keyboard.up("Alt");
  await test.planned();
}

async function type(label: string, value: number): Promise<void> {
  await test.field(label).fill(String(value));
  await test.field(label).press("Enter");
  await test.planned();
}

async function placeAt(x: number, y: number, width: number, angle = 0): Promise<void> {
  await type("From the left", x);
  await type("From the top", y);
  await type("Width", width);
  await type("Rotate", angle);
  // Computed each time, because messages above the paper make it smaller.
  const { left, top, right } = await test.onScreen("paper");
  scale = (right - left) / 297;
  corner = [left, top];
}

const rounded = (values: object): number[] =>
  Object.values(values).map((mm: number) => Math.round(mm * 100) / 100);

describe("on a turned desk", () => {
  const turnDesk = () => test.page.getByRole("button", { name: "Turn the desk" }).click();

  it("the drawing follows pointer and keys on the screen, and only the picture is turned", async () => {
    const { page } = test;
    await page.getByRole("button", { name: "Place the drawing by hand" }).click();
    await test.field("From the left").waitFor();
    await placeAt(50, 60, 90);
    const box = await test.queuedBox();
    await turnDesk();
    expect(await test.queuedBox()).toEqual(box);
    const paper = await test.onScreen("paper");
    const pxPerMm = (paper.bottom - paper.top) / 297;
    expect((paper.right - paper.left) / pxPerMm).toBeCloseTo(210, -1);
    // Home is at the upper right: x goes down, y to the left.
    const before = await test.onScreen("ink");
    expect(Math.abs((before.top - paper.top) / pxPerMm - 50)).toBeLessThan(4);
    expect(Math.abs((paper.right - before.right) / pxPerMm - 60)).toBeLessThan(4);
    const [x, y] = [paper.right - 80 * pxPerMm, paper.top + 105 * pxPerMm];
    await drag([x, y], [x + 41, y - 23], true);
    const after = await test.onScreen("ink");
    expect(Math.abs(after.left - before.left - 41)).toBeLessThanOrEqual(2);
    expect(Math.abs(after.top - before.top + 23)).toBeLessThanOrEqual(2);
    const moved = await test.queuedBox();
    expect(Math.abs(moved.x0 - box.x0 + 23 / pxPerMm)).toBeLessThan(0.3);
    expect(Math.abs(moved.y0 - box.y0 + 41 / pxPerMm)).toBeLessThan(0.3);
    await page.locator(".stage").focus();
    for (const key of ["ArrowRight", "ArrowDown", "ArrowDown"]) await page.keyboard.press(key);
    await test.planned();
    const nudged = await test.queuedBox();
    expect(rounded({ x: nudged.x0 - moved.x0, y: nudged.y0 - moved.y0 })).toEqual([2, -1]);
  });

  it("a stroke is found under the pointer", async () => {
    const { left, top, right, bottom } = await test.onScreen("ink");
    // The cross of the drawing.
    await test.page.mouse.move((left + right) / 2, (top + bottom) / 2);
    await test.page.getByRole("tooltip").waitFor();
    await test.page.mouse.move(left + (right - left) / 2, top + 3 * ((bottom - top) / 8));
    await test.page.getByRole("tooltip").waitFor({ state: "detached" });
  });

  it("is remembered, and stands as before after three more turns", async () => {
    await test.page.waitForTimeout(600);
    await test.page.reload();
    await test.panel("Paper");
    const { left, top, right, bottom } = await test.onScreen("paper");
    expect(bottom - top).toBeGreaterThan(right - left);
    for (let k = 0; k < 3; k++) await turnDesk();
    const again = await test.onScreen("paper");
    expect(again.right - again.left).toBeGreaterThan(again.bottom - again.top);
    await test.page.getByRole("button", { name: "Place the drawing by hand" }).click();
    await test.planned();
  });
});

describe("placing the drawing", () => {
  it("shows handles around it at the click of a button, without moving it", async () => {
    const before = await test.queuedBox();
    await test.page.getByRole("button", { name: "Place the drawing by hand" }).click();
    await test.field("From the left").waitFor();
    const after = await test.queuedBox();
    for (const [k, mm] of Object.values(after).entries()) expect(mm).toBeCloseTo(Object.values(before)[k], 1);
  });

  it("moves to the entered position and size", async () => {
    await placeAt(50, 60, 90);
    expect(rounded(await test.queuedBox())).toEqual([50, 60, 140, 120]);
    await type("Height", 30);
    expect(rounded(await test.queuedBox())).toEqual([50, 60, 95, 90]);
  });

  it("follows the pointer, pixel for pixel on the screen and millimetre for millimetre on paper", async () => {
    await placeAt(50, 60, 90);
    const before = await test.onScreen("ink");
    const [x, y] = at(105, 80);
    await drag([x, y], [x + 103, y - 41], true);
    const after = await test.onScreen("ink");
    expect(Math.abs(after.left - before.left - 103)).toBeLessThanOrEqual(2);
    expect(Math.abs(after.top - before.top + 41)).toBeLessThanOrEqual(2);
    const box = await test.queuedBox();
    expect(Math.abs(box.x0 - 50 - 103 / scale)).toBeLessThan(0.3);
    expect(Math.abs(box.y0 - 60 + 41 / scale)).toBeLessThan(0.3);
    expect(box.x1 - box.x0).toBeCloseTo(90, 1);
  });

  it("grows by its corner, while the opposite corner stays", async () => {
    await placeAt(50, 60, 90);
    await drag(at(140, 120), at(185, 150), true);
    const box = await test.queuedBox();
    expect([box.x0, box.y0].map((mm) => Math.round(mm * 10) / 10)).toEqual([50, 60]);
    expect(Math.abs(box.x1 - box.x0 - 135)).toBeLessThan(1);
    expect((box.x1 - box.x0) / (box.y1 - box.y0)).toBeCloseTo(1.5, 2);
  });

  it("is turned by its knob, in steps of 15° when near one, about its middle", async () => {
    await placeAt(50, 60, 90);
    const [x, y] = at(95, 60);
    await drag([x, y - 30], at(150, 91));
    // 90 × 60 about (95, 90), turned by 90°.
    expect(rounded(await test.queuedBox())).toEqual([65, 45, 125, 135]);
    expect(await test.field("Rotate").inputValue()).toBe("90");
  });

  it("is scaled to a margin, to the hundredth", async () => {
    await placeAt(18, 60, 90);
    await drag(at(70, 80), at(68, 95));
    expect(rounded(await test.queuedBox())[0]).toBe(15);
  });

  it("moves by arrow keys while the paper has the focus", async () => {
    await placeAt(50, 60, 90);
    await test.page.locator(".stage").focus();
    for (const key of ["ArrowRight", "ArrowRight", "Shift+ArrowDown", "ArrowUp"]) {
      await test.page.keyboard.press(key);
    }
    expect(rounded(await test.queuedBox())).toEqual([52, 69, 142, 129]);
  });

  it("fills four custom margins, is centred, and is mirrored", async () => {
    await test.page.getByText("Separate margins, mirror, cutting").click();
    await test.page.getByRole("switch", { name: "Separate margins" }).click();
    await type("Left", 40);
    await type("Top", 20);
    await test.page.getByRole("button", { name: "Fit into margins" }).click();
    await test.planned();
    const filled = await test.queuedBox();
    expect(filled.x0).toBeGreaterThanOrEqual(40 - 0.01);
    expect(filled.y1).toBeLessThanOrEqual(210 - 15 + 0.01);
    expect(Math.max(filled.x0 - 40, filled.y0 - 20)).toBeLessThan(10);
    await test.page.getByRole("button", { name: "Centre down" }).click();
    await test.page.getByRole("radio", { name: "Left–right" }).check();
    await test.planned();
    const { xy } = await test.strokesOf(await test.queue());
    const xs = [...xy].filter((_, k) => k % 2 === 0);
    const ys = [...xy].filter((_, k) => k % 2 === 1);
    const [middle, level] = [xs, ys].map((all) => (Math.min(...all) + Math.max(...all)) / 2) as [
      number,
      number,
    ];
    expect([middle, level].map((mm) => Math.round(mm))).toEqual([161, 105]);
    // The dash, alone at mid-height, was at the left.
    const dash = xs.filter((x, k) => Math.abs(ys[k] - level) < 0.01 && Math.abs(x - middle) > 1);
    expect(dash.length).toBe(2);
    for (const x of dash) expect(x).toBeGreaterThan(middle);
  });

  it("returns to the previous position with undo", async () => {
    const before = await test.queuedBox();
    await type("From the left", 77);
    await test.page.getByRole("button", { name: "Undo" }).click();
    expect(rounded(await test.queuedBox())).toEqual(rounded(before));
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
