/**
 * Refused lines and alarms at awkward moments: in arcs, several at once, after a hold, in a recovery. The pen is up in the end,
 * and nothing is left out. Then a Grbl that stays locked, and what the numbers mean.
 */
import { describe, expect, it } from "vitest";
import type { JournalEntry, RunningPlot } from "../../../../host/plotter/plotter-port.js";
import { alarm, refusal } from "../../../../src/drivers/grbl/protocol.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { ROUND_DRAWING } from "../../../support/drawings/round-drawing.js";
import { GRBL, GRBL_SERVO } from "../../../support/machines/machine.js";
import { machineWith, newPlotter, SETTINGS } from "../../../support/plots/grbl-plotter.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { LocalPlanner } from "../../../support/plots/local-planner.js";
import { outcome } from "../../../support/plots/virtual-plotter.js";
import { cases } from "../../../support/runs/full-run.js";

type World = Awaited<ReturnType<typeof newPlotter>>;

const GAP_MM = 0.05;
/** The longest stroke of the drawing, and one short. */
const TWICE_MM = 140;
/** The drawing takes longer than that, s. */
const PLOT_S = 12;

const FAULTS: Readonly<Record<string, (world: World, run: RunningPlot) => Promise<void> | void>> = {
  "a refused line": ({ board }) => board.spoil("refused"),
  "two refused lines": ({ board }) => board.spoil("refused", 2),
  "five refused lines": ({ board }) => board.spoil("refused", 5),
  "a refused line after a pause": async ({ board, world }, run) => {
    await world.run(run.pause());
    run.resume().catch(() => undefined);
    await world.advance(0.3);
    board.spoil("refused");
  },
  "a refused line while it slows down for a pause": async ({ board, world }, run) => {
    run.pause().catch(() => undefined);
    board.spoil("refused");
    await world.advance(3);
    run.resume().catch(() => undefined);
  },
  "a refused line after its hold button": async ({ board, world }, run) => {
    board.pressHold();
    await world.advance(3);
    board.spoil("refused");
    await world.run(run.resume());
  },
  "a hit switch": ({ board }) => board.stopWith(1),
  "a hit switch, and again while the pen is lifted": async ({ board, world }) => {
    board.stopWith(1);
    await world.advance(0.1);
    board.stopWith(1);
  },
  "a refused line, and then a hit switch": async ({ board, world }) => {
    board.spoil("refused");
    await world.advance(0.05);
    board.stopWith(1);
  },
};

describe.each(["1.1", "0.9", "grblHAL", "FluidNC", "DrawCore"] as const)("a plot on a %s", (face) => {
  it.each(Object.entries(FAULTS))("%s", { timeout: 60_000 }, async (name, fault) => {
    const random = seeded(name.length);
    for (const ordinary of [GRBL, GRBL_SERVO]) {
      for (let i = 0; i < cases(12, 2); i++) {
        const machine = machineWith({ face }, ordinary);
        const plotter = await newPlotter({ face }, machine);
        const { world, board, driver, begin } = plotter;
        const settings = { ...SETTINGS, customMachine: machine };
        const journal: JournalEntry[] = [];
        const record = (entry: JournalEntry): void => void journal.push(entry);
        const run = await begin(new LocalPlanner(ROUND_DRAWING), { journal: { record } }, settings);
        const atS = 0.5 + (PLOT_S - 0.5) * random();
        await world.advance(atS);
        const isOver = outcome(run.finished.then(({ kind }) => kind));
        await fault(plotter, run);
        const ended = String(await world.run(isOver, 60));
        await world.advance(15);
        const { connection, penUp, xMm } = driver.state;
        const { penUp: isUp } = board.state();
        expect({ atS, connection, penUp, isUp }).toEqual({
          atS,
          connection: "idle",
          penUp: true,
          isUp: true,
        });
        if (xMm === null) board.pushHome();
        if (driver.state.heightUnsure) board.pushPen(0);
        if (ended !== "done") {
          expect(ended).toMatch(/^board-error: The Grbl (refused \S+ with error:|has stopped with ALARM:)/);
          const { place: from, received } = journal.at(-1) ?? {};
          const again = { from, received, held: false };
          const rest = await begin(new LocalPlanner(ROUND_DRAWING), again, settings);
          await world.run(rest.finished, 60);
        }
        const { gapMm, overlapMm } = compareDrawn(ROUND_DRAWING, board.drawn());
        expect({ atS, gapMm }.gapMm).toBeLessThan(GAP_MM);
        expect({ atS, overlapMm }.overlapMm).toBeLessThan(TWICE_MM);
      }
    }
  });
});

describe("a Grbl that stays locked", () => {
  it("by its emergency stop says so, and lifts the pen when it is released", async () => {
    const { world, board, driver, begin, within } = await newPlotter({ face: "grblHAL" });
    const run = await begin();
    await world.advance(3);
    expect(board.state().penUp).toBe(false);
    board.setStop(true);
    expect(await within(run.finished)).toMatch(
      /^board-error: The Grbl has stopped with ALARM:10 \(its emergency stop was pressed\)\..* The Grbl stays locked, and nothing moves\. .* When the cause is gone, it is unlocked and the pen is lifted\.$/,
    );
    await world.advance(10);
    expect(driver.state).toMatchObject({ connection: "fault" });
    expect(driver.state.message).toMatch(
      /The Grbl stays locked.* refused \$X with error:50 \(its emergency stop is pressed: release it\)\./,
    );
    expect(driver.state.message).not.toMatch(/door/);
    board.setStop(false);
    await world.advance(15);
    expect(driver.state).toMatchObject({ connection: "idle", penUp: true, xMm: null });
    expect(board.state()).toMatchObject({ state: "Idle", penUp: true });
  });
});

describe("a number", () => {
  it.each([
    ["error:45", "grblHAL 1.1f", /\(a limit switch is pressed: move the carriage off it\)/],
    ["error:79", "grblHAL 1.1f", /\(that is not allowed after an emergency stop/],
    ["error:152", "FluidNC 3.7.16", /\(its configuration is faulty/],
    ["error:40", "FluidNC 3.7.16", /\(one of its inputs is on/],
    ["error:40", "grblHAL 1.1f", /\(it waits for another tool\)/],
    ["error:40", "Grbl 1.1h", /error:40\. If/],
    ["error:9", "FluidNC 3.7.16", /\(the machine is locked/],
    ["error: Unsupported command", "Grbl 0.9j", /with error: Unsupported command\. If/],
  ])("%s means of a %s what that says", (reply, version, words) => {
    expect(refusal("G1X1", reply, version).message).toMatch(words);
  });

  it.each([
    [10, "Grbl 1.1h", /ALARM:10 \(the second switch of an axis with two motors was not found\)/],
    [10, "grblHAL 1.1f", /ALARM:10 \(its emergency stop was pressed\)/],
    [10, "FluidNC 3.7.16", /ALARM:10 \(its spindle reports a fault\)/],
    [14, "FluidNC 3.7.16", /ALARM:14 \(it must be homed first\)/],
    [11, "grblHAL 1.1f", /ALARM:11 \(it must be homed first\)/],
    [17, "grblHAL 1.1f", /ALARM:17 \(a motor driver reports a fault\)/],
    [17, "Grbl 1.1h", /ALARM:17\. Check/],
  ])("ALARM:%i means of a %s what that says", (code, version, words) => {
    expect(alarm(code, { version, findsHome: false }).message).toMatch(words);
  });
});
