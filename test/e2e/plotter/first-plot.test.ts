/** The first minutes with a new plotter on a real port: which one it is, its corner, heights, a test mark, a plot. */
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { machineById } from "../../../src/index.js";
import type { MachineId } from "../../../src/internal.js";
import { snapshotSchema, type Plotter } from "../../../src/schema/index.js";
import { openView, plotBar } from "../../support/browser/page-actions.js";
import { PageTest } from "../../support/browser/page-test.js";
import { PtyBoard } from "../../support/processes/pty-board.js";
import { PtyGrbl, type GrblOptions } from "../../support/processes/pty-grbl.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">
  <path fill="none" stroke="#000" d="M5 5H55V35H5Z"/></svg>`;

interface Counted {
  clickCount: number;
  /** What was scrolled, and how far. */
  scrolled: string[];
}

interface NewPlotter {
  readonly machine: MachineId;
  open(): Promise<PtyBoard | PtyGrbl>;
  readonly homesItself: boolean;
  readonly clicks: number;
  /** It has no picture: it is chosen in the list of all models. */
  readonly isInList?: boolean;
  /** Its controller plans by itself, so that measuring how it rings is of no use. */
  readonly plansItself: boolean;
}

const ebb = (machine: MachineId, firmware: string): Pick<NewPlotter, "machine" | "open" | "plansItself"> => ({
  machine,
  open: () => PtyBoard.open({ machine, firmware, speed: 10 }),
  plansItself: false,
});
const grbl = (
  machine: MachineId,
  face: NonNullable<GrblOptions["face"]>,
): Pick<NewPlotter, "machine" | "open" | "plansItself"> => ({
  machine,
  open: () => PtyGrbl.open({ machine: machineById(machine), face, speed: 10 }),
  plansItself: true,
});

/**
 * Clicks: model, home (without switches: motors off and "in its corner"), height, test line, plot. A model that is chosen in
 * the list of all takes two more than are counted.
 */
const NEW: readonly NewPlotter[] = [
  { ...ebb("axidraw-v3", "2.8.1"), homesItself: false, clicks: 6 },
  { ...ebb("nextdraw-8511", "3.0.3"), homesItself: true, clicks: 5 },
  { ...grbl("idraw-h-a3", "DrawCore"), homesItself: false, clicks: 6 },
  { ...grbl("grbl-servo", "1.1"), homesItself: false, clicks: 5, isInList: true },
];

const plotterOf = async ({ server }: PageTest): Promise<Plotter> =>
  snapshotSchema.parse(await (await fetch(`${server.url}/api/v1/state`)).json()).plotters[0];

describe.each(NEW)("a new $machine", ({ machine, open, homesItself, clicks, isInList, plansItself }) => {
  const { name } = machineById(machine);
  let board: PtyBoard | PtyGrbl;
  let test: PageTest;

  beforeAll(async () => {
    board = await open();
    test = await PageTest.firstVisit(`first-plot-${machine}`, {}, ["--device", board.path]);
    await test.page.evaluate(() => {
      const counted = window as unknown as Counted;
      counted.clickCount = 0;
      counted.scrolled = [];
      addEventListener("pointerdown", () => counted.clickCount++, { capture: true });
      const note = ({ target }: Event): void => {
        const element = target instanceof Element ? target : document.documentElement;
        counted.scrolled.push(`${element.className} ${element.scrollTop}`);
      };
      addEventListener("scroll", note, { capture: true });
    });
    await test.drop("box", SVG);
  });
  afterAll(async () => {
    await test.close();
    await board.close();
  });

  const guide = () => test.page.getByRole("region", { name: "First plot with this plotter" });
  const press = (label: string) =>
    guide().getByRole("button", { name: label, exact: true }).and(test.page.locator(":enabled")).click();
  const plotter = () => plotterOf(test);

  it("is chosen by its picture or in the list, and a step is ticked only when it is done", async () => {
    const question = guide().getByRole("group", { name: "Which plotter is this?" });
    await question.waitFor();
    const ticks = () => guide().locator("li[data-done]").count();
    expect(await ticks()).toBe(0);
    expect(await question.locator("svg.machine-picture").count()).toBe(7);
    if (isInList) await question.getByLabel("All models").selectOption({ label: name });
    else await press(name);
    await expect.poll(async () => (await plotter()).machine).toBe(machine);
    await guide().getByRole("button", { name: "Another model…" }).waitFor();
    expect(await ticks()).toBe(1);
    if (homesItself) {
      await press("Home");
      await guide().getByRole("button", { name: "Stop" }).waitFor();
      expect(await ticks()).toBe(1);
    } else {
      // The buttons are in the order of the words.
      const buttons = await guide().locator(".home-buttons button").allInnerTexts();
      expect(buttons).toEqual(["Motors off", "The carriage is in its corner"]);
      await press("Motors off");
      expect(await ticks()).toBe(1);
      await press("The carriage is in its corner");
    }
    await guide().getByText("The carriage is home.").waitFor();
    expect(await ticks()).toBe(2);
    await expect.poll(async () => [(await plotter()).xMm, (await plotter()).yMm]).toEqual([0, 0]);
  });

  it("draws its first plot after few clicks, without scrolling", async () => {
    const { page } = test;
    // Another height than the default of 30 %, so that the pen moves.
    const slider = guide().locator(".pen-heights input[type=range]").nth(1);
    const box = (await slider.boundingBox())!;
    await page.mouse.click(box.x + box.width * 0.2, box.y + box.height / 2);
    await expect
      .poll(async () => [(await plotter()).penUp, (await plotter()).connection])
      .toEqual([false, "idle"]);
    await press("Draw a test line");
    await expect.poll(() => guide().locator("li[data-done]").count()).toBe(4);
    await guide().getByText("Press Plot.").waitFor();
    await plotBar(page)
      .getByRole("button", { name: "Plot", exact: true })
      .and(page.locator(":enabled"))
      .click();
    await expect.poll(async () => (await test.jobs())[0]?.state).toBe("done");
    const { clickCount, scrolled } = await page.evaluate(() => {
      const { clickCount, scrolled } = window as unknown as Counted;
      return { clickCount, scrolled };
    });
    expect({ clickCount, scrolled }).toEqual({ clickCount: clicks, scrolled: [] });
    const { drawn } = await board.report();
    // The test line, and the box.
    expect(drawn.filter(({ penDown, xy }) => penDown && xy.length > 2).length).toBeGreaterThanOrEqual(2);
  });

  it("is offered the sheets that make it faster, and no longer when it says no", async () => {
    const { page } = test;
    await openView(page, "Prepare");
    const next = page.getByRole("region", { name: "Next: faster plots" });
    await next.getByRole("button", { name: "Plot the pen sheet" }).waitFor();
    if (plansItself) expect(await page.getByRole("button", { name: "Measure ringing…" }).count()).toBe(0);
    else {
      await next.getByRole("button", { name: "Measure ringing…" }).click();
      const dialog = page.getByRole("dialog", { name: "Measure ringing" });
      await dialog.getByRole("button", { name: "Plot the ringing sheet" }).waitFor();
      await page.keyboard.press("Escape");
    }
    await next.getByRole("button", { name: "Hide these measurements" }).click();
    await next.waitFor({ state: "detached" });
    expect(test.complaints).toEqual([]);
  });
});

describe("a new plotter, by keyboard alone", () => {
  let board: PtyBoard;
  let test: PageTest;

  beforeAll(async () => {
    board = await PtyBoard.open({ machine: "axidraw-v3", firmware: "2.8.1", speed: 20 });
    test = await PageTest.firstVisit("first-plot-keys", {}, ["--device", board.path]);
  });
  afterAll(async () => {
    await test.close();
    await board.close();
  });

  const focused = (): Promise<string> =>
    test.page.evaluate(() => {
      const element = document.activeElement;
      if (!element || element === document.body) return "nothing";
      const label = (element as HTMLInputElement).labels?.[0]?.textContent;
      return (element.getAttribute("aria-label") ?? label ?? element.textContent ?? "").trim();
    });
  /** Presses Tab until a control whose name begins so has the focus. */
  const tabTo = async (name: string): Promise<void> => {
    for (let stops = 0; stops < 60; stops++) {
      if ((await focused()).startsWith(name)) return;
      await test.page.keyboard.press("Tab");
    }
    throw new Error(`Tab did not reach "${name}": ${await focused()} has the focus`);
  };
  const enter = async (name: string): Promise<void> => {
    await tabTo(name);
    await test.page.keyboard.press("Enter");
  };
  const ticks = () =>
    test.page.getByRole("region", { name: "First plot with this plotter" }).locator("li[data-done]").count();
  const plotter = () => plotterOf(test);

  it("gets its model, its corner, its heights and a test mark, and draws its first plot", async () => {
    const { page } = test;
    await page.getByRole("group", { name: "Which plotter is this?" }).waitFor();
    await enter("AxiDraw V3");
    await expect.poll(ticks).toBe(1);
    // Each step leaves the focus where the next one follows, never on nothing.
    await expect.poll(focused).not.toBe("nothing");
    await enter("Motors off");
    await expect.poll(plotter).toMatchObject({ motorsOn: false, connection: "idle" });
    await enter("The carriage is in its corner");
    await expect.poll(ticks).toBe(2);
    await expect.poll(focused).not.toBe("nothing");
    await tabTo("Height down");
    await page.keyboard.press("ArrowUp");
    await enter("Pen down");
    await expect.poll(ticks).toBe(3);
    await expect.poll(focused).toBe("Pen down");
    // The line is off until the pen has arrived.
    await expect.poll(plotter).toMatchObject({ penUp: false, connection: "idle" });
    await test.page
      .getByRole("button", { name: "Draw a test line" })
      .and(test.page.locator(":enabled"))
      .waitFor();
    await enter("Draw a test line");
    await expect.poll(ticks).toBe(4);
    await tabTo("Hello");
    await page.keyboard.press("Enter");
    await test.planned();
    // The sheet has the focus of the sample that is gone.
    await expect.poll(focused).toMatch(/^Arrow keys move the paper/);
    const plot = plotBar(page).getByRole("button", { name: "Plot", exact: true });
    await plot.and(page.locator(":enabled")).waitFor();
    await enter("Plot");
    await expect
      .poll(async () => (await test.jobs())[0]?.state, { timeout: 60_000 })
      .toMatch(/plotting|done/);
    expect(test.complaints).toEqual([]);
  });
});
