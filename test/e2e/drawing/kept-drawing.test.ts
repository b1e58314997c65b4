/** A drawing and its settings survive a reload; another drawing starts fresh. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { dropFile, plotBar, waitForPlotButton } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";

/** The second layer has 44 blue strokes and one purple one. */
const MIXED = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="200mm" height="150mm" viewBox="0 0 200 150" fill="none">
  <g inkscape:groupmode="layer" inkscape:label="1-black" id="black"><path stroke="#000000" d="M10 10H190"/></g>
  <g inkscape:groupmode="layer" inkscape:label="2-blue" id="blue"><path stroke="#800080" d="M10 140H60"/>
  ${Array.from({ length: 44 }, (_, k) => `<path stroke="#0000e0" d="M10 ${20 + 2 * k}H60"/>`).join("")}</g></svg>`;
/** Over a megabyte: stored as bytes, not as text. */
const LARGE = `<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="60mm" viewBox="0 0 90 60">
  <!--${"x".repeat(1_200_000)}--><path fill="none" stroke="#000" d="M10 10H80V50"/></svg>`;

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("kept-drawing");
});

afterAll(async () => test.close());

const nameOnPaper = () => test.page.locator(".drawn-size strong").innerText();
const copies = () => plotBar(test.page).getByLabel("Copies", { exact: true });

describe("a layer of two colours", () => {
  it("is reported, and gets the pen of its most frequent colour, with a stop before it", async () => {
    const { page } = test;
    await test.drop("mixed", MIXED);
    await test.panel("Layers");
    const row = page.locator(".layer-list li", { hasText: "2-blue" });
    await row.getByText("2 colours", { exact: true }).waitFor();
    expect(await page.locator(".layer-mixed").count()).toBe(1);
    await test.group("Layers", "Pens");
    await page.getByRole("button", { name: "A pen for each colour" }).click();
    await row.getByText("Stop: put in Blue").waitFor();
    const job = await test.queue();
    const penOf = (layer: string) => job.settings.pens.find(({ id }) => id === job.settings.layerPens[layer]);
    expect([penOf("black")?.color, penOf("blue")?.color]).toEqual(["#000000", "#0000e0"]);
  });
});

describe("after a reload", () => {
  it("the drawing is on the paper again, with the settings of its layers", async () => {
    const { page } = test;
    await page.getByRole("checkbox", { name: "Draw 1-black" }).uncheck();
    await test.planned();
    // Settings are stored shortly after the last change.
    await page.waitForFunction(() =>
      localStorage.getItem("plotwright.page.v1")?.includes('"hiddenLayers":["black"]'),
    );
    await page.reload();
    await test.planned();
    expect(await nameOnPaper()).toBe("mixed");
    expect(await page.getByRole("checkbox", { name: "Draw 1-black" }).isChecked()).toBe(false);
    expect((await test.jobs()).length).toBe(1);
    const { settings, id } = await test.queue();
    expect(settings.prepare.hiddenLayers).toEqual(["black"]);
    expect(Object.keys(settings.layerPens).sort()).toEqual(["black", "blue"]);
    const drawn = await (await fetch(`${test.server.url}/api/v1/jobs/${id}/drawing`)).text();
    expect(drawn).toBe(MIXED);
  });

  it("a large drawing is on the paper again, too", async () => {
    const { page } = test;
    await test.drop("large", LARGE);
    await page.reload();
    await test.planned();
    expect(await nameOnPaper()).toBe("large");
  });

  it("a file that cannot be read is replaced by the drawing before it", async () => {
    const { page } = test;
    await dropFile(page, "torn.svg", MIXED.slice(0, 300));
    await page.getByText("torn can’t be drawn").waitFor();
    await page.reload();
    await test.planned();
    expect(await nameOnPaper()).toBe("large");
  });
});

describe("while the page is still connecting", () => {
  it("the drawing is there, and a note at Plot says why it is off", async () => {
    const { page } = test;
    let answer = (): void => undefined;
    const mayAnswer = new Promise<void>((resolve) => (answer = resolve));
    await page.route("**/api/v1/events", async (route) => {
      await mayAnswer;
      await route.continue();
    });
    await page.reload();
    await test.planned();
    const note = plotBar(page).getByText("Connecting to plotwright…");
    await note.waitFor();
    await page.setViewportSize({ width: 390, height: 844 });
    await note.waitFor();
    await page.setViewportSize({ width: 1440, height: 900 });
    expect(await plotBar(page).getByRole("button", { name: "Plot", exact: true }).isDisabled()).toBe(true);
    answer();
    await waitForPlotButton(page);
    await note.waitFor({ state: "detached" });
    await page.unroute("**/api/v1/events");
  });
});

describe("another drawing", () => {
  it("starts with one copy", async () => {
    await copies().fill("3");
    await copies().press("Enter");
    await plotBar(test.page).getByRole("button", { name: "Add 3 to queue" }).waitFor();
    await test.drop("mixed", MIXED);
    expect(await copies().inputValue()).toBe("1");
    await plotBar(test.page).getByRole("button", { name: "Add to queue", exact: true }).waitFor();
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
