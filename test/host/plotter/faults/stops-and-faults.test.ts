/** Emergency stops at awkward instants: pressed twice, together with a fault, before a move has begun, on old firmware. */
import { describe, expect, it } from "vitest";
import type { JournalEntry, RunningPlot, PlotStart } from "../../../../host/plotter/plotter-port.js";
import { moveByHand } from "../../../../host/plotter/hand-moves.js";
import {
  machineById,
  VirtualBoard,
  type StrokeSet,
  type VirtualBoardOptions,
} from "../../../../src/index.js";
import { driverOf } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type HandMove } from "../../../../src/schema/index.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { DRAWING, plotting, type LivePlot } from "../../../support/plots/live-plot.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { NO_EVENTS } from "../../../support/machines/machine.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { outcome, virtualPlotter } from "../../../support/plots/virtual-plotter.js";
import { startAfter } from "../../../support/plots/start-after.js";

const SETTINGS = DEFAULT_PLOT_SETTINGS;
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

async function newPlotter(firmware: string) {
  return virtualPlotter({ firmware });
}

/** A plot on a new plotter. `resumedGapMm` resumes it from its journal, and returns the longest piece missing on the paper. */
async function newPlot(firmware: string, strokes: StrokeSet) {
  const { world, driver, board } = await newPlotter(firmware);
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  const plot = (start: PlotStart): Promise<RunningPlot> =>
    world.run(driver.plot(new LocalPlanner(strokes), SETTINGS, { ...start, journal: { record } }));
  const resumedGapMm = async (): Promise<number> => {
    const again = await plot(startAfter(journal.at(-1)));
    await world.run(again.resume());
    expect(await world.run(again.finished)).toEqual({ kind: "done" });
    return compareDrawn(strokes, board.drawn()).gapMm;
  };
  return { world, driver, board, run: await plot({}), resumedGapMm };
}

/** A machine on a virtual board, without a plotter. */
async function newMachine(options: Partial<VirtualBoardOptions> = {}) {
  const clock = new ManualClock();
  const board = new VirtualBoard({ clock, ...options });
  const driver = await driverOf(machineById("axidraw-v3"));
  const machine = await clock.run(
    driver.identify(board.transport(), { clock, machineClock: clock, speed: 1, events: NO_EVENTS }),
  );
  await clock.run(machine.readKeptState(DEFAULT_PLOT_SETTINGS, null));
  return { clock, board, machine };
}

describe.each(["2.4.4", "2.5.3", "2.8.1", "3.0.3"])(
  "a stop just after a restart, on firmware %s",
  (firmware) => {
    it.each([0, 0.1])("a stop of a plot %s s after a restart leaves no known position", async (afterS) => {
      const { world, driver, board, run, resumedGapMm } = await newPlot(firmware, FAULT_DRAWING);
      await world.advance(3);
      board.restart();
      await world.advance(afterS);
      const stopped = outcome(run.emergencyStop());
      expect(await outcome(world.run(run.finished, 5))).toMatch(/^board-error: The board restarted/);
      await stopped;
      expect(board.state()).toMatchObject({ penUp: true, motorsOn: false });
      expect(driver.state).toMatchObject({ connection: "idle", xMm: null, yMm: null, motorsOn: false });
      expect(await resumedGapMm()).toBeLessThan(0.05);
    });

    it("a stop of a manual move just after a restart leaves no known position", async () => {
      const { clock, board, machine } = await newMachine({ firmware });
      const move = outcome(machine.moveTo(100, 50, SETTINGS));
      while (board.state().steps1 === 0) await clock.advance(0.1);
      board.restart();
      machine.stopAtOnce();
      expect(await clock.run(move)).toMatch(/^board-error: The board restarted/);
      expect(machine).toMatchObject({ state: null, motorsOn: false });
    });

    it("a stop by a typed line just after a restart leaves no known position", async () => {
      const { clock, board, machine } = await newMachine({ firmware });
      await clock.run(machine.moveTo(10, 5, SETTINGS));
      board.restart();
      expect(await clock.run(machine.console!.send("ES"))).toMatchObject({
        note: expect.stringContaining("position is unknown") as string,
      });
      expect(machine.state).toBeNull();
    });
  },
);

describe.each(["2.8.1", "3.0.3"])("a held plot on firmware %s whose board restarts", (firmware) => {
  async function restarted() {
    const plot = await plotting("junction", FAULT_DRAWING, firmware);
    await plot.world.advance(3);
    await plot.world.run(plot.run.pause());
    plot.board.restart();
    const { moveCount } = plot.board.statistics();
    return { ...plot, moveCount };
  }

  it("does not move when it is resumed", async () => {
    const { world, driver, board, run, moveCount } = await restarted();
    const resumed = outcome(run.resume());
    expect(await outcome(world.run(run.finished, 5))).toMatch(/^board-error: The board restarted/);
    await resumed;
    expect(board.statistics().moveCount).toBe(moveCount);
    expect(driver.state).toMatchObject({ xMm: null, motorsOn: false });
  });

  it("ends when its hold point is viewed", async () => {
    const { world, board, run, moveCount } = await restarted();
    run.moveHoldPlace({ mm: -20 });
    const viewed = outcome(run.checkHoldPlace());
    expect(await outcome(world.run(run.finished, 5))).toMatch(/^board-error: The board restarted/);
    expect(await viewed).toMatch(/^board-error: The board restarted/);
    expect(board.statistics().moveCount).toBe(moveCount);
  });
});

describe.each(["2.8.1", "3.0.3"])("an emergency stop on firmware %s leaves nothing out", (firmware) => {
  /** Resumes the plot from its journal when the plotter is ready again, and looks for what is missing on the paper. */
  async function gapAfter(happen: (plot: LivePlot) => Promise<void>): Promise<number> {
    const { resumedGapMm, ...plot } = await newPlot(firmware, FAULT_DRAWING);
    const { world, driver, run } = plot;
    await world.advance(3);
    const ended = outcome(run.finished);
    await happen(plot);
    expect(await world.run(ended, 20)).toMatch(/^board-/);
    while (driver.state.connection !== "idle") await world.advance(0.1);
    return resumedGapMm();
  }

  it("an emergency stop leaves nothing out if the supply fails just after it", async () => {
    const gapMm = await gapAfter(async ({ world, board, run }) => {
      const stopped = run.emergencyStop();
      board.setMotorVolts(0);
      await world.run(outcome(stopped));
      // At rest, it would be read only after 2 s.
      world.after(0.1, () => board.setMotorVolts(9.1));
    });
    expect(gapMm).toBeLessThan(0.05);
  });

  it("an emergency stop leaves nothing out if the board does not answer it any more, and then restarts", async () => {
    const gapMm = await gapAfter(async ({ world, board, run }) => {
      board.setFrozen(true);
      await world.advance(0.3);
      board.setMute(true);
      run.emergencyStop().catch(() => undefined);
      world.after(4, () => {
        board.setMute(false);
        board.restart();
      });
    });
    expect(gapMm).toBeLessThan(0.05);
  });
});

describe.each(["2.8.1", "3.0.3"])("a board on firmware %s that is lost in a plot", (firmware) => {
  /** The travel to the last line passes along the first one. */
  const PASSED_AGAIN = strokesOf([10, 10, 110, 10], [112, 20, 118, 20], [125, 10, 115, 10], [5, 10, 5, 20]);
  const ONE_STROKE = strokesOf([10, 10, 110, 10, 110, 50, 20, 50]);

  /** The pieces missing on the paper when the plot is resumed, by the time when the board was lost. */
  async function gaps(
    strokes: StrokeSet,
    happen: (plot: LivePlot, lose: () => Promise<void>) => Promise<void>,
  ): Promise<[lostS: number, gapMm: number][]> {
    const found: [number, number][] = [];
    for (let afterS = 0.7; afterS < 5; afterS += 0.4) {
      const { resumedGapMm, ...plot } = await newPlot(firmware, strokes);
      const { world, driver, board, run } = plot;
      const ended = outcome(run.finished);
      const isIdle = (): boolean => driver.state.connection === "idle";
      await world.advance(afterS);
      await happen(plot, async () => {
        board.unplug();
        await world.run(ended);
        while (isIdle()) await world.advance(0.1);
        while (!isIdle()) await world.advance(0.1);
      });
      const gapMm = await resumedGapMm();
      if (gapMm > 0.05) found.push([afterS, gapMm]);
      await world.run(driver.close());
    }
    return found;
  }

  it("a board that is lost after an emergency stop leaves nothing out", async () => {
    const found = await gaps(PASSED_AGAIN, async ({ world, run }, lose) => {
      await world.run(run.emergencyStop());
      await lose();
    });
    expect(found).toEqual([]);
  });

  it("a board that is lost twice, the second time with its pen lifted where it was, leaves nothing out", async () => {
    const found = await gaps(PASSED_AGAIN, async (_, lose) => {
      await lose();
      await lose();
    });
    expect(found).toEqual([]);
  });

  it.each([
    ["several strokes", FAULT_DRAWING],
    ["one stroke", ONE_STROKE],
  ])("a board that is lost and then brought home leaves nothing out: %s", async (_, strokes) => {
    const found = await gaps(strokes, async ({ world, driver }, lose) => {
      await lose();
      await world.run(driver.home());
      await lose();
    });
    expect(found).toEqual([]);
  });
});

describe.each(["2.4.4", "2.5.3", "2.8.1", "3.0.3"])("a supply that fails on firmware %s", (firmware) => {
  /** The supply fails; later it is back. The plotter stays where it was when that was noticed. */
  async function fails({ world, driver, board }: Pick<LivePlot, "world" | "driver" | "board">) {
    board.setMotorVolts(0);
    while (driver.state.connection !== "fault") await world.advance(0.01);
    await world.advance(driver.state.emergencyStopMs! / 1_000);
    const { moveCount } = board.statistics();
    await world.advance(2);
    board.setMotorVolts(9.1);
    await world.advance(3);
    expect(board.statistics().moveCount).toBe(moveCount);
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null, yMm: null });
    expect(board.state()).toMatchObject({ motorsOn: false, isBusy: false, penUp: true });
  }

  it("ends a manual move", async () => {
    const plotter = await newPlotter(firmware);
    const move = outcome(plotter.driver.moveTo(280, 180));
    await plotter.world.advance(0.6);
    await fails(plotter);
    expect(await plotter.world.run(move)).toMatch(/^conflict/);
  });

  it("ends a cancelled plot's way home", async () => {
    const line = strokesOf([10, 10, 250, 10, 250, 150]);
    const plot = await plotting("junction", line, firmware);
    await plot.world.advance(8);
    const cancelled = plot.run.cancel();
    const { board } = plot;
    while (!board.state().penUp || !board.state().isBusy) await plot.world.advance(0.05);
    await plot.world.advance(0.3);
    await fails(plot);
    await cancelled;
  });
});

describe("a manual move that is stopped while the pen is lifted for it", () => {
  it("does not begin, and later moves are not affected", async () => {
    const { clock, board, machine } = await newMachine();
    for (let times = 1; times <= 2; times++) {
      await clock.run(machine.movePen(false, SETTINGS));
      const move = outcome(machine.moveTo(40, 30, SETTINGS));
      await clock.advance(0.1);
      for (let i = 0; i < times; i++) machine.stopAtOnce();
      expect(await clock.run(move)).toMatch(/^conflict: The move was stopped/);
      await clock.advance(1);
      expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    }
    machine.stopAtOnce();
    await clock.run(machine.movePen(false, SETTINGS));
    await clock.run(machine.moveTo(40, 30, SETTINGS));
    expect(board.state()).toMatchObject({ xMm: 40, yMm: 30, penUp: true });
  });

  it("does not begin, if it draws", async () => {
    const { clock, board, machine } = await newMachine();
    await clock.run(machine.movePen(false, SETTINGS));
    const drawing = outcome(moveByHand(machine, { kind: "test-patch" }, SETTINGS));
    await clock.advance(0.1);
    machine.stopAtOnce();
    expect(await clock.run(drawing)).toMatch(/^conflict: The move was stopped/);
    await clock.advance(1);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true, isBusy: false });
  });
});

describe("a manual move that is stopped between two of its steps", () => {
  it.each<HandMove>([
    { kind: "jog", dxMm: 10, dyMm: 5 },
    { kind: "frame", boxMm: { xMm: 5, yMm: 5, widthMm: 20, heightMm: 10 } },
    { kind: "test-patch" },
  ])("does not begin if the motors are being switched on: $kind", async (move) => {
    const { clock, board, machine } = await newMachine({ parseMs: 5 });
    await clock.run(machine.movePen(true, SETTINGS));
    const moved = outcome(moveByHand(machine, move, SETTINGS));
    await clock.advance(0.012);
    expect(machine.state).toBeNull();
    machine.stopAtOnce();
    expect(await clock.run(moved)).toMatch(/^conflict: The move was stopped/);
    await clock.advance(1);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, motorsOn: true, isBusy: false });
  });

  it("does not continue to the next switch", async () => {
    const input = { port: "B", pin: 0, pressed: 0 } as const;
    const { clock, board, machine } = await newMachine();
    const plain = machineById("axidraw-v3");
    const controller = { ...plain.controller, homing: { x: input, y: input } };
    const customMachine = { ...plain, id: "switched", controller };
    const settings = { ...SETTINGS, machine: "switched", customMachine };
    let stoppedMm: number | null = null;
    board.onSend((bytes) => {
      const { xMm } = board.state();
      if (stoppedMm !== null || xMm > -5 || !String.fromCharCode(...bytes).startsWith("PI")) return;
      stoppedMm = xMm;
      machine.stopAtOnce();
    });
    const homed = outcome(moveByHand(machine, { kind: "home" }, settings));
    expect(await clock.run(homed)).toMatch(/^conflict: The move was stopped/);
    expect(board.state()).toMatchObject({ xMm: stoppedMm, isBusy: false });
  });
});

describe("firmware without step counters", () => {
  const newOldPlotter = async () => {
    const { world, driver, board } = await newPlotter("2.4.2");
    const plot = (): Promise<RunningPlot> => world.run(driver.plot(new LocalPlanner(DRAWING), SETTINGS));
    return { world, driver, board, plot };
  };

  it("has lost the position after an emergency stop", async () => {
    const { world, driver, plot } = await newOldPlotter();
    const run = await plot();
    await world.advance(2);
    const stopped = outcome(run.emergencyStop());
    expect(await outcome(world.run(run.finished))).toMatch(/^board-error: .*cannot report the position/);
    await stopped;
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null, yMm: null });
  });

  it("has lost the position after a typed line that moves the motors", async () => {
    const { world, driver, board } = await newOldPlotter();
    await world.run(driver.moveTo(10, 0));
    const { note } = await world.run(driver.command("SM,1000,800,800"));
    expect(note).toContain("position is unknown");
    expect(board.state()).toMatchObject({ xMm: 20, isBusy: false });
    expect(driver.state).toMatchObject({ xMm: null, yMm: null });
  });
});
