/**
 * Whole drawings through serialport and a real pseudo-terminal to a board in another process: what the board
 * reports as drawn is compared with the file.
 */
import { readFileSync } from "node:fs";
import { afterEach, describe, expect, it } from "vitest";
import { NodePlotter } from "../support/plots/node-plotter.js";
import { importSvg, prepare, type Prepared } from "../../src/index.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../src/schema/index.js";
import { LocalPlanner } from "../support/plots/local-planner.js";
import { PtyBoard, type BoardReport } from "../support/processes/pty-board.js";
import { farthest, SegmentGrid } from "../support/drawings/segment-grid.js";

const SPEED = 150;
const SAMPLES = ["hello-paper", "harmonograph", "three-colour-hills"];
/**
 * At this speed the host is late for some commands. A tip that is on its way down then lands up to 0.1 mm before its
 * stroke, so here the carriage waits for the pen. `pen-flight-faults.test.ts` plots in flight at the board's own speed.
 */
const SETTINGS: PlotSettings = {
  ...DEFAULT_PLOT_SETTINGS,
  pen: { ...DEFAULT_PLOT_SETTINGS.pen, overlap: "off" },
};
/** As fine as the settings allow: this stands in for the file itself. */
const FINE = { ...DEFAULT_PLOT_SETTINGS.prepare, flattenMm: 0.001, joinMm: 0, order: "none" as const };

const sample = (name: string): string =>
  readFileSync(new URL(`../../samples/${name}.svg`, import.meta.url), "utf8");

function* pointsOf(prepared: Prepared): Iterable<readonly [number, number]> {
  const { xy } = prepared.strokes;
  for (let i = 0; i < xy.length; i += 2) yield [xy[i], xy[i + 1]];
}

function gridOf(prepared: Prepared): SegmentGrid {
  const { xy, offsets } = prepared.strokes;
  const grid = new SegmentGrid();
  for (let s = 0; s + 1 < offsets.length; s++) grid.addPolyline(xy, 2 * offsets[s], 2 * offsets[s + 1]);
  return grid;
}

const drawnLines = (report: BoardReport): readonly (readonly number[])[] =>
  report.drawn.filter(({ penDown }) => penDown).map(({ xy }) => xy);

function* drawnPoints(report: BoardReport): Iterable<readonly [number, number]> {
  for (const xy of drawnLines(report)) {
    for (let i = 0; i < xy.length; i += 2) yield [xy[i], xy[i + 1]];
  }
}

/** The guaranteed tolerance: corner deviation, merge tolerance and one microstep. */
const MAX_OFF_MM = 0.025 + 0.02 + 1 / 80;

const open: { close(): Promise<void> }[] = [];
afterEach(async () => {
  for (const thing of open.splice(0).reverse()) await thing.close();
});

describe("a drawing on a board behind a pseudo-terminal", () => {
  it.each(SAMPLES)("%s matches the file, and the motors end where they should", async (name) => {
    const board = await PtyBoard.open({ speed: SPEED });
    open.push(board);
    const driver = new NodePlotter({ device: board.path, virtualSpeed: SPEED });
    open.push(driver);
    await driver.start();
    expect(driver.state).toMatchObject({ connection: "idle", kind: "serial", firmware: "2.8.1" });

    const drawing = await importSvg(sample(name));
    const planner = new LocalPlanner(prepare(drawing, SETTINGS.prepare).strokes);
    const run = await driver.plot(planner, SETTINGS);
    expect(await run.finished).toEqual({ kind: "done" });

    // `finished` has compared the board's step counters with the prediction; the last position is home.
    const report = await board.report();
    expect([report.state.steps1, report.state.steps2]).toEqual([0, 0]);
    expect(report.state.penUp).toBe(true);

    const source = prepare(drawing, FINE);
    const drawn = new SegmentGrid();
    for (const xy of drawnLines(report)) drawn.addPolyline(xy);
    expect(farthest(drawnPoints(report), gridOf(source))).toBeLessThan(MAX_OFF_MM);
    expect(farthest(pointsOf(source), drawn)).toBeLessThan(MAX_OFF_MM);
  });
});
