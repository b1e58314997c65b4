/** A Grbl that finds home with its switches ($H). */
import { describe, expect, it } from "vitest";
import { findsHome } from "../../../../src/drivers/registry.js";
import type { GrblController } from "../../../../src/drivers/grbl/model/grbl-controller.js";
import type { MachineProfile } from "../../../../src/index.js";
import { GRBL, GRBL_SERVO } from "../../../support/machines/machine.js";
import { LIMIT_S, machineWith, newPlotter, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { DRAWING, expectDrawn } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";

const withSwitches = (machine: MachineProfile<GrblController>): MachineProfile => ({
  ...machine,
  controller: { ...machine.controller, homing: true },
});

async function plotter(
  machine: MachineProfile<GrblController>,
  settings: Record<number, number> = { 22: 1 },
) {
  const homes = withSwitches(machine);
  const all = await newPlotter({ settings }, homes);
  const own = { ...SETTINGS, customMachine: homes };
  return { ...all, own, start: () => all.begin(new LocalPlanner(DRAWING), {}, own) };
}

it.each(["1.1", "0.9", "grblHAL", "FluidNC", "DrawCore"] as const)(
  "a %s finds home, whether or not it reports its state meanwhile",
  async (face) => {
    const homes = withSwitches(machineWith({ face }) as typeof GRBL);
    const { board, begin, within } = await newPlotter({ face, settings: { 22: 1 } }, homes);
    const run = await begin(new LocalPlanner(DRAWING), {}, { ...SETTINGS, customMachine: homes });
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
  },
);

describe.each([
  ["a Z axis", GRBL],
  ["a servo", GRBL_SERVO],
])("a Grbl with switches and %s", (_, machine) => {
  it("finds home before its first plot, although it is locked, and draws from there", async () => {
    const { board, driver, start, within } = await plotter(machine);
    expect(board.state().state).toBe("Alarm");
    expect(driver.log()).not.toMatch(/> \$[XH]/);
    expect(await within((await start()).finished)).toEqual({ kind: "done" });
    expect(driver.log().match(/> \$H/g)).toHaveLength(1);
    expectDrawn(board as never, DRAWING, 0.02);
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true, earlyCount: 0 });
    expect(board.state().offsetMm).toEqual([0, 0, 0]);
  });

  it("finds home again when its position is lost, and leaves nothing out", async () => {
    const { world, board, driver, start, within } = await plotter(machine);
    const run = await start();
    await world.advance(14);
    board.restart();
    expect(await within(run.finished)).toMatch(/^board-error: The Grbl has restarted/);
    expect(driver.state.xMm).toBeNull();
    expect(await within((await start()).finished)).toEqual({ kind: "done" });
    expect(driver.log().match(/> \$H/g)).toHaveLength(2);
    expectDrawn(board as never, DRAWING, 0.02);
  });

  it("is sent home by hand, and stopped on its way", async () => {
    const { world, board, driver, within } = await plotter(machine);
    const seeking = within(driver.move({ kind: "home" }));
    await world.advance(3);
    await world.run(driver.stopMove(), LIMIT_S);
    expect(await seeking).toMatch(/^conflict/);
    await world.advance(3);
    expect(driver.state.xMm).toBeNull();
    expect(await within(driver.move({ kind: "home" }))).toBeUndefined();
    expect(driver.state).toMatchObject({ connection: "idle", xMm: 0, yMm: 0, penUp: true });
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0 });
  });
});

describe.each(["1.1", "0.9"] as const)("a %s on its way home", (face) => {
  const onItsWay = async () => {
    const homes = withSwitches(GRBL);
    const all = await newPlotter({ face, settings: { 22: 1 } }, homes);
    const seeking = all.within(all.driver.move({ kind: "home" }));
    await all.world.advance(3);
    return { ...all, seeking };
  };

  it("is stopped at once, stays connected, and finds home again", async () => {
    const { world, board, driver, within, seeking } = await onItsWay();
    await world.run(driver.stopMove(), LIMIT_S);
    expect(await seeking).toMatch(/^conflict: /);
    await world.advance(3);
    expect(driver.state).toMatchObject({ connection: "idle", xMm: null });
    expect(driver.log()).not.toMatch(/The Grbl has (stopped|restarted)/);
    expect(await within(driver.move({ kind: "home" }))).toBeUndefined();
    expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0, penUp: true });
  });

  it("is stopped at once before a plot, which can go on then", async () => {
    const homes = withSwitches(GRBL);
    const own = { ...SETTINGS, customMachine: homes };
    const { world, board, driver, begin, within } = await newPlotter({ face, settings: { 22: 1 } }, homes);
    const run = await begin(new LocalPlanner(DRAWING), {}, own);
    await world.advance(2);
    await world.run(run.emergencyStop(), LIMIT_S);
    await world.advance(3);
    expect(driver.state).toMatchObject({ connection: "busy", xMm: null });
    expect(driver.log()).not.toMatch(/The Grbl has (stopped|restarted)/);
    await world.run(run.resume(), LIMIT_S);
    expect(await within(run.finished)).toEqual({ kind: "done" });
    expectDrawn(board as never, DRAWING, 0.02);
  });

  it("says which alarm has stopped it", async () => {
    const { board, seeking } = await onItsWay();
    board.takeFromOther("\x18");
    expect(await seeking).toMatch(
      face === "0.9"
        ? /The Grbl has stopped with ALARM: Homing fail \(a switch was not found/
        : /The Grbl has stopped with ALARM:6 \(the machine was reset while it sought its switches\)/,
    );
  });
});

it("a profile with switches on a Grbl without homing is refused in words, and nothing moves", async () => {
  const { board, start, within } = await plotter(GRBL, {});
  expect(await within((await start()).finished)).toMatch(/^bad-setting: .*homing is off \(\$22=0\)/);
  expect(board.state()).toMatchObject({ state: "Idle", xMm: 0, yMm: 0 });
});

it("only a profile that says so finds home", () => {
  expect(findsHome(GRBL)).toBe(false);
  expect(findsHome(withSwitches(GRBL))).toBe(true);
});
