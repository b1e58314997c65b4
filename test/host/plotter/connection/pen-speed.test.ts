/**
 * The pen's servo moves as fast as the settings ask, by hand and in plots, and has arrived when the carriage
 * starts.
 */
import { describe, expect, it } from "vitest";
import { NodePlotter } from "../../../support/plots/node-plotter.js";
import { DEFAULT_MOTION, DEFAULT_PEN, machineById, plan, type PenSettings } from "../../../../src/index.js";
import { penCommand, penMoveOf } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { strokeSetOf, type Point } from "../../../support/drawings/arbitraries.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { FastBoard } from "../../../support/plots/virtual-plots.js";
import { virtualBoardOf } from "../../../support/plots/virtual-plotter.js";

/** One on the standard servo output (SP), one with a brushless lift (S2). */
const MACHINES = ["axidraw-v3", "nextdraw-8511"];
const WAITING: PenSettings = { ...DEFAULT_PEN, overlap: "off" };
const GENTLE: PenSettings = {
  ...WAITING,
  extraLiftMs: 60,
  extraDropMs: 90,
  liftPctPerS: 150,
  dropPctPerS: 20,
};
const WAY_PCT = GENTLE.upPct - GENTLE.downPct;
/** A servo moves in frames, and in each of them by a whole number of units. */
const FRAME_S = 0.024;
const UNIT_PCT_PER_S: Readonly<Record<string, number>> = {
  "axidraw-v3": 100 / 20_500 / 0.024,
  "nextdraw-8511": 100 / 7_200 / 0.003,
};

async function driverOf(machine: string, pen: PenSettings) {
  const world = new ManualClock();
  const settings = { ...DEFAULT_PLOT_SETTINGS, machine, pen };
  const driver = new NodePlotter({ device: "virtual", clock: world, settings });
  await world.run(driver.start());
  return { world, driver, settings, board: virtualBoardOf(driver) };
}

/** After power-on the pen may be at any height. */
async function atTop(world: ManualClock, driver: NodePlotter): Promise<void> {
  await world.run(driver.pen({ up: true }));
  await world.advance(5);
}

describe.each(MACHINES)("the pen of %s", (machine) => {
  it("is lowered by hand as gently as configured, and lifted at the lifting rate", async () => {
    const { world, driver, board } = await driverOf(machine, GENTLE);
    await atTop(world, driver);
    for (const [up, ratePctPerS] of [
      [false, 20],
      [true, 150],
    ] as const) {
      const fromPct = board.state().penPct;
      const startS = world.nowS();
      const moved = driver.pen({ up });
      // In small steps: each command waits for the reply to the one before.
      for (let i = 0; i < 40; i++) await world.advance((0.01 * WAY_PCT) / ratePctPerS);
      const distancePct = Math.abs(board.state().penPct - fromPct);
      const elapsedS = world.nowS() - startS;
      expect(distancePct).toBeLessThanOrEqual(1.01 * (ratePctPerS + UNIT_PCT_PER_S[machine]) * elapsedS);
      expect(distancePct).toBeGreaterThan(ratePctPerS * (elapsedS - 2 * FRAME_S));
      await world.run(moved);
      expect(board.state().penPct).toBeCloseTo(up ? GENTLE.upPct : GENTLE.downPct, 1);
      expect(world.nowS() - startS).toBeGreaterThan(WAY_PCT / ratePctPerS);
    }
  });

  it("is lowered as gently in a plot, and the carriage waits for it", async () => {
    const { world, driver, board, settings } = await driverOf(machine, GENTLE);
    await atTop(world, driver);
    const run = await world.run(driver.plot(new LocalPlanner(strokesOf([20, 20, 60, 20])), settings));
    let fromPct = board.state().penPct;
    for (let i = 0; i < 400 && fromPct > GENTLE.upPct - 2; i++) {
      await world.advance(0.01);
      fromPct = board.state().penPct;
    }
    const startS = world.nowS();
    await world.advance(0.5);
    const ratePctPerS = (fromPct - board.state().penPct) / (world.nowS() - startS);
    expect(ratePctPerS).toBeLessThan(1.01 * (20 + UNIT_PCT_PER_S[machine]) + 1);
    expect(ratePctPerS).toBeGreaterThan(19);
    await world.run(run.finished);
    expect(board.statistics().movesBeforePenArrivedCount).toBe(0);
  });

  it.each([
    ["by time", WAITING],
    ["by rate", GENTLE],
    ["by layer", { ...WAITING, layers: { l1: { downPct: 10, extraDropMs: 20, extraLiftMs: 20 } } }],
  ] as const)("has arrived before the carriage moves: %s", (_, pen) => {
    const dash = (x: number, y: number): Point[] => [
      [x, y],
      [x + 4, y],
    ];
    const strokes = [dash(10, 10), dash(16, 10), dash(22, 10), dash(90, 60), dash(96, 60), dash(10, 60)];
    const trajectory = plan(strokeSetOf(strokes, [0, 0, 1, 1, 0, 0]), DEFAULT_MOTION, pen);
    for (const firmware of ["2.5.3", "2.8.1", "3.0.3"]) {
      const fast = new FastBoard(firmware, machineById(machine), pen);
      const profile = machineById(machine);
      for (const line of [penCommand(profile, penMoveOf(pen, true), 400), "SM,5000,0,0"]) fast.send(line);
      const early = fast.board.statistics().movesBeforePenArrivedCount;
      fast.play(fast.compile(trajectory));
      expect(fast.errors).toEqual([]);
      expect(fast.board.statistics().movesBeforePenArrivedCount - early).toBe(0);
    }
  });
});
