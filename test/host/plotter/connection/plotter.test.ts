import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { PlotProgress } from "../../../../host/plotter/plotter-port.js";
import { machineById, type MachineProfile, type StrokeSet } from "../../../../src/index.js";
import type { Springs } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type HandMove, type PlotSettings } from "../../../../src/schema/index.js";
import { cases } from "../../../support/runs/full-run.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { outcome, virtualPlotter } from "../../../support/plots/virtual-plotter.js";

const SETTINGS = DEFAULT_PLOT_SETTINGS;
/** The carriage waits for the pen. */
const WAITING: PlotSettings = { ...SETTINGS, pen: { ...SETTINGS.pen, overlap: "off" } };
const TWO_LINES = strokesOf([10, 10, 60, 10, 60, 40], [20, 50, 80, 50]);
async function newPlotter(firmware?: string, virtualSprings?: Springs) {
  const { world, driver, board } = await virtualPlotter({ firmware, virtualSprings });
  const begin = async (strokes: StrokeSet = TWO_LINES, settings = SETTINGS) => {
    const planner = new LocalPlanner(strokes);
    const run = await world.run(driver.plot(planner, settings));
    return { planner, run };
  };
  return { world, driver, board, begin };
}

const drawn = (board: { drawn(): { penDown: boolean; xy: Float64Array }[] }): number[][] =>
  board
    .drawn()
    .filter(({ penDown, xy }) => penDown && xy.length > 2)
    .map(({ xy }) =>
      [xy[0], xy[1], xy[xy.length - 2], xy[xy.length - 1]].map((v) => Math.round(v * 10) / 10),
    );

describe("a plotter", () => {
  it("connects to the virtual board and says so plainly", async () => {
    const { driver } = await newPlotter();
    expect(driver.state).toMatchObject({ kind: "virtual", connection: "idle", firmware: "2.8.1" });
    expect(driver.state.message).toContain("nothing is drawn on paper");
  });

  it.each(["2.5.3", "2.8.1", "3.0.3"])(
    "plots to the end and is idle at home again, on firmware %s",
    async (firmware) => {
      const { world, driver, board, begin } = await newPlotter(firmware);
      const { run } = await begin(TWO_LINES, WAITING);
      expect(driver.state.connection).toBe("busy");
      expect(await world.run(run.finished)).toEqual({ kind: "done" });
      expect(drawn(board)).toEqual([
        [10, 10, 60, 40],
        [20, 50, 80, 50],
      ]);
      expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
      expect(board.statistics()).toMatchObject({ underrunCount: 0, movesBeforePenArrivedCount: 0 });
      expect(driver.state).toMatchObject({ connection: "idle", penUp: true, xMm: 0, yMm: 0 });
    },
  );

  it("draws with a swinging pen if frequencies are given, and otherwise with one that does not swing", async () => {
    const beyond = async (springs?: Springs): Promise<number> => {
      const { world, board, begin } = await newPlotter("2.8.1", springs);
      const { run } = await begin(TWO_LINES, WAITING);
      expect(await world.run(run.finished)).toEqual({ kind: "done" });
      expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
      // The second line ends at x = 80.
      const line = board.drawn().filter(({ penDown }) => penDown)[1].xy;
      return Math.max(...line.filter((_, i) => i % 2 === 0)) - 80;
    };
    expect(await beyond()).toBeLessThan(0.02);
    expect(await beyond({ xHz: 15, yHz: 25, damping: 0.05 })).toBeGreaterThan(0.04);
  });

  it("reports progress many times a second, always increasing, up to 1", async () => {
    const { world, begin } = await newPlotter();
    const { run } = await begin();
    const seen: PlotProgress[] = [];
    run.onProgress((progress) => seen.push(progress));
    await world.run(run.finished);
    const last = seen[seen.length - 1];
    expect(last).toMatchObject({ progress: 1, remainingS: 0, xMm: 0, yMm: 0, penUp: true });
    expect(seen.length / last.elapsedS).toBeGreaterThan(10);
    expect(seen.every((p, i) => i === 0 || p.progress >= seen[i - 1].progress)).toBe(true);
    expect(seen.some((p) => !p.penUp)).toBe(true);
  });

  it("draws three times in a row without losing a step", async () => {
    const { world, board, begin } = await newPlotter();
    for (let i = 0; i < 3; i++) {
      const { run } = await begin();
      await world.run(run.finished);
      expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
    }
  });

  it("is busy for a second plot and for moves by hand while it plots", async () => {
    const { world, driver, begin } = await newPlotter();
    const { run } = await begin();
    expect(await outcome(driver.plot(new LocalPlanner(TWO_LINES), SETTINGS))).toMatch(/^busy/);
    expect(await outcome(driver.home())).toMatch(/^busy/);
    await world.run(run.finished);
  });

  it("goes home after a cancel, pen up, and draws nothing more", async () => {
    const { world, board, begin } = await newPlotter();
    const { run } = await begin();
    await world.advance(1.5);
    const cancelled = run.cancel();
    expect(await world.run(run.finished)).toEqual({ kind: "cancelled" });
    await cancelled;
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    expect(drawn(board).length).toBe(1);
  });

  it("reports that there is nothing to draw", async () => {
    const { world, driver, begin } = await newPlotter();
    const { run } = await begin(strokesOf());
    expect(await outcome(world.run(run.finished))).toMatch(/^bad-file: There is nothing to draw/);
    expect(driver.state.connection).toBe("idle");
  });
});

describe("moves by hand", () => {
  it("lifts and lowers the pen to the heights of the settings, or to the requested one", async () => {
    const { world, driver, board } = await newPlotter();
    await world.run(driver.pen({ up: false }));
    expect(board.state()).toMatchObject({ penUp: false });
    expect(board.state().penPct).toBeCloseTo(SETTINGS.pen.downPct, 1);
    await world.run(driver.pen({ up: true, heightPct: 75 }));
    await world.advance(1);
    expect(board.state().penPct).toBeCloseTo(75, 1);
    expect(driver.state.penUp).toBe(true);
  });

  it("switches the motors off; home is then wherever the carriage is", async () => {
    const { world, driver, board, begin } = await newPlotter();
    const { run } = await begin();
    await world.run(run.finished);
    await world.run(driver.motorsOff());
    expect(board.state().motorsOn).toBe(false);
    expect(driver.state).toMatchObject({ motorsOn: false, xMm: null, yMm: null });
  });
});

describe("moves by hand from place to place", () => {
  const MOVES: readonly HandMove[] = [
    { kind: "move-to", xMm: 250, yMm: 150 },
    { kind: "jog", dxMm: 100, dyMm: 50 },
    { kind: "frame", boxMm: { xMm: 20, yMm: 20, widthMm: 100, heightMm: 80 } },
    { kind: "test-patch" },
    { kind: "square", sizeMm: 80 },
  ];
  // Before firmware 2.7 a stop zeroes the counters, so they would not show whether the position is right.
  it.each(["2.8.1", "3.0.3"])(
    "are stopped at once at any time, with the pen lifted and the position known, on firmware %s",
    async (firmware) => {
      await fc.assert(
        fc.asyncProperty(
          fc.constantFrom(...MOVES),
          fc.double({ min: 0, max: 4, noNaN: true }),
          async (move, s) => {
            const { world, driver, board } = await newPlotter(firmware);
            await world.run(driver.move({ kind: "move-to", xMm: 10, yMm: 10 }));
            const moved = outcome(driver.move(move));
            await world.advance(s);
            const isMoving = driver.state.activity === "moving";
            await world.run(driver.stopMove());
            expect(await world.run(moved)).toBe(
              isMoving ? "conflict: The move was stopped at once." : undefined,
            );
            await world.advance(1);
            const { steps1, steps2, ...rest } = board.state();
            expect(rest).toMatchObject({ penUp: true });
            expect(driver.state).toMatchObject({ connection: "idle", activity: "none", penUp: true });
            await world.advance(5);
            expect(board.state()).toMatchObject({ steps1, steps2 });
            // The position is still right: home is home.
            await world.run(driver.home());
            expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
          },
        ),
        { numRuns: cases(100, 8) },
      );
    },
  );

  it("a stop does nothing when nothing moves", async () => {
    const { world, driver } = await newPlotter();
    await world.run(driver.stopMove());
    await world.run(driver.moveTo(20, 10));
    expect(driver.state).toMatchObject({ connection: "idle", xMm: 20, yMm: 10 });
  });

  it("moves to positions, jogs, sets home, and traces a frame with the pen up", async () => {
    const { world, driver, board } = await newPlotter();
    await world.run(driver.moveTo(40, 30));
    expect(driver.state).toMatchObject({ xMm: 40, yMm: 30, penUp: true });
    await world.run(driver.jog(-10, 5));
    expect(board.state()).toMatchObject({ xMm: 30, yMm: 35 });
    await world.run(driver.setHome());
    expect(driver.state).toMatchObject({ xMm: 0, yMm: 0 });
    await world.run(driver.traceFrame(10, 10, 50, 40));
    expect(driver.state).toMatchObject({ xMm: 0, yMm: 0, penUp: true });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
    expect(drawn(board)).toEqual([]);
  });

  it("never moves beyond the machine", async () => {
    const { world, driver, board } = await newPlotter();
    expect(await outcome(driver.moveTo(400, 10))).toMatch(
      /^out-of-bounds: 400, 10 mm is beyond the AxiDraw V3/,
    );
    expect(await outcome(driver.moveTo(NaN, 10))).toMatch(/^out-of-bounds/);
    expect(await outcome(driver.jog(1e9, 0))).toMatch(/^out-of-bounds/);
    await world.advance(1);
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, isBusy: false });
  });

  it("draws a test patch at the carriage's position and returns there", async () => {
    const { world, driver, board } = await newPlotter();
    await world.run(driver.moveTo(50, 50));
    await world.run(driver.drawTestPatch());
    expect(driver.state).toMatchObject({ xMm: 50, yMm: 50, penUp: true });
    expect(drawn(board).map(([x, y]) => [x, y])).toEqual([
      [50, 50],
      [60, 56],
      [52, 64],
    ]);
  });

  it("cycles the pen", async () => {
    const { world, driver, board } = await newPlotter();
    const before = board.statistics().penMoveCount;
    await world.run(driver.cyclePen());
    expect(board.statistics().penMoveCount - before).toBe(2);
    expect(driver.state.penUp).toBe(true);
  });
});

describe("an interrupted plot", () => {
  it("is written to the journal at least every half second", async () => {
    const { world, driver } = await newPlotter();
    const times: number[] = [];
    const run = await world.run(
      driver.plot(new LocalPlanner(TWO_LINES), SETTINGS, {
        journal: { record: () => times.push(world.nowS()) },
      }),
    );
    await world.run(run.finished);
    const gaps = times.slice(1).map((time, i) => time - times[i]);
    expect(times.length).toBeGreaterThan(5);
    expect(Math.max(...gaps)).toBeLessThanOrEqual(0.5);
  });

  it("has lost its position after the board was reset: home is set again", async () => {
    const { world, driver, board, begin } = await newPlotter();
    const { run } = await begin();
    await world.advance(1.9);
    board.resetByPower();
    expect(await outcome(world.run(run.finished, 3))).toMatch(/^disconnected/);
    await world.advance(5);
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null, yMm: null });
  });
});

describe("the board's reports while it plots", () => {
  it("holds the plot when its button is pressed", async () => {
    const { world, board, begin } = await newPlotter();
    const { run } = await begin();
    const held: boolean[] = [];
    run.onHeld((is) => held.push(is));
    await world.advance(1.5);
    board.pressButton();
    await world.advance(2);
    expect(held).toEqual([true]);
    expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
  });

  it("one odd reading of the supply does not end a plot", async () => {
    const { world, board, begin } = await newPlotter();
    const { run } = await begin();
    await world.advance(1.4);
    let oddCount = 0;
    board.onSend((bytes) => {
      if (!/^\d{4},0158\s/.test(String.fromCharCode(...bytes))) return;
      board.setMotorVolts(9.1);
      oddCount++;
    });
    board.setMotorVolts(5);
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(oddCount).toBe(1);
  });

  it("a plot ends within 3 s when the motors lose their power, and the plotter waits for it to come back", async () => {
    const { world, driver, board, begin } = await newPlotter();
    const { run } = await begin();
    await world.advance(1.5);
    board.setMotorVolts(1);
    expect(await outcome(world.run(run.finished, 3))).toMatch(/^board-error: The motors have no power/);
    expect(driver.state).toMatchObject({ connection: "fault", xMm: null });
    expect(driver.state.message).toContain("power supply");
    expect(await outcome(driver.home())).toMatch(/^board-error: The motors have no power/);
    board.setMotorVolts(9.1);
    await world.advance(3);
    expect(driver.state.connection).toBe("idle");
  });

  it("a supply that is off is detected before a plot begins", async () => {
    const { world, driver, board } = await newPlotter();
    board.setMotorVolts(0);
    await world.advance(3);
    expect(driver.state).toMatchObject({ connection: "fault" });
    expect(await outcome(driver.plot(new LocalPlanner(TWO_LINES), SETTINGS))).toMatch(/no power/);
  });
});

describe("a board that fails", () => {
  it("ends the plot with advice, and is used again once it is back", async () => {
    const { world, driver, board, begin } = await newPlotter();
    const { run } = await begin();
    await world.advance(1.5);
    board.unplug();
    expect(await outcome(world.run(run.finished, 3))).toMatch(/^disconnected: /);
    expect(driver.state.connection).toBe("fault");
    expect(driver.state.message).toMatch(/plug|start it again/i);
    expect(await outcome(driver.home())).toMatch(/^disconnected: /);
    await world.advance(5);
    expect(driver.state.connection).toBe("idle");
  });

  it("a board that goes silent ends the plot within 3 s", async () => {
    const { world, driver, board, begin } = await newPlotter();
    const { run } = await begin();
    await world.advance(1.5);
    board.setMute(true);
    expect(await outcome(world.run(run.finished, 3))).toMatch(/^board-timeout: /);
    expect(driver.state.connection).toBe("fault");
  });
});

describe("a board that answers but does not move", () => {
  it.each(["2.5.3", "2.8.1", "3.0.3"])("ends the plot within 3 s, on firmware %s", async (firmware) => {
    const { world, driver, board, begin } = await newPlotter(firmware);
    const { run } = await begin(strokesOf([10, 10, 250, 10]));
    await world.advance(1.5);
    board.setFrozen(true);
    expect(await outcome(world.run(run.finished, 3))).toMatch(
      /^board-(error|timeout): The board (answers but does not finish|has stopped answering)/,
    );
    board.setFrozen(false);
    await world.advance(5);
    expect(driver.state.connection).toBe("idle");
  });

  it.each(["2.8.1", "3.0.3"])("ends a cancelled plot within 3 s, on firmware %s", async (firmware) => {
    const { world, driver, board, begin } = await newPlotter(firmware);
    const { run } = await begin(strokesOf([10, 10, 250, 10]));
    await world.advance(1.5);
    board.setFrozen(true);
    void run.cancel().catch(() => undefined);
    const ended = await outcome(world.run(run.finished, 3));
    expect(JSON.stringify(ended)).toMatch(/"cancelled"|board-/);
    expect(driver.state.connection).not.toBe("busy");
  });

  it("a board that spends the time of its moves without a step ends the plot within 3 s", async () => {
    const { world, board, begin } = await newPlotter("3.0.3");
    const { run } = await begin(strokesOf([10, 10, 250, 10]));
    await world.advance(1.5);
    board.setMotionless(true);
    expect(await outcome(world.run(run.finished, 3))).toMatch(/^board-error: The board answers but does not/);
  });

  it("is not confused with one that waits for its pen, or moves slowly", async () => {
    const { world, driver } = await newPlotter("3.0.3");
    const settings = {
      ...SETTINGS,
      pen: { ...SETTINGS.pen, extraLiftMs: 4_000, extraDropMs: 4_000 },
      motion: { ...SETTINGS.motion, draw: { ...SETTINGS.motion.draw, speedMmPerS: 0.5 } },
    };
    const run = await world.run(
      driver.plot(new LocalPlanner(strokesOf([2, 2, 6, 2], [6, 4, 5, 4])), settings),
    );
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
  });
});

describe("a plotter that is closed in mid-plot", () => {
  it("ends the plot and leaves nothing that would keep the process alive", async () => {
    const { world, driver, begin } = await newPlotter();
    const { run } = await begin();
    await world.advance(1.5);
    await world.run(driver.close());
    expect(await outcome(world.run(run.finished, 10))).toMatch(/^disconnected/);
    const never = new Promise<void>(() => undefined);
    await expect(world.run(never, 60)).rejects.toThrow("no timer is pending");
  });
});

describe("another machine on the same board", () => {
  it("uses its own microsteps from the carriage's position", async () => {
    const { world, driver, board } = await newPlotter();
    await world.run(driver.moveTo(30, 0));
    expect(board.state()).toMatchObject({ steps1: 2_400, steps2: 2_400 });
    const fine = machineById("axidraw-v3");
    const coarse: MachineProfile = {
      ...fine,
      id: "coarse",
      stepsPerMm: 40,
      controller: { ...fine.controller, microstepMode: 2 },
    };
    const settings = { ...SETTINGS, machine: "coarse", customMachine: coarse };
    await world.run(driver.moveTo(60, 0, settings));
    expect(driver.log()).toContain("> EM,2,2\n");
    expect(board.state()).toMatchObject({ steps1: 1_200, steps2: 1_200 });
    expect(driver.state).toMatchObject({ xMm: 60, yMm: 0 });
    await world.run(driver.home(settings));
    expect(board.state()).toMatchObject({ steps1: -1_200, steps2: -1_200 });
    await world.run(driver.setHome(SETTINGS));
    await world.run(driver.moveTo(1, 0, SETTINGS));
    expect(board.state()).toMatchObject({ steps1: 80, steps2: 80 });
  });
});
