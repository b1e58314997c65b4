import { describe, expect, it } from "vitest";
import { machineById, type MachineProfile, type PlotwrightError } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { virtualPlotter } from "../../../support/plots/virtual-plotter.js";

/** All inputs of the virtual board are its button: one switch for both axes, pressed beyond these positions. */
const SWITCH_X_MM = -7.3;
const SWITCH_Y_MM = -4.1;
const HOMING = { port: "B", pin: 0, pressed: 0 } as const;
const PLAIN = machineById("axidraw-v3");
const MACHINE: MachineProfile = {
  ...PLAIN,
  id: "switched",
  controller: { ...PLAIN.controller, homing: { x: HOMING, y: HOMING } },
};
const SETTINGS = { ...DEFAULT_PLOT_SETTINGS, machine: "switched", customMachine: MACHINE };

async function newPlotter(pressed: (x: number, y: number) => boolean) {
  const { world, driver, board } = await virtualPlotter({ settings: SETTINGS });
  board.onChange(() => {
    const { xMm, yMm } = board.state();
    board.holdButton(pressed(xMm, yMm));
  });
  return { world, driver, board };
}

describe("a machine with switches", () => {
  it("finds home with them, one axis at a time, and counts from there", async () => {
    let seen = { x: 0, y: 0 };
    const { world, driver, board } = await newPlotter((x, y) => {
      // Home sets the counters to 0: the last position before that is where it is.
      if (x !== 0 || y !== 0) seen = { x, y };
      return x < SWITCH_X_MM || y < SWITCH_Y_MM;
    });
    await world.run(driver.home());
    expect(driver.state).toMatchObject({ xMm: 0, yMm: 0, penUp: true, connection: "idle" });
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
    expect(Math.abs(seen.x - SWITCH_X_MM)).toBeLessThan(0.1);
    expect(Math.abs(seen.y - SWITCH_Y_MM)).toBeLessThan(0.1);
    await world.run(driver.moveTo(10, 5));
    expect(driver.state).toMatchObject({ xMm: 10, yMm: 5 });
  });

  it("reports a switch that is not met, and one that stays pressed", async () => {
    const failure = async (pressed: boolean): Promise<string> => {
      const { world, driver } = await newPlotter(() => pressed);
      return world
        .run(driver.home())
        .then(() => "done")
        .catch((error: PlotwrightError) => `${error.code}: ${error.message}`);
    };
    expect(await failure(false)).toMatch(/^board-error: .* moved 330 mm along x and reached no switch/);
    expect(await failure(true)).toMatch(/^board-error: The switch of x \(B0\) stays pressed/);
  });
});
