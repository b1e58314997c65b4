/** A Grbl's own settings, its locks, and its pen after a reconnection. */
import { describe, expect, it } from "vitest";
import type { PlotProgress } from "../../../../src/internal.js";
import { PlotterConnection } from "../../../../host/plotter/plotter-connection.js";
import { driver as grblDriver } from "../../../../src/drivers/grbl/driver.js";
import { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { planJob } from "../../../../src/index.js";
import { GRBL, NO_EVENTS } from "../../../support/machines/machine.js";
import { cutOff, LIMIT_S, newPlotter, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { DRAWING, expectDrawn } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";

/** A machine like the DrawCore: with the pen down its Z is larger. */
const LOWER_IS_LARGER = {
  ...GRBL,
  controller: { ...GRBL.controller, penUpZMm: 0.5, penDownZMm: 5 },
};

describe("a Grbl that reports in inches ($13=1)", () => {
  it("is paused, stopped at once and resumed, and draws everything", async () => {
    const { world, board, driver, begin, within } = await newPlotter({ settings: { 13: 1 } });
    const run = await begin();
    for (const stop of ["pause", "emergencyStop", "pause"] as const) {
      await world.advance(2.3);
      await world.run(run[stop]());
      const { xMm, yMm } = board.state();
      expect(driver.state.xMm).toBeCloseTo(xMm, 1);
      expect(driver.state.yMm).toBeCloseTo(yMm, 1);
      await world.run(run.resume());
    }
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
  });

  it("is also understood if home is not where it was started, and if it is set in the console", async () => {
    const { board, driver, within } = await newPlotter();
    expect(await within(driver.move({ kind: "move-to", xMm: 40, yMm: 30 }))).toBeUndefined();
    expect(await within(driver.move({ kind: "set-home" }))).toBeUndefined();
    expect(await within(driver.command("$13=1"))).toMatchObject({ refused: false });
    expect(await within(driver.move({ kind: "move-to", xMm: 10, yMm: 20 }))).toBeUndefined();
    expect(board.state()).toMatchObject({ xMm: 50, yMm: 50 });
    expect(driver.state.xMm).toBeCloseTo(10, 2);
  });
});

describe("a Grbl with other settings than its profile", () => {
  const SLOWER = [
    [{ 110: 3_000 }, "speed of X is at most 50 mm/s ($110)"],
    [{ 111: 3_000 }, "speed of Y is at most 50 mm/s ($111)"],
    [{ 112: 600 }, "speed of the pen is at most 10 mm/s ($112)"],
    [{ 120: 300 }, "acceleration of X is at most 300 mm/s² ($120)"],
    [{ 121: 500 }, "acceleration of Y is at most 500 mm/s² ($121)"],
    [{ 122: 100 }, "acceleration of the pen is at most 100 mm/s² ($122)"],
    [{ 11: 0.002 }, "Junction deviation is at most 0.002 mm ($11)"],
  ] as const;
  const FASTER = [{ 121: 2_000 }, { 120: 3_000, 121: 1_500 }, { 11: 0.05 }, { 122: 4_000 }].map(
    (settings) => [settings, null] as const,
  );

  it.each([...SLOWER, ...FASTER])(
    "plots in the time that its plan for this Grbl says, and a slower one is told before: %j",
    async (settings, words) => {
      const { world, driver, begin, within } = await newPlotter({ settings });
      if (words === null) expect(driver.state.message).toBeNull();
      else {
        expect(driver.state.message).toMatch(/^This Grbl is slower than the profile of My Grbl says: /);
        expect(driver.state.message).toContain(words);
      }
      const run = await begin();
      const startS = world.nowS();
      const first = await new Promise<PlotProgress>((resolve) => {
        run.onProgress(resolve);
        void world.advance(1);
      });
      const toldS = first.elapsedS + first.remainingS;
      expect(await within(run.finished)).toEqual({ kind: "done" });
      // The pen goes up before the plan begins.
      expect(Math.abs(world.nowS() - startS - toldS)).toBeLessThan(0.01 * toldS + 0.6);
    },
  );
  it("a Grbl that is faster than its profile plots no faster than told", async () => {
    const settings = { 110: 30_000, 111: 30_000, 112: 9_000 };
    const { world, begin, within } = await newPlotter({ settings });
    const fast = { ...SETTINGS.motion.travel, speedMmPerS: 500 };
    const plot = { ...SETTINGS, motion: { ...SETTINGS.motion, travel: fast } };
    const { trajectory } = planJob({ strokes: DRAWING }, plot, GRBL);
    const run = await begin(new LocalPlanner(DRAWING), {}, plot);
    const startS = world.nowS();
    expect(await within(run.finished)).toEqual({ kind: "done" });
    const liftS = 0.25;
    expect(Math.abs(world.nowS() - startS - liftS - trajectory.totalS)).toBeLessThan(0.05);
  });
});

describe("soft limits ($20=1)", () => {
  it("a plot or a move that would leave the soft limits is refused in words before anything moves", async () => {
    const { board, driver, begin, within } = await newPlotter({ settings: { 20: 1, 132: 200 } });
    // Its Z is at the upper limit, so the pen cannot be lifted.
    const words =
      /^out-of-bounds: This needs Z from 5 to 5 mm, but the Grbl's soft limits \(\$20=1\) end at -200 and 0 mm/;
    expect(await within((await begin()).finished)).toMatch(words);
    expect(await within(driver.move({ kind: "move-to", xMm: 10, yMm: 10 }))).toMatch(words);
    expect(driver.log()).not.toContain("ALARM");
    expect(board.state()).toMatchObject({ state: "Idle", zMm: 0 });
  });

  it("a plot that would leave the soft limits of X or Y is refused too", async () => {
    const low = { ...GRBL, controller: { ...GRBL.controller, penUpZMm: 0, penDownZMm: -5 } };
    const settings = { ...SETTINGS, customMachine: low };
    const { board, driver, begin, within } = await newPlotter({ settings: { 20: 1 } }, low);
    const words = /^out-of-bounds: This needs X from 0 to 108 mm, but the Grbl's soft limits/;
    expect(await within((await begin(new LocalPlanner(DRAWING), {}, settings)).finished)).toMatch(words);
    expect(driver.log()).not.toContain("ALARM");
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0, penUp: true });
  });
});

describe("a Grbl that is locked until it is homed ($22=1)", () => {
  it("is not unlocked at connecting; the message says what to do, and does it", async () => {
    const { board, driver, begin, within } = await newPlotter({ settings: { 22: 1 } });
    expect(driver.state.connection).toBe("idle");
    const words = /^board-error: The Grbl is locked until it is homed \(\$22=1\).*send \$X in the console/;
    expect(await within(driver.pen({ up: true }))).toMatch(words);
    expect(await within(driver.move({ kind: "move-to", xMm: 10, yMm: 10 }))).toMatch(words);
    expect(await within((await begin()).finished)).toMatch(words);
    expect(board.state()).toMatchObject({ state: "Alarm", xMm: 0, zMm: 0 });
    expect(driver.log()).not.toContain("> $X");
    expect(await within(driver.command("$X"))).toMatchObject({ refused: false });
    expect(await within(driver.move({ kind: "move-to", xMm: 10, yMm: 10 }))).toBeUndefined();
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 10, yMm: 10, penUp: true });
  });

  it.each([
    ["a restart", (board: VirtualGrbl) => board.restart()],
    ["a limit switch", (board: VirtualGrbl) => board.stopWith(1)],
  ])("is not unlocked after %s in mid-plot", async (_, fault) => {
    const { world, board, driver, begin, within } = await newPlotter({ settings: { 22: 1 } });
    await within(driver.command("$X"));
    const run = await begin();
    await world.advance(2.1);
    fault(board);
    expect(await within(run.finished)).toMatch(
      /^board-error: The Grbl has .* The pen could not be lifted: lift it by hand\. The Grbl is locked/,
    );
    expect(board.state().state).toBe("Alarm");
    expect(driver.log().match(/> \$X/g)).toHaveLength(1);
  });

  it("is unlocked after our own emergency stop and after motors off, which the user asked for", async () => {
    const { world, board, driver, begin, within } = await newPlotter({ settings: { 22: 1 } });
    await within(driver.command("$X"));
    const run = await begin();
    await world.advance(2.1);
    await world.run(run.emergencyStop(), LIMIT_S);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    await world.run(run.resume());
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
    expect(await within(driver.motorsOff())).toBeUndefined();
    expect(await within(driver.move({ kind: "move-to", xMm: 1, yMm: 2 }))).toBeUndefined();
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 1, yMm: 2 });
  });
});

describe.each([
  ["up is higher", GRBL],
  ["down is larger", LOWER_IS_LARGER],
])("the pen after a reconnection (%s)", (_, machine) => {
  const { penUpZMm: upMm, penDownZMm: downMm } = machine.controller;

  /** A plotter with this machine. */
  async function plotter() {
    const all = await newPlotter({}, machine);
    const settings = { ...SETTINGS, customMachine: machine };
    return { ...all, begin: () => all.begin(new LocalPlanner(DRAWING), {}, settings) };
  }

  it("is lifted to its height if the Grbl was not restarted", async () => {
    const all = await plotter();
    await cutOff(all, await all.begin());
    expect(all.board.state().zMm).toBeCloseTo(upMm, 3);
  });

  it("is lifted by its travel if the Grbl was restarted, and has the right heights again", async () => {
    const { world, board, driver, begin, line, within } = await plotter();
    const run = await begin();
    await world.advance(3);
    expect(board.state().zMm).toBeCloseTo(downMm, 3);
    line().unplug();
    board.restart();
    expect(await within(run.finished)).toMatch(/^disconnected/);
    await world.advance(5);
    expect(board.state().zMm).toBeCloseTo(upMm, 3);
    expect(driver.state).toMatchObject({ connection: "idle", penUp: true });
    expect(await within(driver.pen({ up: false }))).toBeUndefined();
    expect(board.state().zMm).toBeCloseTo(downMm, 3);
  });

  it("is not lifted a second time if it was up, and has the right heights again", async () => {
    const { world, board, driver, begin, within } = await plotter();
    expect(await within((await begin()).finished)).toEqual({ kind: "done" });
    board.restart();
    await world.advance(5);
    expect(board.state().zMm).toBeCloseTo(upMm, 3);
    expect(driver.state).toMatchObject({ connection: "idle", penUp: true });
    expect(await within(driver.pen({ up: false }))).toBeUndefined();
    expect(board.state().zMm).toBeCloseTo(downMm, 3);
  });

  it("is lifted by its travel if the Grbl restarts in mid-stroke and its greeting is lost", async () => {
    const { world, board, driver, begin, line, within } = await plotter();
    const run = await begin();
    await world.advance(3);
    line().isMute = true;
    board.restart();
    line().isMute = false;
    expect(await within(run.finished)).toMatch(/^board-(error|timeout): /);
    await world.advance(5);
    expect(board.state().zMm).toBeCloseTo(upMm, 3);
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null });
  });

  it("is lifted by its travel if the Grbl restarts in mid-stroke with the connection kept", async () => {
    const { world, board, begin, within } = await plotter();
    const run = await begin();
    await world.advance(3);
    board.restart();
    expect(await within(run.finished)).toMatch(/^board-error: The Grbl has restarted: .* pen is lifted/);
    expect(board.state().zMm).toBeCloseTo(upMm, 3);
  });
});

describe("the pen at the first connection", () => {
  async function connected(zMm: number, restarts: boolean) {
    const world = new ManualClock();
    const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL });
    await board.transport().write(new TextEncoder().encode(`G1X20Z${zMm}F6000\n`));
    await world.advance(2);
    if (restarts) board.restart();
    const driver = new PlotterConnection({
      device: "a port",
      clock: world,
      settings: SETTINGS,
      devices: { find: () => Promise.resolve([]), open: () => Promise.resolve(board.transport()) },
    });
    await world.run(driver.start());
    return { board, driver };
  }

  it.each([
    [0, false, 5, true],
    [2, false, 5, true],
    [5, false, 5, true],
    // Not heights of this pen: another program's coordinates.
    [30, false, 30, true],
    [-40, false, -40, null],
    // Where it is, is unknown.
    [0, true, 0, null],
    [5, true, 5, null],
  ])(
    "the pen from Z %d, restarted: %s, is then at Z %d, and up: %s",
    async (zMm, restarts, thenMm, penUp) => {
      const { board, driver } = await connected(zMm, restarts);
      expect(board.state().zMm).toBeCloseTo(thenMm, 3);
      expect(driver.state.penUp).toBe(penUp);
    },
  );
});

it("connecting stops a motion that was left along its path, so that a Grbl with homing is not locked", async () => {
  const world = new ManualClock();
  const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL });
  await board.transport().write(new TextEncoder().encode("$22=1\nG1X200F3000\n"));
  await world.advance(0.5);
  const options = {
    clock: world,
    machineClock: world,
    speed: 1,
    events: NO_EVENTS,
  };
  const machine = await world.run(grblDriver.identify(board.transport(), options));
  await world.run(machine.readKeptState(SETTINGS, null));
  expect(board.state().state).toBe("Idle");
  expect(machine.log()).not.toContain("ALARM");
  expect(machine.log()).not.toContain("> $X");
});
