/** Layers and pens on the page: their settings reach the plan, the job and the board. */
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { VirtualBoard } from "../../../src/index.js";
import { machineOf } from "../../../src/internal.js";
import type { Job } from "../../../src/schema/index.js";
import {
  chooseSample,
  colorCounts,
  dropFile,
  openPanel,
  plotBar,
} from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";
import { ascii } from "../../support/plots/virtual-plots.js";

/** One line of 100 mm in each layer, 20 mm apart: a line's y identifies its layer. */
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="200mm" height="150mm" viewBox="0 0 200 150" fill="none">
  <g inkscape:groupmode="layer" inkscape:label="sea" id="sea"><path stroke="#0000e0" d="M40 20H140"/></g>
  <g inkscape:groupmode="layer" inkscape:label="+s10+h20 sand" id="sand"><path stroke="#e0a000" d="M40 40H140"/></g>
  <g inkscape:groupmode="layer" inkscape:label="%guides" id="guides"><path stroke="#808080" d="M40 60H140"/></g>
  <g inkscape:groupmode="layer" inkscape:label="sun" id="sun"><path stroke="#e00000" d="M40 80H140"/></g></svg>`;
const LAYER_AT: Readonly<Record<number, string>> = { 20: "sea", 40: "sand", 60: "guides", 80: "sun" };

let test: PageTest;

beforeAll(async () => {
  test = await PageTest.open("layers");
  await test.drop("beach", SVG);
  await test.panel("Paper");
  await test.page.getByRole("radio", { name: "True size" }).check();
  await test.panel("Layers");
  await test.group("Layers", "Pens");
  await test.page.locator(".layer-list .layer-name").first().waitFor();
});

afterAll(async () => test.close());

/** Names of the layers from the top down. Words for screen readers are on separate lines before them. */
const namesOn = async (page: Page): Promise<string[]> =>
  (await page.locator(".layer-list .layer-name").allInnerTexts()).map((name) => name.split("\n").at(-1)!);
const rowNames = (): Promise<string[]> => namesOn(test.page);
const planTime = (): Promise<string> => test.page.locator(".plot-time-value").innerText();
const details = (name: string) => test.page.getByRole("button", { name: `Settings of ${name}` });

/** The layers in the order in which a job's file and settings draw them. */
async function drawnOrder(job: Job): Promise<string[]> {
  const { xy, offsets } = await test.strokesOf(job);
  return Array.from({ length: offsets.length - 1 }, (_, i) => LAYER_AT[Math.round(xy[2 * offsets[i] + 1])]);
}

/** The lines that the board has drawn: everything that the server sent to it, replayed on a board of the test. */
async function plottedOrder(): Promise<string[]> {
  const { plotters } = (await (await fetch(`${test.server.url}/api/v1/state`)).json()) as {
    plotters: { id: string }[];
  };
  const log = await (await fetch(`${test.server.url}/api/v1/plotters/${plotters[0].id}/log`)).text();
  const board = new VirtualBoard({
    clock: { nowS: () => 0, after: () => () => undefined },
    machine: machineOf({ machine: "axidraw-v3", customMachine: null }),
    speed: Infinity,
  });
  for (const [, line] of log.matchAll(/^[\d.]+ > (.*)$/gm)) board.receive(ascii(`${line}\r`));
  return (
    board
      .drawn()
      .filter(({ penDown, xy }) => penDown && xy.length > 2)
      // Within the offset of a pen.
      .map(({ xy }) => LAYER_AT[20 * Math.round(xy[1] / 20)] ?? `at ${xy[1]}`)
  );
}

describe("layers on the page", () => {
  it("are listed in drawing order, including those that a % switches off", async () => {
    expect(await rowNames()).toEqual(["sea", "sand", "guides", "sun"]);
    expect(await test.page.getByLabel("Draw guides").isChecked()).toBe(false);
    expect(await drawnOrder(await test.queue())).toEqual(["sea", "sand", "sun"]);
  });

  it("are switched on and off, whatever their names contain", async () => {
    await test.page.getByLabel("Draw guides").check();
    await test.page.getByLabel("Draw sea").uncheck();
    expect(await drawnOrder(await test.queue())).toEqual(["sand", "guides", "sun"]);
    await test.page.getByLabel("Draw guides").uncheck();
    await test.page.getByLabel("Draw sea").check();
    expect(await drawnOrder(await test.queue())).toEqual(["sea", "sand", "sun"]);
  });

  it("are reordered by dragging", async () => {
    const from = (await test.page.getByRole("button", { name: /^Drag sun/ }).boundingBox())!;
    const to = (await test.page.getByRole("button", { name: /^Drag sea/ }).boundingBox())!;
    await test.page.mouse.move(from.x + from.width / 2, from.y + from.height / 2);
    await test.page.mouse.down();
    await test.page.mouse.move(to.x + 5, to.y - 8, { steps: 6 });
    await test.page.mouse.up();
    await test.planned();
    expect(await rowNames()).toEqual(["sun", "sea", "sand", "guides"]);
    expect(await drawnOrder(await test.queue())).toEqual(["sun", "sea", "sand"]);
  });

  it("are reordered by keys, and restored by undo", async () => {
    // Not the dragged one: moving it again soon after belongs to the same undo step.
    await test.page.getByRole("button", { name: /^Drag sea/ }).focus();
    await test.page.keyboard.press("ArrowUp");
    await test.planned();
    expect(await rowNames()).toEqual(["sea", "sun", "sand", "guides"]);
    await test.page.getByRole("button", { name: "Undo" }).click();
    await test.planned();
    expect(await rowNames()).toEqual(["sun", "sea", "sand", "guides"]);
  });

  it("have their own speeds and heights, initialised from their names", async () => {
    const before = await planTime();
    await details("sand").click();
    const speed = test.page.locator(".layer-details").getByLabel("Speed", { exact: true });
    expect(await speed.getAttribute("placeholder")).toBe("20.1");
    expect(
      await test.page
        .locator(".layer-details")
        .getByLabel("Height down", { exact: true })
        .getAttribute("placeholder"),
    ).toBe("20");
    await speed.fill("5");
    await test.field("Draw it").fill("2");
    const job = await test.measured(await test.queue());
    expect(job.settings.motion.layers).toEqual({ sand: { speedMmPerS: 5 } });
    expect(job.settings.prepare.layerRepeats).toEqual({ sand: 2 });
    expect(await drawnOrder(job)).toEqual(["sun", "sea", "sand", "sand"]);
    // 200 mm at 5 mm/s.
    expect(job.stats!.durationS).toBeGreaterThan(40);
    expect(await planTime()).not.toBe(before);
    await test.page.getByRole("button", { name: "Reset “Draw it” to the common value" }).click();
    await test.page.getByRole("button", { name: "Reset “Speed” to the common value" }).click();
    const again = await test.queue();
    expect(again.settings.motion.layers ?? {}).toEqual({});
    expect(await drawnOrder(again)).toEqual(["sun", "sea", "sand"]);
    await details("sand").click();
  });
});

describe("a layer's own fill", () => {
  const distance = () => test.field("Fill areas every");
  const angle = () => test.field("Angle of the lines");
  const reset = () => test.page.getByRole("button", { name: "Reset “Fill areas every” to the common value" });

  it("keeps its angle while another distance is typed, and loses it when it is reset", async () => {
    await details("sand").click();
    await distance().fill("0.5");
    await angle().fill("30");
    await distance().focus();
    for (let k = 0; k < 3; k++) await test.page.keyboard.press("Backspace");
    await test.page.keyboard.type("0.8");
    expect((await test.queue()).settings.prepare.layerHatches).toEqual([
      { layer: "sand", spacingMm: 0.8, angleDeg: 30, cross: false },
    ]);
    await reset().click();
    expect((await test.queue()).settings.prepare.layerHatches).toEqual([]);
    await distance().fill("0.8");
    expect(await angle().inputValue()).toBe("45");
    await reset().click();
    await details("sand").click();
  });
});

describe("pens on the page", () => {
  it("are made of the drawing's colours with one click, and stop the plot between them", async () => {
    await test.page.getByRole("button", { name: "A pen for each colour" }).click();
    await test.planned();
    expect(await test.page.locator(".layer-stop").allInnerTexts()).toEqual([
      "Stop: put in Red",
      "Stop: put in Blue",
      "Stop: put in Orange",
    ]);
    const { settings } = await test.queue();
    expect(settings.pens.map(({ name, color }) => [name, color])).toEqual([
      ["Red", "#e00000"],
      ["Blue", "#0000e0"],
      ["Orange", "#e0a000"],
      ["Grey", "#808080"],
    ]);
    expect(Object.keys(settings.layerPens).sort()).toEqual(["guides", "sand", "sea", "sun"]);
  });

  it("show the drawing in their own colours and widths", async () => {
    await test.page.getByRole("button", { name: "Settings of the pen Red" }).click();
    await test.field("Line width").fill("4");
    await test.look("Pen");
    await test.page.getByLabel("Colour: Red").fill("#00c000");
    await test.drawn();
    // The legend lies over the canvas, in the same colours.
    await test.page
      .locator(".looks")
      .evaluate((looks: HTMLElement) => looks.style.setProperty("opacity", "0"));
    const counts = await colorCounts(test.page.getByRole("img", { name: "Preview", exact: true }));
    const ofChannel = (shift: number): number =>
      [...counts].reduce((sum, [rgb, count]) => {
        const [own, ...others] = [shift, (shift + 8) % 24, (shift + 16) % 24].map((by) => (rgb >> by) & 255);
        return own > Math.max(...others) + 60 ? sum + count : sum;
      }, 0);
    const [blue, green] = [ofChannel(0), ofChannel(8)];
    // Equally long, one 4 mm wide and the other 0.4.
    expect(blue).toBeGreaterThan(100);
    expect(green).toBeGreaterThan(4 * blue);
  });

  it("offsets of pens are corrected in the job, while the page shows what lands on paper", async () => {
    await test.field("Draws too far right by").fill("1.5");
    await test.field("Draws too far down by").fill("-0.5");
    const { xy } = await test.strokesOf(await test.queue());
    expect([...xy.subarray(0, 2)].map((mm) => Math.round(mm * 100) / 100)).toEqual([38.5, 80.5]);
    await test.page.getByRole("button", { name: "Settings of the pen Red" }).click();
  });

  it("are assigned to layers one by one, with a stop by hand where set", async () => {
    await test.page.getByLabel("Pen for sand").selectOption({ label: "Blue" });
    await test.planned();
    expect(await test.page.locator(".layer-stop").allInnerTexts()).toEqual([
      "Stop: put in Red",
      "Stop: put in Blue",
    ]);
    await details("sand").click();
    await test.page.getByRole("radio", { name: "Always" }).check();
    await test.planned();
    expect(await test.page.locator(".layer-stop").count()).toBe(3);
    const { settings } = await test.queue();
    expect(settings.layerStops).toEqual({ sand: true });
    expect(settings.layerPens["sand"]).toBe(settings.layerPens["sea"]);
    await test.page.getByRole("radio", { name: "Automatic" }).check();
    await details("sand").click();
  });

  it("are restored by a preset, including their order", async () => {
    const kept = (await test.queue()).settings;
    await test.group("Speed", "Presets");
    await test.field("Name of this preset").fill("Beach");
    await test.page.getByRole("button", { name: "Save", exact: true }).click();
    await test.panel("Layers");
    await test.page.getByLabel("Pen for sea").selectOption({ label: "Any pen" });
    await test.page.getByRole("button", { name: "Order as in the file" }).click();
    await test.planned();
    expect(await rowNames()).toEqual(["sea", "sand", "guides", "sun"]);
    await test.panel("Speed");
    await test.page.getByRole("button", { name: "Beach", exact: true }).click();
    expect((await test.queue()).settings).toEqual(kept);
    await test.panel("Layers");
  });

  it("draw an alignment mark, each as its own job", async () => {
    await test.page.getByRole("button", { name: "Settings of the pen Red" }).click();
    await test.page.getByLabel("Corner of the mark").selectOption({ label: "Bottom right" });
    await test.page.getByRole("button", { name: "Plot alignment mark with this pen" }).click();
    const mark = await waitForJob((job) => job.name === "Alignment mark, Red" && job.state === "done");
    const { xy } = await test.strokesOf(mark);
    // A cross of 10 mm about (287, 200), corrected by the pen's offset.
    expect([...xy].map((mm) => Math.round(mm * 100) / 100)).toEqual([
      280.5, 200.5, 290.5, 200.5, 285.5, 195.5, 285.5, 205.5,
    ]);
    await test.page.getByRole("button", { name: "Settings of the pen Red" }).click();
  });

  it("are waited for while plotting, and the board draws the layers in the chosen order", async () => {
    await plotBar(test.page).getByRole("button", { name: "Plot", exact: true }).click();
    // The plot also waits for the first pen: the holder may have either of the two.
    for (const pen of ["Red", "Blue"]) {
      const held = await waitForJob(({ wait }) => wait !== null && wait.penName === pen);
      expect(held.state).toBe("paused");
      const answer = await fetch(`${test.server.url}/api/v1/jobs/${held.id}/resume`, { method: "POST" });
      expect(answer.ok).toBe(true);
    }
    await waitForJob((job) => job.settings.pens.length > 1 && job.state === "done");
    expect((await plottedOrder()).slice(-3)).toEqual(["sun", "sea", "sand"]);
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});

/** Throws, listing the jobs, if none reaches the expected state. */
async function waitForJob(isIt: (job: Job) => boolean): Promise<Job> {
  for (let tries = 0; tries < 600; tries++) {
    const found = (await test.jobs()).find(isIt);
    if (found) return found;
    await test.page.waitForTimeout(100);
  }
  const states = (await test.jobs()).map(({ name, state, message }) => `${name} ${state} ${message ?? ""}`);
  throw new Error(`no such job among ${states.join(", ")}`);
}

describe("layers on a phone", () => {
  it("are reordered by finger, and nothing is too small for one", async () => {
    const context = await test.browser.newContext({
      viewport: { width: 390, height: 844 },
      hasTouch: true,
      isMobile: true,
    });
    const page = await context.newPage();
    await page.goto(test.server.url);
    await chooseSample(page);
    await dropFile(page, "beach.svg", SVG);
    await openPanel(page, "Layers");
    await page.getByRole("button", { name: /^Drag sun/ }).waitFor({ state: "attached" });
    const before = await namesOn(page);
    expect(before.length).toBeGreaterThan(1);
    const grips = page.getByRole("button", { name: /^Drag / });
    await grips.nth(1).scrollIntoViewIfNeeded();
    const from = (await grips.nth(1).boundingBox())!;
    const to = (await grips.nth(0).boundingBox())!;
    const session = await context.newCDPSession(page);
    const touch = (type: "touchStart" | "touchMove" | "touchEnd", x: number, y: number) =>
      session.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x, y }] });
    const x = from.x + from.width / 2;
    const [start, end] = [from.y + from.height / 2, to.y + 2];
    await touch("touchStart", x, start);
    for (let k = 1; k <= 5; k++) await touch("touchMove", x, start + ((end - start) * k) / 5);
    await touch("touchEnd", x, end);
    await expect.poll(async () => (await namesOn(page)).slice(0, 2)).toEqual([before[1], before[0]]);
    const sizes = await page
      .locator(".layer-list button, .layer-list label, .layer-pen")
      .evaluateAll((all) =>
        all.map((one) => one.getBoundingClientRect()).map(({ width, height }) => Math.min(width, height)),
      );
    expect(Math.min(...sizes)).toBeGreaterThanOrEqual(40);
    await context.close();
  });
});
