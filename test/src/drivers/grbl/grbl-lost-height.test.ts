/**
 * The height of a pen on a Z axis without switches: a Grbl counts it from wherever the pen is when it is reset. Nothing of a
 * continued plot is drawn from an unknown height: the plotter says that it is unsure, and takes the height at which the user
 * brings the pen back as that at which the machine is switched on.
 */
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import type { MachineProfile } from "../../../../src/index.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { GRBL, GRBL_SERVO } from "../../../support/machines/machine.js";
import { newPlotter, plotterOn, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";

const LINES = strokesOf([10, 10, 120, 10], [120, 20, 10, 60]);
/** What a Grbl's buffers hold is drawn by then. */
const REST_S = 15;
/** On the first line. */
const KILL_S = 1.5;
const UP_MM = GRBL.controller.penUpZMm;
const MOST_MM = 0.05;

/** A plot whose process is killed, and the next process. `restarts`: the Grbl is reset between the two. */
async function killed(restarts: boolean, machine: MachineProfile = GRBL) {
  const settings = { ...SETTINGS, customMachine: machine };
  const { world, board, ...first } = await newPlotter({}, machine);
  const journal: JournalEntry[] = [];
  const record = (entry: JournalEntry): void => void journal.push(entry);
  await first.begin(new LocalPlanner(LINES), { journal: { record } }, settings);
  await world.advance(KILL_S);
  const { place: from, received } = journal.at(-1)!;
  first.kill();
  await world.advance(REST_S);
  if (restarts) board.restart();
  const next = await plotterOn(board, world, machine);
  const held = () => next.begin(new LocalPlanner(LINES), { from, received }, settings);
  return { world, board, ...next, held };
}

const isUnsure = ({ driver }: Pick<Awaited<ReturnType<typeof killed>>, "driver">): boolean =>
  driver.state.heightUnsure;

describe("the height of the pen after a kill", () => {
  it("is unsure if the Grbl was reset, until the plot goes on", async () => {
    const { world, board, driver, held } = await killed(true);
    expect(driver.state).toMatchObject({ heightUnsure: true, xMm: null });
    const run = await held();
    expect(driver.state.heightUnsure).toBe(true);
    board.pushHome();
    board.pushPen(0);
    await world.run(run.resume());
    expect(driver.state.heightUnsure).toBe(false);
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    const { gapMm, awayMm } = compareDrawn(LINES, board.drawn());
    expect(gapMm).toBeLessThan(MOST_MM);
    expect(awayMm).toBeLessThan(MOST_MM);
    expect(board.state().zMm).toBeCloseTo(UP_MM, 3);
  });

  it.each([
    ["switched the motors off", (driver: Plotter["driver"]) => driver.motorsOff()],
    ["moved it", (driver: Plotter["driver"]) => driver.pen({ up: false, heightPct: 45 })],
    [
      "set home and lifted it",
      async (driver: Plotter["driver"]) => {
        await driver.move({ kind: "set-home" });
        await driver.pen({ up: true });
      },
    ],
  ])("is where the user brings it, also after a button has %s", async (_, press) => {
    const all = await killed(true);
    const { world, board, driver, held } = all;
    board.pushHome();
    await world.run(press(driver));
    expect(isUnsure(all)).toBe(true);
    const run = await held();
    board.pushPen(0);
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(compareDrawn(LINES, board.drawn()).gapMm).toBeLessThan(MOST_MM);
    expect(board.state().zMm).toBeCloseTo(UP_MM, 3);
  });

  it("is that of the next process, too, if that ends before the plot goes on", async () => {
    const { world, board, held, kill } = await killed(true);
    await held();
    kill();
    expect(isUnsure(await plotterOn(board, world))).toBe(true);
  });

  it("is sure if the Grbl was not reset, or moves it with a servo", async () => {
    expect(isUnsure(await killed(false))).toBe(false);
    expect(isUnsure(await killed(true, GRBL_SERVO))).toBe(false);
    expect(isUnsure(await killed(false, GRBL_SERVO))).toBe(false);
  });

  it("is found by a machine that homes its Z axis with switches", async () => {
    const homes = { ...GRBL, controller: { ...GRBL.controller, homing: true } };
    const { world, board } = await newPlotter({ settings: { 22: 1 } }, homes);
    board.restart();
    expect(isUnsure(await plotterOn(board, world, homes))).toBe(false);
  });
});

type Plotter = Awaited<ReturnType<typeof plotterOn>>;

describe("the height of the pen on a Grbl that is connected", () => {
  it("is unsure after a reset that comes while the cable is unplugged in a plot, and sure after one at rest", async () => {
    for (const inPlot of [true, false]) {
      const { world, board, driver, begin, line } = await newPlotter();
      const run = await begin(new LocalPlanner(LINES));
      run.finished.catch(() => undefined);
      if (inPlot) await world.advance(KILL_S);
      else await world.run(run.finished);
      line().unplug();
      board.restart();
      await world.advance(REST_S);
      expect(driver.state).toMatchObject({ connection: "idle", heightUnsure: inPlot });
    }
  });

  it("is not asked for in a plot that begins, whatever the buttons did before", async () => {
    const { world, board, driver, begin } = await newPlotter();
    await world.run(driver.pen({ up: true }));
    const run = await begin(new LocalPlanner(LINES));
    await world.advance(KILL_S);
    await world.run(run.pause());
    expect(driver.state.heightUnsure).toBe(false);
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(compareDrawn(LINES, board.drawn()).gapMm).toBeLessThan(MOST_MM);
    expect(board.state().zMm).toBeCloseTo(UP_MM, 3);
  });
});
