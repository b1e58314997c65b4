/** A board of another controller on a port that the user has chosen for this program, as in a browser. */
import { beforeAll, describe, expect, it } from "vitest";
import type { Devices } from "../../../../host/plotter/devices.js";
import { OtherBoards } from "../../../../host/plotter/other-board.js";
import { NamedPlotter } from "../../../../host/plotter/named-plotter.js";
import { PlotterRegistry } from "../../../../host/plotter/plotter-registry.js";
import type { PlotterRow } from "../../../../host/storage.js";
import { VirtualGrbl } from "../../../../src/drivers/grbl/virtual/virtual-grbl.js";
import { PlotwrightError, VirtualBoard, type Transport } from "../../../../src/index.js";
import { allDrivers, hasUsbId, inPageWords } from "../../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, type PlotSettings } from "../../../../src/schema/index.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { GRBL } from "../../../support/machines/machine.js";

const WITH_GRBL: PlotSettings = { ...DEFAULT_PLOT_SETTINGS, machine: GRBL.id, customMachine: GRBL };
const CHIPS = {
  ch340: { vendorId: "1a86", productId: "7523" },
  ebb: { vendorId: "04d8", productId: "fd92" },
};

// Loading a driver takes real time.
beforeAll(() => allDrivers());

/** USB sockets with names; `opened`: the names of the ports that were opened. */
function sockets() {
  const world = new ManualClock();
  const plugged = new Map<string, { chip: keyof typeof CHIPS; transport: () => Transport }>();
  const opened: string[] = [];
  const devices: Devices = {
    find: (ids) =>
      Promise.resolve(
        [...plugged]
          .filter(([, { chip }]) => hasUsbId(ids, CHIPS[chip].vendorId, CHIPS[chip].productId))
          .map(([path]) => ({ path, description: "", serialNumber: null })),
      ),
    open: (path) => {
      const device = plugged.get(path);
      if (!device) return Promise.reject(new PlotwrightError("no-board", "There is no such port."));
      opened.push(path);
      return Promise.resolve(device.transport());
    },
  };
  const grbl = new VirtualGrbl({ clock: world, speed: 1, machine: GRBL });
  const board = new VirtualBoard({ clock: world, servo: {} });
  const plugGrbl = (path: string): void =>
    void plugged.set(path, { chip: "ch340", transport: () => grbl.transport() });
  const plugBoard = (path: string): void =>
    void plugged.set(path, { chip: "ebb", transport: () => board.transport() });
  const newPlotter = (row: PlotterRow, settings = DEFAULT_PLOT_SETTINGS, isTaken = () => false) =>
    new NamedPlotter(row, {
      device: row.device,
      clock: world,
      devices,
      settings,
      otherBoards: new OtherBoards({ devices, clock: world }, isTaken),
    });
  return { world, plugged, opened, grbl, plugGrbl, plugBoard, newPlotter };
}
const ROW: PlotterRow = { id: "main", name: null, device: "auto", machine: null };

describe("a plotter whose model has an EiBotBoard", () => {
  it("names the Grbl that answers, and connects when a model with a Grbl is chosen", async () => {
    const { world, plugGrbl, newPlotter } = sockets();
    plugGrbl("one");
    const plotter = newPlotter(ROW);
    await world.run(plotter.start());
    expect(plotter.state).toMatchObject({
      connection: "absent",
      kind: "serial",
      message: expect.stringMatching(/^Grbl 1.1h answers on this port, but the model has another controller/),
      otherBoard: { answer: "Grbl 1.1h", controller: "grbl" },
    });
    // The page's control has another name in the first steps.
    expect(inPageWords(plotter.state.message!)).toMatch(/: choose your plotter's model\.$/);
    plotter.use(WITH_GRBL);
    await world.advance(1);
    await world.run(plotter.settled());
    expect(plotter.state).toMatchObject({ connection: "idle", firmware: "Grbl 1.1h", otherBoard: null });
  });

  it("asks it once while it is plugged in, and is virtual without it", async () => {
    const { world, plugged, opened, plugGrbl, newPlotter } = sockets();
    plugGrbl("one");
    const plotter = newPlotter(ROW);
    await world.run(plotter.start());
    await world.advance(30);
    expect(opened).toEqual(["one"]);
    expect(plotter.state).toMatchObject({ otherBoard: { answer: "Grbl 1.1h" } });
    plugged.delete("one");
    await world.advance(5);
    expect(plotter.state).toMatchObject({ connection: "idle", kind: "virtual", otherBoard: null });
  });

  it("leaves the port of another plotter alone, and takes an EiBotBoard before it asks", async () => {
    const { world, opened, plugGrbl, plugBoard, newPlotter } = sockets();
    plugGrbl("one");
    const other = newPlotter(ROW, DEFAULT_PLOT_SETTINGS, () => true);
    await world.run(other.start());
    expect(other.state).toMatchObject({ connection: "idle", kind: "virtual" });
    plugBoard("two");
    const plotter = newPlotter(ROW);
    await world.run(plotter.start());
    expect(plotter.state).toMatchObject({ connection: "idle", device: "two" });
    expect(opened).toEqual(["two"]);
  });
});

describe("a plotter whose model has a Grbl", () => {
  it("names the EiBotBoard that answers", async () => {
    const { world, plugBoard, newPlotter } = sockets();
    plugBoard("one");
    const plotter = newPlotter(ROW, WITH_GRBL);
    await world.run(plotter.start());
    expect(plotter.state.otherBoard).toEqual({ answer: "EiBotBoard 2.8.1", controller: "ebb" });
  });

  it("that is lost and connected again by the user is the same: its pen’s height is still known", async () => {
    const { world, plugged, grbl, plugGrbl, newPlotter } = sockets();
    plugGrbl("one");
    const registry = new PlotterRegistry({
      store: {
        plotters: () => [ROW],
        savePlotter: () => undefined,
        removePlotter: () => undefined,
        plotterSettings: () => ({}),
        savePlotterSettings: () => undefined,
      },
      announce: () => undefined,
      findBoards: () => Promise.resolve([]),
      askPorts: () => Promise.resolve([]),
      withMachine: (settings) => settings,
      firstId: ROW.id,
      open: (row) => {
        const plotter = newPlotter(row, WITH_GRBL);
        void plotter.start();
        return plotter;
      },
    });
    const use = { isPlotterBusy: () => false, liveJobCount: () => 0 };
    const plotter = (): NamedPlotter => registry.ports.get(ROW.id) as NamedPlotter;
    await world.run(plotter().settled());
    await world.run(plotter().pen({ up: true }));
    const { zMm } = grbl.state();
    // It restarts where its pen is up, and counts from there.
    plugged.clear();
    grbl.unplug();
    grbl.restart();
    await world.advance(5);
    expect(plotter().state.connection).toBe("absent");
    plugGrbl("two");
    await world.run(registry.reconnect(ROW.id, use));
    await world.run(plotter().settled());
    expect(plotter().state).toMatchObject({ connection: "idle", device: "two" });
    await world.run(plotter().pen({ up: false }));
    await world.run(plotter().pen({ up: true }));
    expect(grbl.state().zMm).toBeCloseTo(zMm, 3);
  });
});
