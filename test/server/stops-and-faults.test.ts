/** Emergency stops at awkward instants: pressed twice, together with a fault, before a move has begun, on old firmware. */
import { describe, expect, it } from "vitest";
import { PlotterDriver } from "../../server/plotter/node-plotter.js";
import type { LivePlotRun } from "../../host/plotter/types.js";
import { machineById, VirtualBoard, type PlotwrightError } from "../../src/index.js";
import { driverOf } from "../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { DRAWING, plotting } from "../support/live-plot.js";
import { LocalPlanner } from "../support/local-planner.js";
import { ManualClock } from "../support/manual-clock.js";
import { virtualBoardOf } from "../support/virtual-board-of.js";

const SETTINGS = DEFAULT_PLOT_SETTINGS;
const outcome = (promise: Promise<unknown>): Promise<unknown> =>
  promise.catch((error: PlotwrightError) => `${error.code}: ${error.message}`);

describe("a second emergency stop while the first is handled", () => {
  /** A plot that was stopped twice and then resumed. */
  async function resumed() {
    const plot = await plotting("junction");
    const { world, run } = plot;
    let isHeld = false;
    run.onHeld((is) => (isHeld = is));
    await world.advance(2);
    const stopped = run.emergencyStop();
    await world.advance(0.05);
    expect(isHeld).toBe(false);
    await world.run(Promise.all([stopped, run.emergencyStop()]));
    await world.run(run.resume());
    await world.advance(1);
    return plot;
  }

  it("does not hide that the motion is stuck later", async () => {
    const { world, board, run } = await resumed();
    board.setMotionless(true);
    expect(await outcome(world.run(run.finished, 60))).toMatch(/^board-error: .*does not finish its motion/);
  });

  it("does not hide that the board refuses a command later", async () => {
    const { world, board, run } = await resumed();
    board.refuseNext();
    expect(await outcome(world.run(run.finished, 60))).toMatch(/^board-error: /);
  });
});

describe("an emergency stop after the board has restarted", () => {
  it("does not hide that the position is lost", async () => {
    const { world, driver, board, run } = await plotting("junction");
    await world.advance(2);
    board.restart();
    const logged = driver.log().length;
    const isHalted = (): boolean => driver.log().slice(logged).includes("> ES");
    while (!isHalted()) await world.advance(0.01);
    // The pen is being lifted.
    await world.advance(0.1);
    const stopped = outcome(run.emergencyStop());
    expect(await outcome(world.run(run.finished, 60))).toMatch(/^board-error: The board restarted/);
    await stopped;
    expect(driver.state).toMatchObject({ xMm: null, yMm: null, motorsOn: false });
  });
});

describe("a manual move that is stopped while the pen is lifted for it", () => {
  it("does not begin, and later moves are not affected", async () => {
    const clock = new ManualClock();
    const board = new VirtualBoard({ clock });
    const events = {
      changed: () => undefined,
      buttonPressed: () => undefined,
      supplyRead: () => undefined,
      lost: () => undefined,
    };
    const driver = driverOf(machineById("axidraw-v3"));
    const machine = await clock.run(
      driver.identify(board.transport(), { clock, machineClock: clock, speed: 1, events }),
    );
    await clock.run(machine.takeOver());
    for (let times = 1; times <= 2; times++) {
      await clock.run(machine.movePen(false, SETTINGS));
      const walk = outcome(machine.walk(40, 30, SETTINGS));
      await clock.advance(0.1);
      for (let i = 0; i < times; i++) machine.stopAtOnce();
      expect(await clock.run(walk)).toMatch(/^conflict: The move was stopped/);
      await clock.advance(1);
      expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    }
    machine.stopAtOnce();
    await clock.run(machine.movePen(false, SETTINGS));
    await clock.run(machine.walk(40, 30, SETTINGS));
    expect(board.state()).toMatchObject({ xMm: 40, yMm: 30, penUp: true });
  });
});

describe("firmware without step counters", () => {
  async function newPlotter() {
    const world = new ManualClock();
    const driver = new PlotterDriver({ device: "virtual", clock: world, firmware: "2.4.2" });
    await world.run(driver.start());
    const plot = (): Promise<LivePlotRun> => world.run(driver.plot(new LocalPlanner(DRAWING), SETTINGS));
    return { world, driver, board: virtualBoardOf(driver), plot };
  }

  it("has lost the position after an emergency stop", async () => {
    const { world, driver, plot } = await newPlotter();
    const run = await plot();
    await world.advance(2);
    const stopped = outcome(run.emergencyStop());
    expect(await outcome(world.run(run.finished))).toMatch(/^board-error: .*cannot report the position/);
    await stopped;
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null, yMm: null });
  });

  it("has lost the position after a typed line that moves the motors", async () => {
    const { world, driver, board } = await newPlotter();
    await world.run(driver.walkTo(10, 0));
    const { note } = await world.run(driver.command("SM,1000,800,800"));
    expect(note).toContain("position is unknown");
    expect(board.state()).toMatchObject({ xMm: 20, isBusy: false });
    expect(driver.state).toMatchObject({ xMm: null, yMm: null });
  });
});
