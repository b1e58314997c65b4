/** Plots of arcs: their time, stops in their middle, refused ones, soft limits. */
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import { grblCommandsOf } from "../../../../src/drivers/grbl/grbl-job.js";
import type { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { FACES } from "../../../../src/drivers/grbl/virtual/faces.js";
import { DEFAULT_MOTION, DEFAULT_PEN, planJob } from "../../../../src/index.js";
import { isPlannedAlike } from "../../../../src/internal.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { circle, ROUND_DRAWING } from "../../../support/drawings/round-drawing.js";
import { KeepingPlanner } from "../../../support/drawings/stop-truth.js";
import { GRBL } from "../../../support/machines/machine.js";
import { newPlotter, RefusedPlanner, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { cases } from "../../../support/runs/full-run.js";
import { startAfter } from "../../../support/plots/start-after.js";

const MOST_MM = 0.05;
const PLOT_S = 9;
const LIFT_S = 0.25;
/** What a Grbl may have accepted and not drawn, or drawn and not accepted, when it restarts: two arcs and its queue. */
const UNSURE_MM = 40;

const planOf = (firmware?: string, machine: typeof GRBL = GRBL) =>
  planJob({ strokes: ROUND_DRAWING }, { motion: DEFAULT_MOTION, pen: DEFAULT_PEN }, machine, { firmware });
const linesOf = (job: ReturnType<typeof planJob>): readonly string[] => grblCommandsOf(job.commands()).lines;
const isArc = (line: string): boolean => /^G[23]/.test(line);

describe.each(FACES.filter((face) => face !== "DrawCore"))("arcs on a %s", (face) => {
  it("are drawn where the plan says, in its time", async () => {
    const { world, board, begin } = await newPlotter({ face });
    const planner = new KeepingPlanner(ROUND_DRAWING);
    const run = await begin(planner);
    const startS = world.nowS();
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    const [plot] = planner.plots;
    expect(grblCommandsOf(plot.commands).lines.filter(isArc).length).toBeGreaterThan(20);
    // The pen goes up before the plan begins.
    const lateS = world.nowS() - startS - LIFT_S - plot.trajectory.totalS;
    expect(Math.abs(lateS)).toBeLessThan(0.01 * plot.trajectory.totalS);
    const { gapMm, overlapMm, awayMm } = compareDrawn(ROUND_DRAWING, board.drawn());
    expect(Math.max(gapMm, overlapMm, awayMm)).toBeLessThan(MOST_MM);
    expect(board.state()).toMatchObject({ starvedCount: 0, lostCount: 0 });
  });

  it("go on in their middle after each of many emergency stops, and nothing is left out", async () => {
    const random = seeded(5);
    const { world, board, begin } = await newPlotter({ face });
    const run = await begin(new LocalPlanner(ROUND_DRAWING));
    for (let i = 0; i < cases(40, 8); i++) {
      await world.advance((PLOT_S / cases(40, 8)) * (0.5 + random()));
      await world.run(run.emergencyStop());
      await world.run(run.resume());
    }
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    const { gapMm, awayMm } = compareDrawn(ROUND_DRAWING, board.drawn());
    expect(gapMm).toBeLessThan(MOST_MM);
    expect(awayMm).toBeLessThan(MOST_MM);
  });

  it("are drawn again only from the last certain place after an alarm or a restart", async () => {
    for (const fault of [
      (board: VirtualGrbl) => board.stopWith(1),
      (board: VirtualGrbl) => board.restart(),
    ]) {
      const { world, board, begin, within } = await newPlotter({ face });
      const journal: JournalEntry[] = [];
      const record = (entry: JournalEntry): void => void journal.push(entry);
      const run = await begin(new LocalPlanner(ROUND_DRAWING), { journal: { record } });
      await world.advance(2);
      expect(board.state().penUp).toBe(false);
      fault(board);
      const ended = await within(run.finished);
      expect(ended).toMatch(/^board-error/);
      // As the person is asked to.
      board.pushHome();
      if (String(ended).includes("The height of the pen is lost")) board.pushPen(0);
      const rest = await begin(new LocalPlanner(ROUND_DRAWING), {
        ...startAfter(journal.at(-1)),
        held: false,
      });
      expect(await within(rest.finished)).toEqual({ kind: "done" });
      const { gapMm, overlapMm } = compareDrawn(ROUND_DRAWING, board.drawn());
      expect(gapMm).toBeLessThan(MOST_MM);
      expect(overlapMm).toBeGreaterThan(0);
      expect(overlapMm).toBeLessThan(UNSURE_MM);
    }
  });
});

describe("a refused arc", () => {
  const indices = linesOf(planOf()).flatMap((line, i) => (isArc(line) ? [i] : []));

  it("stops the plot where home is still known, and nothing is left out when it is resumed", async () => {
    const step = Math.ceil(indices.length / cases(indices.length, 8));
    for (const index of indices.filter((_, k) => k % step === 0)) {
      const { board, driver, begin, within } = await newPlotter();
      const journal: JournalEntry[] = [];
      const record = (entry: JournalEntry): void => void journal.push(entry);
      const run = await begin(new RefusedPlanner(ROUND_DRAWING, index), { journal: { record } });
      expect(await within(run.finished)).toMatch(/^board-error: The Grbl refused G5X1/);
      expect(driver.state.xMm).not.toBeNull();
      const rest = await begin(new LocalPlanner(ROUND_DRAWING), {
        ...startAfter(journal.at(-1)),
        held: false,
      });
      expect(await within(rest.finished)).toEqual({ kind: "done" });
      expect({ index, ...compareDrawn(ROUND_DRAWING, board.drawn()) }.gapMm).toBeLessThan(MOST_MM);
    }
  });

  it("of a Grbl whose profile says arcs tells what to change", async () => {
    const { begin, within } = await newPlotter({ takesArcs: false }, GRBL);
    expect(await within((await begin()).finished)).toMatch(
      /^board-error: The Grbl refused G3\S+ with error:20 .* switch off in the machine's profile that it draws arcs\.$/,
    );
  });
});

describe("the plan", () => {
  it("for a firmware that is known to refuse arcs has none", () => {
    expect(linesOf(planOf("DrawCore 2.09")).some(isArc)).toBe(false);
    for (const firmware of ["Grbl 1.1h", "grblHAL 1.1f", "FluidNC 3.7.16"]) {
      expect(linesOf(planOf(firmware)).some(isArc)).toBe(true);
      expect(isPlannedAlike(GRBL, DEFAULT_PEN, firmware, null)).toBe(true);
      expect(isPlannedAlike(GRBL, DEFAULT_PEN, firmware, "DrawCore 2.09")).toBe(false);
    }
  });

  it("follows the arc tolerance of the connected Grbl ($12)", async () => {
    const countWith = async (tolerance: number): Promise<number> => {
      const { begin, within } = await newPlotter({ settings: { 12: tolerance } });
      const planner = new KeepingPlanner(ROUND_DRAWING);
      expect(await within((await begin(planner)).finished)).toEqual({ kind: "done" });
      const { moveCounts } = grblCommandsOf(planner.plots[0].commands);
      return moveCounts.reduce((sum, count) => sum + count, 0);
    };
    expect(await countWith(0.005)).toBeLessThan(0.6 * (await countWith(0.001)));
  });

  it.each([0, 0.02, 0.05])("for an arc tolerance of %d has no arcs, which would stray", async (tolerance) => {
    const { board, begin, within } = await newPlotter({ settings: { 12: tolerance } });
    const planner = new KeepingPlanner(ROUND_DRAWING);
    expect(await within((await begin(planner)).finished)).toEqual({ kind: "done" });
    expect(grblCommandsOf(planner.plots[0].commands).lines.some(isArc)).toBe(false);
    expect(compareDrawn(ROUND_DRAWING, board.drawn()).awayMm).toBeLessThan(MOST_MM);
  });

  it("keeps arcs near the drawing on a machine with coarse steps", () => {
    // A gap between curve and chords that only finer steps allow.
    const strokes = strokesOf(circle(40, 40, 11, 0, 0.9, 52).flat());
    const arcCount = (stepsPerMm: number): number =>
      linesOf(
        planJob({ strokes }, { motion: DEFAULT_MOTION, pen: DEFAULT_PEN }, { ...GRBL, stepsPerMm }),
      ).filter(isArc).length;
    expect(arcCount(250)).toBeGreaterThan(0);
    expect(arcCount(20)).toBe(0);
  });

  it("for other senders has arcs too", () => {
    const lines = planOf().lines();
    expect(lines.filter(isArc).length).toBeGreaterThan(20);
    for (const line of lines) expect(line.length).toBeLessThan(80);
  });
});

describe("soft limits ($20=1)", () => {
  const low = { ...GRBL, controller: { ...GRBL.controller, penUpZMm: 0, penDownZMm: -5 } };
  const settings = { ...SETTINGS, customMachine: low };
  /** Only its middle is to the left of X 10. */
  const left = strokesOf(circle(20, 40, 12, 0.35, 0.3, 60).flat());

  it("count the whole arc, not only its ends", async () => {
    const { board, begin, within } = await newPlotter({ settings: { 20: 1 } }, low);
    const run = await begin(new LocalPlanner(left), {}, settings);
    expect(await within(run.finished)).toMatch(/^out-of-bounds: This needs X from 0 to 12\.\d+ mm/);
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0 });
  });
});
