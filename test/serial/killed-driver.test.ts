/**
 * kill -9 of a plotting process, or a pulled cable, over a real pseudo-terminal, while it draws a line that passes the
 * same places several times: the counters match several of them. PLOTWRIGHT_FAULTS=20, or the full run: 20 times each.
 */
import { fork } from "node:child_process";
import { once } from "node:events";
import { describe, expect, it } from "vitest";
import { NodePlotter } from "../support/plots/node-plotter.js";
import { JOURNAL_S, PROGRESS_S } from "../../host/plotter/resume-position.js";
import type { JournalEntry } from "../../host/plotter/plotter-port.js";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { childScript, nextMessage } from "../support/processes/child-script.js";
import { untilIdle, untilUnderWay, waitS } from "../support/plots/faulty-plots.js";
import { plotting, seeded } from "../support/plots/live-plot.js";
import { LocalPlanner, strokesOf } from "../support/plots/local-planner.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { countFor } from "../support/runs/full-run.js";
import { startAfter } from "../support/plots/start-after.js";

const COUNT = countFor("PLOTWRIGHT_FAULTS", 20, 1);
const FIRMWARES = COUNT > 1 ? ["2.8.1", "3.0.3"] : ["2.8.1"];

/** Loops of about 25 mm, each overlapping the one before. */
const LOOPS = Array.from({ length: 900 }, (_, i) => [
  30 + 0.008 * i + 4 * Math.cos(i / 9),
  30 + 0.01 * i + 4 * Math.sin(i / 9),
]).flat();
/** There and back three times: each place is passed six times, and a kill may come just before or after a turn. */
const BACK = [5, 5, 35, 5, 5, 5, 35, 5, 5, 5, 35, 5, 5, 5];
const EARLIEST_S = 0.8;
const LATEST_S = 4;
/** Missing or doubled: rounding to steps, and the place within the tolerance of a crossing. */
const MOST_MM = 0.3;
/** Drawn twice where the line may have turned: what the board had not acknowledged, as far as the host knew. */
const { motion, sendAheadMs } = DEFAULT_PLOT_SETTINGS;
const TURNED_MM = motion.draw.speedMmPerS * (sendAheadMs / 1_000 + JOURNAL_S + PROGRESS_S);

const DRAWINGS = [
  { name: "a line that crosses itself", line: LOOPS, mostMm: MOST_MM },
  { name: "a line there and back", line: BACK, mostMm: TURNED_MM },
] as const;

// They mostly wait, so they run side by side.
describe.concurrent.each(FIRMWARES)("a plot on firmware %s", (firmware) => {
  describe.each(DRAWINGS)("of $name", ({ name, line, mostMm }) => {
    it.each([
      ["killed", killed],
      ["unplugged", unplugged],
    ] as const)(
      "leaves nothing out and draws no more twice than it must if it is %s",
      { timeout: 60_000 + 40_000 * COUNT },
      async (how, interrupt) => {
        const random = seeded(17 + name.length + how.length);
        const { world, board, run } = await plotting(motion.mode, strokesOf(line), firmware);
        await world.run(run.finished);
        const wholeMm = lengthMm(board.drawn());
        const offMm: number[] = [];
        for (let i = 0; i < COUNT; i++) {
          const afterS = EARLIEST_S + (LATEST_S - EARLIEST_S) * random();
          offMm.push((await resumedAfter(interrupt, firmware, line, afterS)) - wholeMm);
        }
        expect(offMm.filter((mm) => mm < -MOST_MM || mm > mostMm)).toEqual([]);
      },
    );
  });
});

/** Turns included. The steps' zigzag, which lengthens a slanting line, is left out by measuring every 0.2 mm. */
function lengthMm(drawn: readonly { readonly penDown: boolean; readonly xy: ArrayLike<number> }[]): number {
  let sumMm = 0;
  for (const { penDown, xy } of drawn) {
    if (!penDown || xy.length < 4) continue;
    let from = 0;
    for (let i = 2; i < xy.length; i += 2) {
      const mm = Math.hypot(xy[i] - xy[from], xy[i + 1] - xy[from + 1]);
      if (mm < 0.2 && i + 2 < xy.length) continue;
      sumMm += mm;
      from = i;
    }
  }
  return sumMm;
}

type Interrupt = (board: PtyBoard, line: readonly number[], afterS: number) => Promise<JournalEntry>;

async function killed(board: PtyBoard, line: readonly number[], afterS: number): Promise<JournalEntry> {
  const child = fork(childScript("plot-child"), [board.path, JSON.stringify([line])], { execArgv: [] });
  const journal: JournalEntry[] = [];
  child.on("message", (entry: JournalEntry) => journal.push(entry));
  await nextMessage(child);
  await waitS(afterS);
  child.kill("SIGKILL");
  await once(child, "exit");
  return journal[journal.length - 1];
}

async function unplugged(board: PtyBoard, line: readonly number[], afterS: number): Promise<JournalEntry> {
  const driver = new NodePlotter({ device: board.path });
  try {
    await driver.start();
    const journal: JournalEntry[] = [];
    const run = await driver.plot(new LocalPlanner(strokesOf(line)), DEFAULT_PLOT_SETTINGS, {
      journal: { record: (entry) => journal.push(entry) },
    });
    await untilUnderWay(run);
    await waitS(afterS);
    board.tell({ type: "unplug" });
    await expect(run.finished).rejects.toThrow();
    await waitS(1);
    board.tell({ type: "replug" });
    return journal[journal.length - 1];
  } finally {
    await driver.close();
  }
}

/** mm on the paper at the end. */
async function resumedAfter(
  interrupt: Interrupt,
  firmware: string,
  line: readonly number[],
  afterS: number,
): Promise<number> {
  const board = await PtyBoard.open({ firmware, wakeful: true });
  try {
    const last = await interrupt(board, line, afterS);
    const driver = new NodePlotter({ device: board.path });
    try {
      await driver.start();
      await untilIdle(driver);
      const run = await driver.plot(
        new LocalPlanner(strokesOf(line)),
        DEFAULT_PLOT_SETTINGS,
        startAfter(last),
      );
      await run.resume();
      expect(await run.finished).toEqual({ kind: "done" });
    } finally {
      await driver.close();
    }
    const { drawn } = await board.report();
    return lengthMm(drawn);
  } finally {
    await board.close();
  }
}
