/** A plotter whose machine is changed to one with another controller, while its board is off or moves. */
import { describe, expect, it } from "vitest";
import { PlotterConnection } from "../../../../host/plotter/plotter-connection.js";
import { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { PlotwrightError, type Transport } from "../../../../src/index.js";
import { allDrivers } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../../src/schema/index.js";
import { GRBL } from "../../../support/machines/machine.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";

const WITH_GRBL: PlotSettings = { ...DEFAULT_PLOT_SETTINGS, machine: GRBL.id, customMachine: GRBL };

/** The default machine has an EiBotBoard, but a Grbl is on the port, at first switched off. */
async function newPlotter() {
  // Loading a driver takes real time.
  await allDrivers();
  const world = new ManualClock();
  const board = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL });
  const port = { isOff: true };
  const open = (): Promise<Transport> =>
    port.isOff
      ? Promise.reject(new PlotwrightError("no-board", "There is no such port."))
      : Promise.resolve(board.transport());
  const devices = { find: () => Promise.resolve([]), open };
  const driver = new PlotterConnection({ device: "a port", clock: world, devices });
  await world.run(driver.start());
  return { world, driver, port };
}

describe("a machine with another controller, chosen while the board is off", () => {
  it("is used as soon as the board is on", async () => {
    const { world, driver, port } = await newPlotter();
    driver.use(WITH_GRBL);
    await world.advance(5);
    expect(driver.state.connection).toBe("absent");
    port.isOff = false;
    await world.advance(5);
    expect(driver.state).toMatchObject({ connection: "idle", firmware: "Grbl 1.1h" });
  });

  it("stays the plotter's machine after a job of another machine could not start", async () => {
    const { world, driver, port } = await newPlotter();
    driver.use(WITH_GRBL);
    await world.advance(1);
    const job = world.run(driver.plot(new LocalPlanner(strokesOf([1, 1, 2, 2])), DEFAULT_PLOT_SETTINGS));
    await expect(job).rejects.toMatchObject({ code: "no-board" });
    port.isOff = false;
    await world.advance(5);
    expect(driver.state).toMatchObject({ connection: "idle", firmware: "Grbl 1.1h" });
  });
});

it("a machine with another controller, chosen during a move, is used after it", async () => {
  const world = new ManualClock();
  const driver = new PlotterConnection({
    device: "virtual",
    clock: world,
    devices: { find: () => Promise.resolve([]), open: () => Promise.reject(new Error("no port")) },
  });
  await world.run(driver.start());
  const move = driver.move({ kind: "move-to", xMm: 30, yMm: 20 });
  await world.advance(0.3);
  driver.use(WITH_GRBL);
  await world.advance(0.1);
  expect(driver.state).toMatchObject({ activity: "moving", firmware: "2.8.1" });
  await world.run(move);
  await world.advance(1);
  expect(driver.state).toMatchObject({ connection: "idle", firmware: "Grbl 1.1h" });
});
