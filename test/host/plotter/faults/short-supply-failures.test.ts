/**
 * The motors' supply fails for 0.1 to 0.3 s in the middle of a plot. The board counts on while its motors miss steps, so
 * a failure that is not found displaces the rest of the drawing. Firmware 3 latches each failure. On older boards the
 * supply is measured between two commands, so a failure within one command, or while the pen is lifted, is not found.
 */
import { describe, expect, it } from "vitest";
import type { JournalEntry, RunningPlot, PlotStart } from "../../../../host/plotter/plotter-port.js";
import type { PlotwrightError } from "../../../../src/index.js";
import { firmwareFeatures } from "../../../../src/drivers/ebb/protocol/firmware.js";
import { SupplyPolls } from "../../../../src/drivers/ebb/machine/readings.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { cases } from "../../../support/runs/full-run.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { virtualBoardOf, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const COUNT = cases(200, 20);
const FIRST_S = 0.4;
const LAST_S = 8;
/** A drawing that is farther from its place than this is displaced: more than a rounded corner. */
const DISPLACED_MM = 0.15;
const GAP_MM = 0.05;

type End = "found" | "displaced" | "harmless";

/** The effect of a supply that fails for `failureS`, `afterS` after the plot's start. */
async function endOf(firmware: string, afterS: number, failureS: number): Promise<End> {
  const { world, driver } = await virtualPlotter({ firmware });
  const journal: JournalEntry[] = [];
  const plot = (start: PlotStart = {}): Promise<RunningPlot> =>
    world.run(driver.plot(new LocalPlanner(FAULT_DRAWING), DEFAULT_PLOT_SETTINGS, start));
  const run = await plot({ journal: { record: (entry) => journal.push(entry) } });
  const board = virtualBoardOf(driver);
  world.after(afterS, () => board.setMotorVolts(0));
  world.after(afterS + failureS, () => board.setMotorVolts(9.1));
  const message = await world.run(
    run.finished.then(
      () => null,
      (error: PlotwrightError) => error.message,
    ),
  );
  const drawn = board.drawn();
  await world.advance(5);
  expect(driver.state).toMatchObject({ connection: "idle", xMm: message === null ? 0 : null });
  if (message === null) {
    return compareDrawn(FAULT_DRAWING, drawn).awayMm > DISPLACED_MM ? "displaced" : "harmless";
  }
  expect(message).toMatch(/^The motors ha(d|ve) no power, or too little.*push it to home before/);
  const again = await plot({ from: journal[journal.length - 1].place });
  await world.run(again.resume());
  expect(await world.run(again.finished)).toEqual({ kind: "done" });
  expect(compareDrawn(FAULT_DRAWING, board.drawn()).gapMm).toBeLessThan(GAP_MM);
  return "found";
}

/** How many failures at random instants had each effect. */
async function ends(firmware: string, failureS: () => number): Promise<Record<End, number>> {
  const random = seeded(11);
  const counts = { found: 0, displaced: 0, harmless: 0 };
  for (let i = 0; i < COUNT; i++) {
    counts[await endOf(firmware, FIRST_S + (LAST_S - FIRST_S) * random(), failureS())]++;
  }
  return counts;
}

describe("a motor supply that fails for 0.1 to 0.3 s", () => {
  const failureS = (): (() => number) => {
    const random = seeded(12);
    return () => 0.1 + 0.2 * random();
  };

  it.each(["3.0.0", "3.0.3"])("is always found on firmware %s", { timeout: 240_000 }, async (firmware) => {
    expect(await ends(firmware, failureS())).toEqual({ found: COUNT, displaced: 0, harmless: 0 });
  });

  // Measured in the full run: 195, 184 and 183 of 200 are found; 0, 7 and 15 displace the drawing.
  it.each(["2.4.4", "2.5.3", "2.8.1"])(
    "is found at least 17 times in 20 on firmware %s, which does not latch it",
    { timeout: 240_000 },
    async (firmware) => {
      const { found, harmless } = await ends(firmware, failureS());
      expect(found).toBeGreaterThanOrEqual(0.85 * COUNT);
      expect(found + harmless).toBeGreaterThanOrEqual(0.9 * COUNT);
    },
  );
});

describe("a failure of 0.1 s while nothing moves, on firmware 3.0.3", () => {
  async function plotter() {
    const { world, driver } = await virtualPlotter({ firmware: "3.0.3" });
    await world.run(driver.moveTo(20, 10));
    const board = virtualBoardOf(driver);
    const fail = async (): Promise<void> => {
      board.setMotorVolts(0);
      await world.advance(0.1);
      board.setMotorVolts(9.1);
    };
    return { world, driver, board, fail };
  }
  const outcome = (promise: Promise<unknown>): Promise<unknown> =>
    promise.catch((error: PlotwrightError) => error.message);

  it("makes the position unknown, and the plotter is used again", async () => {
    const { world, driver, fail } = await plotter();
    await fail();
    await world.advance(6);
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null, motorsOn: false });
  });

  it("a failure just before a move stops the move, and not the one after it", async () => {
    const { world, driver, board, fail } = await plotter();
    await fail();
    const { moveCount } = board.statistics();
    expect(await outcome(world.run(driver.moveTo(40, 10)))).toMatch(/^The motors had no power.*for a moment/);
    expect(board.statistics().moveCount).toBe(moveCount);
    await world.advance(6);
    await world.run(driver.moveTo(40, 10));
    expect(driver.state).toMatchObject({ xMm: 40, yMm: 10 });
  });

  it("a failure while the program is not connected makes the position unknown", async () => {
    const { world, driver, board, fail } = await plotter();
    board.unplug();
    await fail();
    await world.advance(6);
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null });
  });

  it("is reported to a user who asks the board for it", async () => {
    const { world, driver, fail } = await plotter();
    await fail();
    expect(await world.run(driver.command("QG"))).toMatchObject({
      note: expect.stringContaining("supply has failed for a moment") as string,
    });
    expect(driver.state.xMm).toBeNull();
  });
});

it("a stray line that looks like the board's report of a failure is not taken for one", () => {
  const session = { strayCount: 3 };
  const polls = new SupplyPolls(session, firmwareFeatures("3.0.3"), "QL,0");
  const poll = (general: string, strays: number) => {
    const early = [polls.answered("QS", "12,34"), polls.answered("QG", general)];
    session.strayCount += strays;
    return [...early, polls.answered("QL,0", "113")];
  };
  expect(poll("3E", 0)).toEqual([null, null, null]);
  expect(poll("7E", 1)).toEqual([null, "doubtful", "doubtful"]);
  expect(poll("7E", 0)).toEqual([null, "doubtful", "failed"]);
  expect(poll("3E", 0)).toEqual([null, null, null]);
});
