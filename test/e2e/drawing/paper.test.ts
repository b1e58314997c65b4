/** The size on the paper, the machine's reach, and lengths in inches, on the page. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { dropFile, plotBar } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

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
  await test.panel("Paper");
});

afterAll(async () => test.close());

const drawn = async (): Promise<string> =>
  (await test.page.locator(".drawn-size span").innerText()).replace(/\u202f/g, " ");
const plot = () => plotBar(test.page).getByRole("button", { name: "Plot", exact: true });

const radio = (name: string) => test.page.getByRole("radio", { name, exact: true });
const choose = async (name: string): Promise<void> => {
  await radio(name).check();
  await test.planned();
};
const press = async (name: string): Promise<void> => {
  await test.page.getByRole("button", { name, exact: true }).click();
  await test.planned();
};

describe("the size on the paper", () => {
  it("is always shown, in mm and in percent of the file", async () => {
    await test.drop("flag", FLAG);
    expect(await drawn()).toBe("Drawn 60 × 40 mm, 100 %");
    await choose("Fit paper");
    expect(await drawn()).toBe("Drawn 267 × 178 mm, 445 %");
    await choose("Auto");
  });

  it("is the file's if its page is the paper", async () => {
    await test.drop("ruler", RULER);
    expect(await drawn()).toBe("Drawn 279 × 10 mm, 100 %");
    expect(await radio("Auto").isChecked()).toBe(true);
    const { x0, x1 } = await test.queuedBox();
    expect([x0, x1].map((mm) => Math.round(mm * 100) / 100)).toEqual([9, 288]);
  });

  it("stays as chosen with the next drawing, and is the file's with one click", async () => {
    await choose("Fit paper");
    await test.drop("flag", FLAG);
    expect(await drawn()).toBe("Drawn 267 × 178 mm, 445 %");
    await press("Use the file’s page");
    expect(await drawn()).toBe("Drawn 60 × 40 mm, 100 %");
    await test.page.getByRole("button", { name: "Use the file’s page" }).waitFor({ state: "detached" });
    await press("Undo");
    expect(await drawn()).toBe("Drawn 267 × 178 mm, 445 %");
    await choose("Auto");
  });
});

describe("a portrait file", () => {
  const TALL = svgOf(210, 297, "M20 10V280H50");

  it("is turned by itself, and follows the paper", async () => {
    await test.drop("tall page", TALL);
    expect(await drawn()).toBe("Drawn 270 × 30 mm, 100 %, turned by 90°");
    expect(await plot().isEnabled()).toBe(true);
    expect(Object.values(await test.queuedBox()).map(Math.round)).toEqual([17, 20, 287, 50]);
    await choose("Portrait");
    expect(await drawn()).toBe("Drawn 30 × 270 mm, 100 %");
    expect(
      await plotBar(test.page)
        .getByText(/off the paper/)
        .count(),
    ).toBe(0);
  });

  it("is reported at the plot button if the machine does not reach it, until it is turned", async () => {
    const why = plotBar(test.page).getByText(/AxiDraw V3 reaches 300 × 218/);
    await why.waitFor();
    expect(await why.innerText()).toContain("1 line is out of reach.");
    expect(await plot().isDisabled()).toBe(true);
    await press("Turn for this machine");
    await why.waitFor({ state: "detached" });
    expect(await plot().isEnabled()).toBe(true);
    expect(await radio("Landscape").isChecked()).toBe(true);
    expect(await drawn()).toBe("Drawn 270 × 30 mm, 100 %, turned by 90°");
    await choose("Portrait");
    expect(await drawn()).toBe("Drawn 30 × 270 mm, 100 %");
    await choose("Landscape");
  });

  it("stays where it is when it is placed by hand, and follows the paper again after that", async () => {
    const before = Object.values(await test.queuedBox()).map(Math.round);
    await choose("Custom");
    expect(Object.values(await test.queuedBox()).map(Math.round)).toEqual(before);
    expect(await test.field("Rotate").inputValue()).toBe("90");
    await choose("Portrait");
    expect(await plot().isDisabled()).toBe(true);
    await plotBar(test.page)
      .getByText(/1 line is off the paper/)
      .waitFor();
    await choose("Auto");
    expect(await drawn()).toBe("Drawn 30 × 270 mm, 100 %");
    await choose("Landscape");
    expect(await drawn()).toBe("Drawn 270 × 30 mm, 100 %, turned by 90°");
  });

  it("keeps an angle that was typed", async () => {
    expect(await test.field("Rotate").inputValue()).toBe("90");
    await test.field("Rotate").fill("0");
    await test.field("Rotate").press("Enter");
    await test.planned();
    expect(await drawn()).toBe("Drawn 20 × 180 mm, 67 %");
    await press("Turn to fit the paper");
    expect(await drawn()).toBe("Drawn 270 × 30 mm, 100 %, turned by 90°");
    expect(await test.page.getByRole("button", { name: "Turn to fit the paper" }).count()).toBe(0);
  });
});

/** How many pixels over the strokes are the red of what is off the paper. */
const redBeside = (): Promise<number> =>
  test.page.evaluate(() => {
    const overlay = document.querySelector<HTMLCanvasElement>(".preview .stage canvas:nth-child(3)");
    const data = overlay?.getContext("2d")?.getImageData(0, 0, overlay.width, overlay.height).data ?? [];
    let count = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] === 255 && data[i] > 200 && data[i + 1] < 60 && data[i + 2] < 60) count++;
    }
    return count;
  });

describe("what leaves the paper", () => {
  /** A line of 320 mm on a page of A4, and one that is on the paper. */
  const WIDE = svgOf(297, 210, "M10 20H330M50 50H100");
  const note = () => plotBar(test.page).getByText(/off the paper/);
  const words = async (): Promise<string> => (await note().innerText()).replace(/\u202f/g, " ");

  it("is named with its figures, and nothing is plotted until a choice is made", async () => {
    await test.drop("wide", WIDE);
    expect(await words()).toBe("1 line is off the paper: up to 33 mm over the right edge.");
    expect(await plot().isDisabled()).toBe(true);
    await test.page.keyboard.press("q");
    expect((await test.jobs()).filter(({ name }) => name === "wide")).toEqual([]);
    await press("Cut");
    expect(await drawn()).toBe("Drawn 287.5 × 30 mm, 100 %");
    await plotBar(test.page).getByText("1 line is cut off at the paper.").waitFor();
    expect(await plot().isEnabled()).toBe(true);
    expect((await test.queuedBox()).x1).toBeLessThan(297.6);
  });

  it("can be fitted, and another drawing is asked about again", async () => {
    await test.drop("wider", WIDE);
    expect(await plot().isDisabled()).toBe(true);
    expect(await plotBar(test.page).getByRole("button", { name: "Move back" }).count()).toBe(0);
    await press("Fit");
    expect(await drawn()).toBe("Drawn 267 × 25 mm, 83 %");
    expect(await plot().isEnabled()).toBe(true);
    await choose("Auto");
    expect(await plot().isDisabled()).toBe(true);
  });

  it("can be allowed where the machine reaches it, and is cut only if something is left", async () => {
    const offered = async (): Promise<readonly string[]> =>
      test.page.getByRole("group", { name: "Drawing off the paper" }).getByRole("button").allInnerTexts();
    expect(await offered()).toEqual(["Cut", "Fit"]);
    await test.drop("all beside", svgOf(297, 210, "M320 20H400"));
    expect(await offered()).toEqual(["Move back", "Fit"]);
    await test.drop("wide", WIDE);
    await test.page.getByLabel("Paper", { exact: true }).selectOption("A5");
    await test.drop("flag", FLAG);
    await choose("Custom");
    await test.field("From the left").fill("170");
    await test.field("From the left").press("Enter");
    await test.planned();
    expect(await words()).toBe("2 lines are off the paper: up to 20 mm over the right edge.");
    await press("Draw it there");
    expect(await plot().isEnabled()).toBe(true);
    expect(Math.round((await test.queuedBox()).x1)).toBe(230);
  });

  it("is moved by the distance that it lacks, if it was placed by hand", async () => {
    await press("Undo");
    await press("Move back");
    expect(await test.field("From the left").inputValue()).toBe("150");
    expect(await note().count()).toBe(0);
    expect(await plot().isEnabled()).toBe(true);
    await choose("Auto");
    await test.page.getByLabel("Paper", { exact: true }).selectOption("A4");
    await test.planned();
  });

  it("glows red beside the paper, and nothing else does", async () => {
    await test.drop("wide again", WIDE);
    await expect.poll(redBeside).toBeGreaterThan(50);
    await press("Cut");
    await expect.poll(redBeside).toBe(0);
  });

  it("is turned onto the paper, if that is all it lacks", async () => {
    await test.drop("tall", svgOf(60, 250, "M30 5V245M20 5H40"));
    await choose("Portrait");
    await choose("True size");
    expect(await note().count()).toBe(0);
    await choose("Landscape");
    await choose("Custom");
    await test.field("Rotate").fill("0");
    await test.field("Rotate").press("Enter");
    await test.planned();
    expect(await note().count()).toBe(1);
    await press("Turn");
    expect(await note().count()).toBe(0);
    expect(await drawn()).toMatch(/^Drawn 240 × 20 mm, 100 %/);
    expect(await plot().isEnabled()).toBe(true);
    await press("Undo");
    expect(await note().count()).toBe(1);
    await choose("Auto");
  });
});

describe("the form", () => {
  it("has a panel for each thing to decide, one open at a time, and help at the press of a key", async () => {
    const { page } = test;
    const rail = page.getByRole("navigation", { name: "Panels" }).getByRole("button");
    const titles = (await rail.allInnerTexts()).map((title) => title.split("\n")[0]);
    expect(titles).toEqual(["Drawing", "Paper", "Layers", "Lines", "Speed", "Plotter", "Queue"]);
    for (const title of titles) {
      await rail.getByText(title, { exact: true }).click();
      await page.getByRole("complementary", { name: `${title} panel` }).waitFor();
      expect(await page.getByRole("complementary").count()).toBe(1);
    }
    await page.getByRole("button", { name: "Close the panel" }).click();
    expect(await page.getByRole("complementary").count()).toBe(0);
    await test.panel("Drawing");
    const help = page.getByText("Drop it anywhere, paste it, or choose a file");
    expect(await help.isVisible()).toBe(false);
    await page.getByRole("button", { name: "About: Drawing" }).focus();
    await page.keyboard.press("Enter");
    await help.waitFor();
    await page.keyboard.press("Enter");
    await help.waitFor({ state: "hidden" });
    await test.panel("Paper");
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
  it("a file without filled shapes says so when it is to be filled, and offers its closed outlines", async () => {
    await test.drop("box", svgOf(60, 40, "M0 0H60V40H0Z"));
    await test.panel("Lines");
    await test.group("Lines", "Fill and shade");
    await test.page.getByRole("switch", { name: "Fill areas with lines" }).click();
    await test.page.getByText(/No shape of this drawing is filled/).waitFor();
    const strokes = plotBar(test.page).locator("dd").nth(2);
    const before = Number(await strokes.innerText());
    await test.page.getByRole("button", { name: "Fill closed outlines" }).click();
    await test.planned();
    expect(Number(await strokes.innerText())).toBeGreaterThan(before);
    await test.page.getByRole("switch", { name: "Fill areas with lines" }).click();
  });

  it("a file that can't be read leaves the loaded one", async () => {
    await dropFile(test.page, "torn.svg", "<svg><path d='M0 0");
    await test.page.getByText(/torn can’t be drawn/).waitFor();
    await test.planned();
    await test.page.locator(".drawn-size", { hasText: "box" }).waitFor();
    expect(await plot().isEnabled()).toBe(true);
  });

  it("a file that is only a picture is reported as one", async () => {
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
