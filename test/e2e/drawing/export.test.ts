/** Saving what will be plotted: each file, read back, equals the plot. */
import { text as textOf } from "node:stream/consumers";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import {
  DEFAULT_PREPARE,
  importDrawing,
  importSvg,
  plan,
  prepare,
  VirtualBoard,
  type PrepareSettings,
  type StrokeSet,
} from "../../../src/index.js";
import { machineOf, prepareSettingsOf, withLayerCodes } from "../../../src/internal.js";
import type { Job } from "../../../src/schema/index.js";
import { PageTest } from "../../support/browser/page-test.js";
import { ascii } from "../../support/plots/virtual-plots.js";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="200mm" height="150mm" viewBox="0 0 200 150" fill="none" stroke="#0000e0">
  <g inkscape:groupmode="layer" inkscape:label="sea" id="sea"><path d="M20 20C60 0 100 60 150 30"/><path d="M20 50H150L20 60"/></g>
  <g inkscape:groupmode="layer" inkscape:label="sun" id="sun" stroke="#e00000"><circle cx="100" cy="100" r="30"/></g></svg>`;
/** The file unchanged: nothing fitted, joined, clipped or reordered. */
const AS_IT_IS: PrepareSettings = {
  ...DEFAULT_PREPARE,
  marginMm: 0,
  fit: false,
  clipToMargins: false,
  joinMm: 0,
  order: "none",
};

let test: PageTest;
let job: Job;
let strokes: StrokeSet;

beforeAll(async () => {
  test = await PageTest.open("export");
  await test.drop("beach", SVG);
  await test.group("Layers", "Pens");
  await test.page.getByRole("button", { name: "A pen for each colour" }).click();
  await test.group("Layers", "Pens", false);
  await test.page.getByRole("button", { name: "Settings of sun" }).click();
  await test.page.locator(".layer-details").getByLabel("Speed", { exact: true }).fill("20.1");
  await test.page.getByRole("button", { name: "Settings of sun" }).click();
  job = await test.queue();
  strokes = await test.strokesOf(job);
  await test.group("Drawing", "Save to a file");
});

afterAll(async () => test.close());

async function saved(what: string): Promise<{ name: string; text: string }> {
  const [download] = await Promise.all([
    test.page.waitForEvent("download"),
    test.page.getByRole("button", { name: `Save: ${what}` }).click(),
  ]);
  return { name: download.suggestedFilename(), text: await textOf(await download.createReadStream()) };
}

function expectSameStrokes(back: StrokeSet): void {
  expect([...back.offsets]).toEqual([...strokes.offsets]);
  expect([...back.layer]).toEqual([...strokes.layer]);
  for (const [k, mm] of back.xy.entries()) expect(Math.abs(mm - strokes.xy[k])).toBeLessThan(1e-3);
}

describe("saving", () => {
  it("writes an SVG that draws the same strokes in the same order, with the layers' settings in their names", async () => {
    const { name, text } = await saved("Prepared drawing as SVG");
    expect(name).toBe("beach.svg");
    expectSameStrokes(prepare(await importSvg(text), AS_IT_IS).strokes);
    const labels = [...text.matchAll(/inkscape:label="([^"]*)"/g)].map(([, label]) => label);
    // Both layers begin with a stop: the first pen is asked for too.
    expect(labels).toEqual(["!sea", "!+s10sun"]);
  });

  it("writes polylines as JSON that can be opened again", async () => {
    const { name, text } = await saved("Polylines as JSON");
    expect(name).toBe("beach.json");
    expectSameStrokes(prepare(await importDrawing(name, text), AS_IT_IS).strokes);
  });

  it.each(["3.0.3", "2.5.3"])(
    "writes commands for firmware %s that draw the plan and end at home",
    async (firmware) => {
      await test.field("Firmware of the board").selectOption(firmware);
      const { text } = await saved("Commands for the board");
      const lines = text.trim().split("\n");
      expect(lines[0]).toBe("EM,1,1");
      expect(lines.at(-1)).toBe("EM,0,0");
      const machine = machineOf(job.settings);
      const board = new VirtualBoard({
        clock: { nowS: () => 0, after: () => () => undefined },
        machine,
        firmware,
        speed: Infinity,
        servo: {},
      });
      const errors: string[] = [];
      board.onSend((bytes) => {
        const reply = String.fromCharCode(...bytes);
        if (reply.includes("!")) errors.push(reply.trim());
      });
      for (const line of lines.slice(0, -1)) board.receive(ascii(`${line}\r`));
      expect(errors).toEqual([]);
      const { steps1, steps2 } = board.state();
      expect([steps1, steps2]).toEqual([0, 0]);
      const drawn = board.drawn().filter(({ penDown, xy }) => penDown && xy.length > 2);
      expect(drawn.length).toBe(strokes.offsets.length - 1);
      drawn.forEach(({ xy }, i) => {
        const [first, last] = [2 * strokes.offsets[i], 2 * strokes.offsets[i + 1] - 2];
        expect(Math.hypot(xy[0] - strokes.xy[first], xy[1] - strokes.xy[first + 1])).toBeLessThan(0.05);
        const end = xy.length - 2;
        expect(Math.hypot(xy[end] - strokes.xy[last], xy[end + 1] - strokes.xy[last + 1])).toBeLessThan(0.05);
      });
      const { motion, pen } = withLayerCodes(job.settings, strokes.layers);
      const { totalS } = plan(strokes, motion, pen, { machine });
      expect(board.state().boardS).toBeGreaterThan(0.98 * totalS);
      expect(board.state().boardS).toBeLessThan(1.05 * totalS + 1);
    },
  );

  it("uses the current paper, not an earlier one", async () => {
    await test.panel("Paper");
    await test.page.getByRole("radio", { name: "True size" }).check();
    await test.planned();
    await test.panel("Drawing");
    const { text } = await saved("Prepared drawing as SVG");
    const now = prepare(await importSvg(SVG), prepareSettingsOf((await test.queue()).settings)).strokes;
    const back = prepare(await importSvg(text), AS_IT_IS).strokes;
    expect(back.xy.length).toBe(now.xy.length);
    for (const [k, mm] of back.xy.entries()) expect(Math.abs(mm - now.xy[k])).toBeLessThan(1e-3);
  });

  it("logs no error in the browser's console", () => {
    expect(test.complaints).toEqual([]);
  });
});
