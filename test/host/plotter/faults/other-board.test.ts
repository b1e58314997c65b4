/** A plot that is interrupted and resumed on another board, which was used before and so knows a position of its own. */
import { describe, expect, it } from "vitest";
import { PlotterConnection } from "../../../../host/plotter/plotter-connection.js";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import { VirtualBoard } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { FAULT_DRAWING } from "../../../support/plots/faulty-plots.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { ascii } from "../../../support/plots/virtual-plots.js";
import { startAfter } from "../../../support/plots/start-after.js";

interface Kind {
  readonly name: string;
  readonly serialNumber: string | null;
  readonly firmware: string;
}

const PATH = "/dev/board";
const A: Kind = { name: "", serialNumber: null, firmware: "3.0.3" };

/** What is known after a plot on one board is interrupted and continued, on the same board or on another one. */
async function continuedOn(first: Kind, second: Kind, isSame = false) {
  const world = new ManualClock();
  const boardOf = ({ name, firmware }: Kind): VirtualBoard => {
    const board = new VirtualBoard({ clock: world, firmware, servo: {} });
    if (name !== "") board.receive(ascii(`ST,${name}\r`));
    return board;
  };
  const boards = [boardOf(first), boardOf(second)];
  let plugged = 1;
  const driver = new PlotterConnection({
    device: PATH,
    clock: world,
    devices: {
      find: () =>
        Promise.resolve([
          { path: PATH, description: "EBB", serialNumber: [first, second][plugged].serialNumber },
        ]),
      open: () => Promise.resolve(boards[plugged].transport()),
    },
  });
  const plug = async (which: number): Promise<void> => {
    const unplugged = boards[plugged];
    plugged = which;
    unplugged.unplug();
    while (driver.state.connection !== "idle") await world.advance(0.1);
  };
  await world.run(driver.start());
  await world.run(driver.move({ kind: "move-to", xMm: 80, yMm: 60 }));
  await plug(0);
  const journal: JournalEntry[] = [];
  const planner = new LocalPlanner(FAULT_DRAWING);
  const run = await world.run(
    driver.plot(planner, DEFAULT_PLOT_SETTINGS, { journal: { record: (entry) => journal.push(entry) } }),
  );
  const ended = run.finished.catch(() => undefined);
  await world.advance(3);
  await plug(isSame ? 0 : 1);
  await world.run(ended);
  const last = journal.at(-1)!;
  expect(last.board).toMatchObject({ boardSerialNumber: first.serialNumber, firmware: first.firmware });
  const again = await world.run(
    driver.plot(planner, DEFAULT_PLOT_SETTINGS, { ...startAfter(last), held: true }),
  );
  const { xMm } = driver.state;
  const { motorsOn, penUp } = boards[plugged].state();
  const found = { isKnown: xMm !== null, motorsOn, penUp, isFromJournal: again.holdPlace === last.place };
  await world.run(Promise.all([again.leave(), again.finished]));
  await world.run(driver.close());
  return found;
}

describe("a plot that is continued on another board", () => {
  it.each([
    ["another name", { ...A, name: "left" }, { ...A, name: "right" }],
    ["a name that the first has not", A, { ...A, name: "right" }],
    ["another serial number", { ...A, serialNumber: "1" }, { ...A, serialNumber: "2" }],
    ["another firmware", A, { ...A, firmware: "2.8.1" }],
  ])(
    "a plot does not believe the position of a board with %s, and can be pushed to home",
    async (_, first, second) => {
      const found = { isKnown: false, motorsOn: false, penUp: true, isFromJournal: true };
      expect(await continuedOn(first, second)).toEqual(found);
    },
  );

  it("a plot believes the position of its own board", async () => {
    const named = { ...A, name: "left", serialNumber: "1" };
    expect(await continuedOn(named, named, true)).toMatchObject({ isKnown: true, motorsOn: true });
    expect(await continuedOn(A, A, true)).toMatchObject({ isKnown: true, motorsOn: true });
  });

  it("a plot believes the position of a board whose serial number can't be read at one of the times", async () => {
    const found = await continuedOn({ ...A, serialNumber: "1" }, A);
    expect(found).toMatchObject({ isKnown: true });
  });
});
