/** Boards whose replies are not in the form of the factory setting: the plot ends, once, or the board is refused at connecting. */
import { describe, expect, it } from "vitest";
import { PlotterConnection } from "../../../../host/plotter/plotter-connection.js";
import { VirtualBoard, type PlotwrightError, type Transport } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { ascii } from "../../../support/plots/virtual-plots.js";

type Bytes = (bytes: Uint8Array) => Uint8Array;

/** A connection that changes the board's bytes, and may return those of the host. */
function changed(transport: Transport, change: Bytes, isEchoing: boolean): Transport {
  let toHost: (bytes: Uint8Array) => void = () => undefined;
  return {
    write: (bytes) => {
      if (isEchoing) toHost(bytes);
      return transport.write(bytes);
    },
    onData: (listener) => {
      toHost = listener;
      transport.onData((bytes) => listener(change(bytes)));
    },
    onClose: (listener) => transport.onClose(listener),
    close: () => transport.close(),
  };
}

const lowerCase: Bytes = (bytes) => ascii(String.fromCharCode(...bytes).toLowerCase());
const unchanged: Bytes = (bytes) => bytes;

/** A plotter on a board that got these lines from another program. */
async function plotterWith(
  firmware: string,
  before: readonly string[],
  change = unchanged,
  isEchoing = false,
) {
  const world = new ManualClock();
  const board = new VirtualBoard({ clock: world, firmware, servo: {} });
  for (const line of before) board.receive(ascii(`${line}\r`));
  const driver = new PlotterConnection({
    device: "/dev/board",
    clock: world,
    devices: {
      find: () => Promise.resolve([]),
      open: () => Promise.resolve(changed(board.transport(), change, isEchoing)),
    },
  });
  await world.run(driver.start());
  return { world, board, driver };
}

describe.each(["2.4.4", "2.5.3", "2.8.1", "3.0.0", "3.0.3"])("on firmware %s", (firmware) => {
  it.each([
    ["in lower case", [], lowerCase],
    ["without OK, which another program has switched off", ["CU,1,0"], unchanged],
    ["in the other syntax, which another program has switched on", ["CU,10,1"], unchanged],
    ["in the other syntax, without OK and in lower case", ["CU,1,0", "CU,10,1"], lowerCase],
  ])("a board that answers %s plots the drawing once", async (_, before, change) => {
    const { world, board, driver } = await plotterWith(firmware, before, change);
    expect(driver.state).toMatchObject({ connection: "idle", firmware });
    const run = await world.run(driver.plot(new LocalPlanner(FAULT_DRAWING), DEFAULT_PLOT_SETTINGS));
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(driver.log()).not.toContain("belongs to no command");
    expect(compareDrawn(FAULT_DRAWING, board.drawn())).toMatchObject({
      gapMm: expect.closeTo(0, 1) as number,
      overlapMm: expect.closeTo(0, 1) as number,
    });
  });

  it.each([
    ["returns what is sent to it", unchanged],
    ["returns what is sent to it, and answers in lower case", lowerCase],
  ])("a port that %s is refused with words, and no plot begins", async (_, change) => {
    const { world, board, driver } = await plotterWith(firmware, [], change, true);
    expect(driver.state).toMatchObject({ connection: "absent" });
    expect(driver.state.message).toMatch(/^\/dev\/board: This port returns everything .*switch the echo off/);
    const refused = world.run(driver.plot(new LocalPlanner(FAULT_DRAWING), DEFAULT_PLOT_SETTINGS));
    expect(await refused.catch((error: PlotwrightError) => error.message)).toContain("echo");
    expect(board.statistics().moveCount).toBe(0);
  });
});
