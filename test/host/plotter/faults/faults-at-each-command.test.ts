/**
 * A fault at each command of a plot: the plot ends, by itself or with an error, and can be resumed to its end. Nothing
 * waits endlessly. A host that is busy for seconds at any command is no fault at all.
 */
import { describe, expect, it } from "vitest";
import type { JournalEntry } from "../../../../host/plotter/plotter-port.js";
import { VirtualBoard } from "../../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../../src/schema/index.js";
import { PlotterConnection as HostDriver } from "../../../../host/plotter/plotter-connection.js";
import { StallingHost } from "../../../support/clocks/stalling-host.js";
import { compareDrawn } from "../../../support/drawings/drawn-truth.js";
import { IS_FULL } from "../../../support/runs/full-run.js";
import { LocalPlanner, strokesOf } from "../../../support/plots/local-planner.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";
import { virtualPlotter } from "../../../support/plots/virtual-plotter.js";
import { startAfter } from "../../../support/plots/start-after.js";

/** They do not cross, so that each point of the drawn line belongs to one of them. */
const STROKES = strokesOf([5, 5, 30, 5, 30, 12], [34, 12, 36, 5], [42, 8, 46, 24]);
/** Much longer than the plot with its returns home. */
const LIMIT_S = 120;
/** More than the replies after the last reading of the supply. */
const AFTER_LAST_READING = 6;

type Fault = (board: VirtualBoard, world: ManualClock) => void;

const FAULTS: Readonly<Record<string, Fault>> = {
  "the supply is off for 1 s": supplyOffFor(1),
  "the supply is off for 3 s": supplyOffFor(3),
  "the board restarts": (board) => board.restart(),
  "the cable is unplugged": (board) => board.unplug(),
  "three replies are lost": (board) => board.loseReplies(3),
  "the board is silent for 4 s": (board, world) => {
    board.setMute(true);
    world.after(4, () => board.setMute(false));
  },
  "the motion stands still for 5 s": (board, world) => {
    board.setFrozen(true);
    world.after(5, () => board.setFrozen(false));
  },
};

function supplyOffFor(offS: number): Fault {
  return (board, world) => {
    board.setMotorVolts(0);
    world.after(offS, () => board.setMotorVolts(9.1));
  };
}

/** Plots until the drawing is done. Returns the number of commands, and how each attempt ended. */
async function plotWith(fault: Fault, firmware: string, atCommand: number) {
  const { world, driver, board } = await virtualPlotter({ firmware });
  let commandCount = 0;
  board.onSend(() => {
    if (++commandCount === atCommand) fault(board, world);
  });
  const journal: JournalEntry[] = [];
  const outcomes: string[] = [];
  while (outcomes.at(-1) !== "done" && outcomes.length < 4) {
    for (let s = 0; s < LIMIT_S && driver.state.connection !== "idle"; s += 0.05) await world.advance(0.05);
    const plotting = driver.plot(new LocalPlanner(STROKES), DEFAULT_PLOT_SETTINGS, {
      ...startAfter(journal.at(-1)),
      held: false,
      journal: { record: (entry) => journal.push(entry) },
    });
    const run = await world.run(plotting, LIMIT_S);
    const ended = run.finished.then(
      ({ kind }) => kind,
      (error: Error) => error.message,
    );
    outcomes.push(await world.run(ended, LIMIT_S));
  }
  const gapMm = compareDrawn(STROKES, board.drawn()).gapMm;
  await world.run(driver.close(), LIMIT_S);
  return { commandCount, outcomes, gapMm };
}

/** So that commands last longer than the time between two polls, and the steps stay the same over several. */
const SLOW_PEN = {
  ...DEFAULT_PLOT_SETTINGS,
  pen: { ...DEFAULT_PLOT_SETTINGS.pen, extraDropMs: 900, extraLiftMs: 900 },
};

/** Plots on a host that does nothing for `busyS` from the board's given reply on. Returns the number of replies. */
async function plotWhileBusy(firmware: string, busyS: number, atReply: number): Promise<number> {
  const world = new ManualClock();
  const host = new StallingHost(world);
  const board = new VirtualBoard({ clock: world, firmware });
  const driver = new HostDriver({
    device: "a port",
    clock: host.clock,
    devices: {
      find: () => Promise.resolve([]),
      open: () => Promise.resolve(host.transport(board.transport())),
    },
  });
  await world.run(driver.start());
  let replyCount = 0;
  const run = await world.run(driver.plot(new LocalPlanner(STROKES), SLOW_PEN));
  board.onSend(() => {
    if (++replyCount === atReply) host.stallFor(busyS);
  });
  expect(await world.run(run.finished, LIMIT_S)).toEqual({ kind: "done" });
  await world.run(driver.close(), LIMIT_S);
  return replyCount;
}

describe.each(["2.8.1", "3.0.3"])("on firmware %s", (firmware) => {
  // Each begins at another reply, so that together they are at every third or so.
  it.each([0.2, 1.3, 1.7, 2.5, 5].map((busyS, i) => ({ busyS, from: IS_FULL ? 1 : 1 + 3 * i })))(
    "a host that is busy for $busyS s finishes its plot",
    { timeout: 120_000 },
    async ({ busyS, from }) => {
      const replyCount = await plotWhileBusy(firmware, 0, -1);
      for (let at = from; at <= replyCount; at += IS_FULL ? 1 : 13) await plotWhileBusy(firmware, busyS, at);
    },
  );

  it("a supply that fails for 3 s, also at the end, leaves no gap", { timeout: 120_000 }, async () => {
    const { commandCount, gapMm: roundedMm } = await plotWith(() => undefined, firmware, -1);
    for (let at = 1; at <= commandCount; at += IS_FULL ? 1 : 2) {
      const { gapMm } = await plotWith(supplyOffFor(3), firmware, at);
      expect(gapMm, `fault at command ${at}`).toBeLessThanOrEqual(roundedMm + 0.05);
    }
  });

  it("a supply that fails for 0.6 s ends the plot", { timeout: 120_000 }, async () => {
    const { commandCount } = await plotWith(() => undefined, firmware, -1);
    for (let at = 1; at <= commandCount - AFTER_LAST_READING; at += IS_FULL ? 1 : 2) {
      const { outcomes } = await plotWith(supplyOffFor(0.6), firmware, at);
      expect(outcomes[0], `fault at command ${at}`).toMatch(/no power/);
    }
  });

  it("a supply that returns at once does not disturb the next plot", { timeout: 120_000 }, async () => {
    const { commandCount } = await plotWith(() => undefined, firmware, -1);
    for (let at = 1; at <= commandCount; at += IS_FULL ? 1 : 3) {
      for (const offS of [0.6, 1]) {
        const { outcomes } = await plotWith(supplyOffFor(offS), firmware, at);
        expect(outcomes.join(" | "), `fault at command ${at}`).not.toContain("restarted");
      }
    }
  });

  it.each(Object.entries(FAULTS))("no plot hangs when %s", { timeout: 120_000 }, async (_, fault) => {
    const { commandCount } = await plotWith(() => undefined, firmware, -1);
    for (let at = 1; at <= commandCount; at += IS_FULL ? 1 : 7) {
      const { outcomes } = await plotWith(fault, firmware, at);
      expect(outcomes.at(-1), `fault at command ${at}: ${outcomes.join(" | ")}`).toBe("done");
    }
  });
});
