/** The size on the paper, the machine's reach, and lengths in inches, on the page. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { dropFile, plotBar } from "../support/page-actions.js";
import { PageTest } from "../support/page-test.js";

const svgOf = (width: number, height: number, d: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">
    <path d="${d}" fill="none" stroke="#000"/></svg>`;
/** 60 × 40 mm, or 267 × 178 mm when fitted to the paper inside its margins. */
const FLAG = svgOf(60, 40, "M0 0L60 40M60 0L0 40");
/** A ruler of 279 mm on A4. */
const RULER = svgOf(297, 210, "M9 100H288M9 95V105M288 95V105");

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("paper");
  await test.group("Paper");
});

afterAll(async () => test.close());

const drawn = async (): Promise<string> =>
  (await test.page.locator(".drawn-size span").innerText()).replace(/\u202f/g, " ");
const plot = () => plotBar(test.page).getByRole("button", { name: "Plot", exact: true });

describe("the size on the paper", () => {
  it("is always shown, in mm and in percent of the file", async () => {
    await test.drop("flag", FLAG);
    expect(await drawn()).toBe("Drawn 267 × 178 mm, 445 %");
  });

  it("is the file's if its page is the paper", async () => {
    await test.drop("ruler", RULER);
    expect(await drawn()).toBe("Drawn 279 × 10 mm, 100 %");
    expect(await test.page.getByRole("radio", { name: "True size" }).isChecked()).toBe(true);
    const { x0, x1 } = await test.queuedBox();
    expect([x0, x1].map((mm) => Math.round(mm * 100) / 100)).toEqual([9, 288]);
  });

  it("fits the paper again with the next drawing, and is the file's with one click", async () => {
    await test.drop("flag", FLAG);
    expect(await drawn()).toBe("Drawn 267 × 178 mm, 445 %");
    await test.page.getByRole("button", { name: "Use the file’s page" }).click();
    await test.planned();
    expect(await drawn()).toBe("Drawn 60 × 40 mm, 100 %");
    await test.page.getByRole("button", { name: "Use the file’s page" }).waitFor({ state: "detached" });
    await test.page.getByRole("button", { name: "Undo" }).click();
    await test.planned();
    expect(await drawn()).toBe("Drawn 267 × 178 mm, 445 %");
  });
});

describe("what the machine does not reach", () => {
  it("is reported at the plot button, which is disabled until the drawing is turned", async () => {
    await test.drop("tall", svgOf(100, 200, "M0 0L100 200"));
    await test.page.getByRole("radio", { name: "Portrait" }).check();
    await test.planned();
    const why = plotBar(test.page).getByText(/AxiDraw V3 reaches 300 × 218/);
    await why.waitFor();
    expect(await why.innerText()).toContain("1 line is out of reach.");
    expect(await plot().isDisabled()).toBe(true);
    await plotBar(test.page).getByRole("button", { name: "Turn for this machine" }).click();
    await test.planned();
    await why.waitFor({ state: "detached" });
    expect(await plot().isEnabled()).toBe(true);
    expect(await test.page.getByRole("radio", { name: "Landscape" }).isChecked()).toBe(true);
    expect(await drawn()).toMatch(/^Drawn 267 × 133.5 mm/);
  });

  it("is corrected automatically if the user has chosen nothing for the drawing", async () => {
    await test.field("Rotate").fill("0");
    await test.page.getByRole("radio", { name: "Portrait" }).check();
    await test.drop("flag", FLAG);
    expect(await test.page.getByRole("radio", { name: "Landscape" }).isChecked()).toBe(true);
    expect(await plot().isEnabled()).toBe(true);
  });

  it("is corrected by turning page and paper if the page is the paper", async () => {
    await test.drop("tall page", svgOf(210, 297, "M20 10V200"));
    expect(await drawn()).toBe("Drawn 190 × 0 mm, 100 %");
    expect(await plot().isEnabled()).toBe(true);
  });
});

describe("the form", () => {
  it("has a group for each thing to decide, and help at the press of a key", async () => {
    const { page } = test;
    const titles = await page.locator(".column-setup .group:not(.group-part) > .group-top").allInnerTexts();
    expect(titles.map((title) => title.split("\n")[0])).toEqual([
      "Drawing",
      "Paper",
      "Layers and pens",
      "Lines",
      expect.any(String),
      "Presets",
    ]);
    const help = page.getByText("Drop it anywhere, paste it, or choose a file");
    expect(await help.isVisible()).toBe(false);
    await page.getByRole("button", { name: "About: Drawing" }).focus();
    await page.keyboard.press("Enter");
    await help.waitFor();
    await page.keyboard.press("Enter");
    await help.waitFor({ state: "hidden" });
  });

  it("keeps mirror, cutting and separate margins folded until they are asked for", async () => {
    const mirror = test.page.getByRole("radio", { name: "Left–right" });
    expect(await mirror.isVisible()).toBe(false);
    const fold = test.page.getByText("Separate margins, mirror, cutting");
    await fold.click();
    expect(await test.page.getByText("Separate margins", { exact: true }).isVisible()).toBe(true);
    await mirror.waitFor({ state: "attached" });
    await fold.click();
  });
});

describe("a custom paper", () => {
  const typed = async (label: string, text: string): Promise<void> => {
    await test.field(label).focus();
    await test.page.keyboard.press("ControlOrMeta+A");
    await test.page.keyboard.type(text);
    await test.planned();
  };
  const size = async (): Promise<string[]> =>
    Promise.all([test.field("Width").inputValue(), test.field("Height").inputValue()]);
  const isLandscape = () => test.page.getByRole("radio", { name: "Landscape" }).isChecked();
  const paper = () => test.page.getByLabel("Paper", { exact: true });
  const queuedPaper = async () => {
    const { paper, landscape } = (await test.queue()).settings.prepare;
    return { ...paper, landscape };
  };

  it("starts with the size of the paper as it lies", async () => {
    await test.drop("flag", FLAG);
    await paper().selectOption("A4");
    expect(await isLandscape()).toBe(true);
    await paper().selectOption("custom");
    expect(await size()).toEqual(["297", "210"]);
  });

  it("is as wide and as high as was typed", async () => {
    await typed("Width", "250");
    expect(await size()).toEqual(["250", "210"]);
    expect(await queuedPaper()).toEqual({ widthMm: 210, heightMm: 250, landscape: true });
    await typed("Height", "280");
    expect(await size()).toEqual(["250", "280"]);
    expect(await queuedPaper()).toEqual({ widthMm: 250, heightMm: 280, landscape: false });
  });

  it("keeps its fields while the typed size is that of a named paper", async () => {
    await typed("Height", "297");
    await typed("Width", "210");
    expect(await paper().inputValue()).toBe("custom");
    await test.page.keyboard.type("0");
    expect(await test.field("Width").inputValue()).toBe("2100");
    await paper().selectOption("A4");
    await test.field("Width").waitFor({ state: "detached" });
    await test.page.getByRole("radio", { name: "Landscape" }).check();
    await test.planned();
  });
});

describe("the name of the paper after a custom size", () => {
  const paper = () => test.page.getByLabel("Paper", { exact: true });
  const useFilesPage = async (): Promise<void> => {
    await test.page.getByRole("button", { name: "Use the file’s page" }).click();
    await test.planned();
  };

  it.each([
    ["A5", svgOf(210, 148, "M20 20H190V120")],
    ["A4", svgOf(297, 210, "M20 20H250V180")],
  ])("is that of the file's page: %s", async (name, svg) => {
    await test.drop(`page ${name}`, svg);
    await test.page.getByRole("radio", { name: "Fit paper" }).check();
    await paper().selectOption("A4");
    await paper().selectOption("custom");
    expect(await paper().inputValue()).toBe("custom");
    await useFilesPage();
    expect(await paper().inputValue()).toBe(name);
    await test.field("Width").waitFor({ state: "detached" });
  });

  it("is none if the file's page has no name", async () => {
    await test.drop("flag", FLAG);
    await useFilesPage();
    expect(await paper().inputValue()).toBe("custom");
    expect([await test.field("Width").inputValue(), await test.field("Height").inputValue()]).toEqual([
      "60",
      "40",
    ]);
    await test.page.getByRole("button", { name: "Undo" }).click();
    await test.planned();
    expect(await paper().inputValue()).toBe("A4");
  });
});

describe("a length", () => {
  it("may be typed with its unit", async () => {
    await test.drop("flag", FLAG);
    await test.field("Margin").fill("2 cm");
    await test.planned();
    await test.field("Margin").press("Enter");
    expect(await test.field("Margin").inputValue()).toBe("20");
    await test.page.getByLabel("Paper", { exact: true }).selectOption("custom");
    await test.field("Width").fill("8.5in");
    await test.field("Width").press("Enter");
    expect(await test.field("Width").inputValue()).toBe("215.9");
  });

  it("is in inches everywhere once that is chosen, after a reload too", async () => {
    await test.page.getByRole("radio", { name: "Inches" }).check();
    expect(await test.field("Width").inputValue()).toBe("8.5");
    expect(await drawn()).toMatch(/^Drawn .* in, /);
    await test.field("Margin").fill("0.5");
    await test.planned();
    // The settings are stored shortly after the last change.
    await test.page.waitForFunction(() =>
      localStorage.getItem("plotwright.page.v1")?.includes('"marginMm":12.7'),
    );
    await test.page.reload();
    await test.planned();
    expect(await test.field("Margin").inputValue()).toBe("0.5");
    expect(await test.field("Width").inputValue()).toBe("8.5");
    await test.page.getByRole("radio", { name: "Millimetres" }).check();
    expect(await test.field("Margin").inputValue()).toBe("12.7");
  });
});

describe("a file", () => {
  it("without filled shapes says so when it is to be filled, and offers its closed outlines", async () => {
    await test.drop("box", svgOf(60, 40, "M0 0H60V40H0Z"));
    await test.group("Lines");
    await test.group("Fill and shade");
    await test.page.getByText("Fill areas with lines").click();
    await test.page.getByText(/No shape of this drawing is filled/).waitFor();
    const strokes = plotBar(test.page).locator("dd").nth(2);
    const before = Number(await strokes.innerText());
    await test.page.getByRole("button", { name: "Fill closed outlines" }).click();
    await test.planned();
    expect(Number(await strokes.innerText())).toBeGreaterThan(before);
    await test.page.getByText("Fill areas with lines").click();
  });

  it("that can't be read leaves the loaded one", async () => {
    await dropFile(test.page, "torn.svg", "<svg><path d='M0 0");
    await test.page.getByText(/torn can’t be drawn/).waitFor();
    await test.planned();
    await test.page.locator(".drawing-name", { hasText: "box" }).waitFor();
    expect(await plot().isEnabled()).toBe(true);
  });

  it("that is only a picture is reported as one", async () => {
    await test.drop(
      "photo",
      `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm"><image href="a.png" width="60mm" height="40mm"/></svg>`,
    );
    await test.page.getByText("This file holds only a picture").waitFor();
    expect(await plot().isDisabled()).toBe(true);
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
