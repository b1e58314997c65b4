/** Grbl 0.9 and 1.1 and their children: each is known by name, plots in the planned time, pauses and stops. */
import { describe, expect, it } from "vitest";
import { driver as grblDriver } from "../../../../src/drivers/grbl/driver.js";
import { isGreeting, offsetOf, statusOf, versionOf } from "../../../../src/drivers/grbl/protocol.js";
import { FACES, type FaceName } from "../../../../src/drivers/grbl/virtual/faces.js";
import { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { CONTROLLERS } from "../../../../src/drivers/registry.js";
import { GRBL, GRBL_SERVO, NO_EVENTS } from "../../../support/machines/machine.js";
import { machineWith, newPlotter, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { DRAWING, expectDrawn } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";

const VERSIONS: Readonly<Record<FaceName, string>> = {
  "1.1": "Grbl 1.1h",
  "0.9": "Grbl 0.9j",
  grblHAL: "grblHAL 1.1f",
  FluidNC: "FluidNC 3.7.16",
  DrawCore: "DrawCore 2.09",
};

describe.each(FACES)("a %s", (face) => {
  it("is known by its greeting, or without one by its answers", async () => {
    for (const isReset of [true, false]) {
      const world = new ManualClock();
      const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL }, { face });
      const line = board.transport();
      const options = { clock: world, machineClock: world, speed: 1, events: NO_EVENTS };
      const found = grblDriver.identify(line, options);
      if (isReset) board.restart();
      const { firmware } = await world.run(found, 30);
      expect(firmware).toBe(VERSIONS[face]);
      expect(CONTROLLERS.grbl.firmware.isOwn(firmware)).toBe(true);
      board.close();
    }
  });

  it.each([
    ["a Z axis", GRBL],
    ["a servo", GRBL_SERVO],
  ])(
    "plots with %s in the planned time, is paused and stopped, and overflows no buffer",
    async (_, ordinary) => {
      const machine = machineWith({ face }, ordinary);
      const settings = { ...SETTINGS, customMachine: machine };
      const { world, board, driver, begin, within } = await newPlotter({ face }, machine);
      const whole = await begin(new LocalPlanner(DRAWING), {}, settings);
      let toldS = 0;
      const startS = world.nowS();
      whole.onProgress(({ elapsedS, remainingS }) => (toldS ||= elapsedS + remainingS));
      expect(await within(whole.finished)).toEqual({ kind: "done" });
      const tookS = world.nowS() - startS;
      // The pen goes up before the plan begins.
      expect(tookS - toldS).toBeGreaterThan(-0.01 * toldS);
      expect(tookS - toldS).toBeLessThan(0.01 * toldS + 1);

      const run = await begin(new LocalPlanner(DRAWING), {}, settings);
      for (const stop of ["pause", "emergencyStop", "pause"] as const) {
        await world.advance(2.1);
        await world.run(run[stop]());
        expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
        await world.run(run.resume());
      }
      expect(await within(run.finished)).toEqual({ kind: "done" });
      expectDrawn(board as never, DRAWING, 0.02);
      expect(board.state()).toMatchObject({ penUp: true, lostCount: 0, earlyCount: 0 });
      // Braking along the path is no alarm.
      expect(driver.log().match(/ALARM/g) ?? []).toHaveLength(1);
    },
  );

  it("reports an alarm in words, lifts the pen and forgets the position", async () => {
    const { world, board, driver, begin, within } = await newPlotter({ face });
    const run = await begin();
    await world.advance(2.1);
    board.stopWith(1);
    expect(await within(run.finished)).toMatch(
      /^board-error: The Grbl has stopped with (ALARM: Hard limit|ALARM:1) \(a limit switch was hit\)/,
    );
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null });
  });
});

describe("the work offset of the user", () => {
  it.each(FACES)(
    "of a %s is never changed, wherever home is, and the plot is drawn from home",
    async (face) => {
      const { world, board, driver, begin, within } = await newPlotter({ face });
      // Another program's zero.
      await within(driver.command("G10L20P1X-30Y12Z1"));
      const { offsetMm } = board.state();
      expect(offsetMm).toEqual([30, -12, -1]);
      expect(await within(driver.move({ kind: "move-to", xMm: 40, yMm: 20 }))).toBeUndefined();
      expect(await within(driver.move({ kind: "set-home" }))).toBeUndefined();
      const run = await begin();
      await world.advance(2.1);
      await world.run(run.emergencyStop());
      await world.run(run.resume());
      expect(await within(run.finished)).toEqual({ kind: "done" });
      expect(board.state().offsetMm).toEqual(offsetMm);
      expect(board.state()).toMatchObject({ xMm: expect.closeTo(40, 2), yMm: expect.closeTo(20, 2) });
      expect(driver.state).toMatchObject({ xMm: expect.closeTo(0, 2), yMm: expect.closeTo(0, 2) });
      const first = board.drawn().find(({ penDown, xy }) => penDown && xy.length > 2)!.xy;
      expect(first[0]).toBeCloseTo(DRAWING.xy[0] + 40, 1);
      expect(first[1]).toBeCloseTo(DRAWING.xy[1] + 20, 1);
      // So is the zero of Z, above which the pen has its heights.
      expect(board.state()).toMatchObject({ penUp: true, zMm: expect.closeTo(4, 3) });
    },
  );
});

describe("a connection that was lost", () => {
  it("keeps home if the Grbl was not restarted, so that nothing is left out or drawn twice", async () => {
    const { world, board, driver, begin, line, within } = await newPlotter();
    expect(await within(driver.move({ kind: "move-to", xMm: 7, yMm: 5 }))).toBeUndefined();
    expect(await within(driver.move({ kind: "set-home" }))).toBeUndefined();
    await begin();
    await world.advance(3);
    line().unplug();
    await world.advance(6);
    const { xMm, yMm } = board.state();
    expect(driver.state).toMatchObject({ connection: "idle", penUp: true });
    expect(driver.state.xMm).toBeCloseTo(xMm - 7, 1);
    expect(driver.state.yMm).toBeCloseTo(yMm - 5, 1);
  });

  it("forgets home if the Grbl was restarted", async () => {
    const { world, board, driver, begin, line } = await newPlotter();
    await begin();
    await world.advance(3);
    line().unplug();
    board.restart();
    await world.advance(6);
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null });
  });
});

describe("lines of the controllers", () => {
  it.each([
    ["Grbl 1.1h ['$' for help]", "Grbl 1.1h"],
    ["Grbl 0.9i ['$' for help]", "Grbl 0.9i"],
    ["GrblHAL 1.1f ['$' or '$HELP' for help]", "grblHAL 1.1f"],
    ["grblHAL 1.1f ['$' or '$HELP' for help]", "grblHAL 1.1f"],
    ["Grbl 3.2 [FluidNC v3.2.7 (wifi) '$' for help]", "FluidNC 3.2.7"],
    ["Grbl 1.1h DrawCore V2.09 ['$' for help]", "DrawCore 2.09"],
    ["DrawCore V2.22.20260207", "DrawCore 2.22"],
  ])("%s greets as %s", (line, version) => {
    expect(isGreeting(line)).toBe(true);
    expect(versionOf(line)).toBe(version);
  });

  it.each(["Grbl", "ok", "EBBv13_and_above EB Firmware Version 2.8.1", "echo: Grbl 1.1", "[MSG:Grbl]"])(
    "%s is no greeting",
    (line) => {
      expect(isGreeting(line)).toBe(false);
      expect(versionOf(line)).toBeNull();
    },
  );

  it.each([
    ["<Idle,MPos:10.000,20.000,3.000,WPos:4.000,5.000,6.000>", [0, 0, 0], [4, 5, 6], [10, 20, 3]],
    ["<Run,MPos:1.000,-2.000,3.000,WPos:1.000,-2.000,3.000,Buf:3,RX:12>", [0, 0, 0], [1, -2, 3], [1, -2, 3]],
    ["<Idle,MPos:10.000,20.000,3.000>", [6, 15, -3], [4, 5, 6], [10, 20, 3]],
    ["<Idle,WPos:4.000,5.000,6.000,Buf:0>", [6, 15, -3], [4, 5, 6], [10, 20, 3]],
    ["<Hold,MPos:10.000,20.000,3.000,Buf:3,RX:12,Lim:000>", [6, 15, -3], [4, 5, 6], [10, 20, 3]],
    ["<Idle|MPos:10.000,20.000,3.000|FS:0,0>", [6, 15, -3], [4, 5, 6], [10, 20, 3]],
    ["<Idle|WPos:4.000,5.000,6.000|Bf:15,128|FS:0,0>", [6, 15, -3], [4, 5, 6], [10, 20, 3]],
  ] as const)("%s tells both positions", (line, offset, at, machineAt) => {
    expect(statusOf(line, offset, 1)).toMatchObject({ at, machineAt });
  });

  it("a report of 0.9 tells the work offset, if it has both positions", () => {
    expect(offsetOf("<Idle,MPos:10.000,20.000,3.000,WPos:4.000,5.000,6.000>")).toEqual([6, 15, -3]);
    expect(offsetOf("<Idle,MPos:10.000,20.000,3.000>")).toBeNull();
  });
});
