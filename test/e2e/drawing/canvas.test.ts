/** The views of a drawing, and the actions on one of its strokes. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { colorCounts, nextFrames, openView, statusCard } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

/** Three lines across the page, the middle one wide and blue. */
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="140mm" viewBox="0 0 200 140" fill="none">
  <g id="top"><path d="M0 0H200" stroke="#d00000" stroke-width="0.5"/></g>
  <g id="middle"><path d="M0 70H200" stroke="#0000d0" stroke-width="3"/></g>
  <g id="bottom"><path d="M0 140H200" stroke="#d00000" stroke-width="0.5"/></g></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("canvas");
  await test.drop("lines", SVG);
});

afterAll(async () => test.close());

const canvas = () => test.page.getByRole("img", { name: "Preview", exact: true });

/** How many pixels of the canvas are much more blue than red, and the other way round. */
async function blueAndRed(): Promise<readonly [blue: number, red: number]> {
  // Away from the canvas, so that no tooltip for a stroke appears.
  await test.page.mouse.move(700, 20);
  await test.drawn();
  let [blue, red] = [0, 0];
  for (const [color, count] of await colorCounts(canvas())) {
    const [r, b] = [(color >> 16) & 255, color & 255];
    if (b > r + 150) blue += count;
    if (r > b + 150) red += count;
  }
  return [blue, red];
}

describe("the looks", () => {
  const LEGENDS = [
    ["Speed", "Speed with the pen down"],
    ["Ink", "#0000d0, 3"],
    ["Layer", "middle"],
    ["Order", "Order, first to last"],
    ["Pen", "No pen for middle"],
  ] as const;

  it.each(LEGENDS)(
    "%s is one click away, with a legend that says what its colours mean",
    async (name, said) => {
      await test.look(name);
      await test.page.locator(".legend").getByText(said).first().waitFor();
      expect(await test.page.locator(".legend").count()).toBe(1);
    },
  );

  it("Ink has the file's colours and widths", async () => {
    await test.look("Ink");
    const [blue, red] = await blueAndRed();
    expect(red).toBeGreaterThan(500);
    // Two lines of 0.5 mm are red, one of 3 mm is blue.
    expect(blue).toBeGreaterThan(1.5 * red);
  });

  it("is remembered by this browser", async () => {
    await test.page.reload();
    await test.planned();
    const looks = test.page.getByRole("group", { name: "Colour by" });
    expect(await looks.getByRole("radio", { name: "Ink" }).isChecked()).toBe(true);
    await test.look("Speed");
  });
});

describe("the pen", () => {
  it("is whole where the plot begins, at the sheet's corner: it lies over the ruler", async () => {
    const { page } = test;
    await page.getByRole("slider", { name: "Moment of the plot" }).fill("0");
    await nextFrames(page);
    const overRuler = await page.locator(".pen-canvas:visible").evaluate((element) => {
      const canvas = element as HTMLCanvasElement;
      const pixels = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, 22).data;
      return pixels.filter((value, k) => k % 4 === 3 && value > 0).length;
    });
    expect(overRuler).toBeGreaterThan(50);
    await page.getByRole("slider", { name: "Moment of the plot" }).fill("10000");
  });
});

describe("the looks on a phone", () => {
  it("are a list with room for their whole names, and legends", async () => {
    const { page } = test;
    await page.setViewportSize({ width: 390, height: 844 });
    const list = page.getByRole("combobox", { name: "Colour by" });
    await list.waitFor();
    expect(await page.getByRole("radio", { name: "Ink" }).isVisible()).toBe(false);
    expect(await list.locator("option").allInnerTexts()).toEqual([
      "Ink",
      "Speed",
      "Time",
      "Order",
      "Layer",
      "Pen",
      "Pen (simulated)",
    ]);
    for (const name of await list.locator("option").allInnerTexts()) {
      await list.selectOption(name);
      const [roomPx, widthPx] = await list.evaluate((select: HTMLSelectElement) => {
        const { font, paddingLeft, paddingRight } = getComputedStyle(select);
        const context = document.createElement("canvas").getContext("2d")!;
        context.font = font;
        const words = select.selectedOptions[0]?.text ?? "";
        return [
          select.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight),
          context.measureText(words).width,
        ];
      });
      expect(roomPx, name).toBeGreaterThanOrEqual(Math.floor(widthPx));
    }
    await list.selectOption("Order");
    for (const end of ["first", "last"]) {
      await page.locator(".legend").getByText(end, { exact: true }).waitFor();
    }
    await list.selectOption("Speed");
    await page.setViewportSize({ width: 1440, height: 900 });
  });
});

describe("a stroke", () => {
  const card = () => test.page.getByRole("region", { name: "Selected stroke" });

  it("a click on a stroke selects it and shows its figures", async () => {
    const box = (await canvas().boundingBox())!;
    const x = box.x + box.width / 2;
    const tip = test.page.getByRole("tooltip").getByText("2 of 3");
    let y = box.y + 40;
    for (; y < box.y + box.height - 60 && !(await tip.isVisible()); y += 4) {
      await test.page.mouse.move(x, y);
      await nextFrames(test.page);
    }
    await test.page.mouse.click(x, y - 4);
    await card().getByText("Stroke 2 of 3").waitFor();
    expect(await card().innerText()).toMatch(/Length\s*200\s*mm/);
    expect(await test.page.getByRole("tooltip").count()).toBe(0);
  });

  it("can be plotted from: the job waits there with the pen up, and continues when it is resumed", async () => {
    await card().getByRole("button", { name: "Plot from here" }).click();
    await statusCard(test.page).getByRole("button", { name: "Resume" }).waitFor();
    const held = (await test.jobs()).find(({ state }) => state === "paused")!;
    expect(held.place).toEqual({ strokeIndex: 1, alongMm: 0 });
    await statusCard(test.page).getByRole("button", { name: "Resume" }).click();
    await expect.poll(async () => (await test.jobs())[0].state).toBe("done");
    // Two of three strokes: well below the time for all.
    const { plottedS, stats } = (await test.jobs())[0];
    expect(plottedS).toBeLessThan(stats!.durationS);
  });

  it("is no longer selected when another plan may number the strokes differently", async () => {
    await openView(test.page, "Prepare");
    await card().waitFor();
    await test.panel("Paper");
    await test.field("Margin").fill("30");
    await test.field("Margin").press("Enter");
    await card().waitFor({ state: "detached" });
  });
});

describe("what the margins cut off", () => {
  const note = () => test.page.locator(".cut-off-note");
  /** Number of pixels in the left margin that are darker than paper and grid. The margin's lines appear nowhere else. */
  const ghostPixels = async (): Promise<number> => {
    await test.page.mouse.move(700, 20);
    await test.drawn();
    const box = (await canvas().boundingBox())!;
    const clip = { x: box.x + 96, y: box.y + 200, width: 24, height: 200 };
    const counts = await colorCounts(test.page, clip);
    return [...counts].reduce((sum, [color, count]) => sum + ((color & 255) < 205 ? count : 0), 0);
  };

  it("is reported beside Plot, and shown pale", async () => {
    await test.field("Margin").fill("15");
    await test.page.getByRole("radio", { name: "Fit paper" }).check();
    await test.planned();
    expect(await note().count()).toBe(0);
    const before = await ghostPixels();
    const lines = Array.from({ length: 12 }, (_, k) => `<path d="M${1 + k} 0V210"/>`).join("");
    await test.page.getByRole("radio", { name: "True size" }).check();
    await test.page.getByText("Separate margins, mirror, cutting").click();
    await test.page.getByRole("switch", { name: "Cut off what lies outside the margins" }).check();
    await test.drop(
      "margin",
      `<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210" stroke="#000">${lines}
      <path d="M50 50H290"/><path d="M50 60H200"/></svg>`,
    );
    await note().getByText("12 lines are outside the margins and will not be drawn.").waitFor();
    await note().getByText("1 line is cut off at the margins.").waitFor();
    expect(await ghostPixels()).toBeGreaterThan(before + 500);
  });
});

describe("the legend of many layers", () => {
  it("lies below the sheet, not over it", async () => {
    const layers = Array.from(
      { length: 40 },
      (_, k) =>
        `<g id="Layer number ${k} with a name of some words"><path d="M10 ${10 + 4 * k}H280" stroke="#d00000"/></g>`,
    );
    await test.drop(
      "forty layers",
      `<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210">${layers.join("")}</svg>`,
    );
    await test.look("Layer");
    const legend = (await test.page.locator(".legend").boundingBox())!;
    expect(legend.height).toBeGreaterThan(30);
    expect(legend.y).toBeGreaterThanOrEqual((await test.onScreen("paper")).bottom);
    await test.look("Ink");
  });
});

describe("the legend on a small screen", () => {
  const COLORS = ["#112233", "#aa0000", "#00aa00", "#0000aa", "#aaaa00", "#00aaaa"];
  const legend = () => test.page.locator(".legend");

  it("is one line, and is left out where the sheet has no room for it", async () => {
    const { page } = test;
    const lines = COLORS.map(
      (color, k) => `<g id="ink-${k}"><path d="M10 ${10 + 10 * k}H280" stroke="${color}"/></g>`,
    );
    await page.setViewportSize({ width: 390, height: 844 });
    await test.drop(
      "six colours",
      `<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210">${lines.join("")}</svg>`,
    );
    await page.getByRole("combobox", { name: "Colour by" }).selectOption("Ink");
    await legend().getByText("#00aaaa").waitFor({ state: "attached" });
    expect((await legend().boundingBox())!.height).toBeLessThan(30);
    // As at 200 % zoom.
    await page.setViewportSize({ width: 720, height: 450 });
    await test.panel("Drawing");
    await legend().waitFor({ state: "hidden" });
    await page.setViewportSize({ width: 1440, height: 900 });
    await legend().waitFor();
  });
});
