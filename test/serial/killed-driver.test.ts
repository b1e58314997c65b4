/**
 * kill -9 of a plotting process, over a real pseudo-terminal, while it draws a line that crosses itself many
 * times: the counters match several places of the line. PLOTWRIGHT_FAULTS=20, or the full run: 20 times.
 */
import { fork } from "node:child_process";
import { once } from "node:events";
import { describe, expect, it } from "vitest";
import { PlotterDriver } from "../../server/plotter/node-plotter.js";
import type { JournalEntry } from "../../host/plotter/types.js";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { childScript } from "../support/child-script.js";
import { untilIdle, waitS } from "../support/faulty-plots.js";
import { drawnMm, plotting, seeded } from "../support/live-plot.js";
import { LocalPlanner, strokesOf } from "../support/local-planner.js";
import { nextMessage } from "../support/next-message.js";
import { PtyBoard } from "../support/pty-board.js";
import { countFor } from "../support/full-run.js";

const COUNT = countFor("PLOTWRIGHT_FAULTS", 20, 1);
const FIRMWARES = COUNT > 1 ? ["2.8.1", "3.0.3"] : ["2.8.1"];

/** Loops of about 25 mm, each overlapping the one before. */
const LOOPS = Array.from({ length: 900 }, (_, i) => [
  30 + 0.008 * i + 4 * Math.cos(i / 9),
  30 + 0.01 * i + 4 * Math.sin(i / 9),
]).flat();
const STROKES = strokesOf(LOOPS);
const EARLIEST_S = 1.5;
const LATEST_S = 6;
/** Missing or doubled: rounding to steps, and the place within the tolerance of a crossing. */
const MOST_MM = 0.3;

describe.each(FIRMWARES)("a plot on firmware %s that is killed on a line that crosses itself", (firmware) => {
  it("resumes from the place where the board stopped", { timeout: 60_000 + 40_000 * COUNT }, async () => {
    const random = seeded(17);
    const { mode } = DEFAULT_PLOT_SETTINGS.motion;
    const { world, board, run } = await plotting(mode, STROKES, firmware);
    await world.run(run.finished);
    const wholeMm = drawnMm(board);
    const offMm: number[] = [];
    for (let i = 0; i < COUNT; i++) {
      const afterS = EARLIEST_S + (LATEST_S - EARLIEST_S) * random();
      offMm.push((await killedAfter(firmware, afterS)) - wholeMm);
    }
    expect(offMm.filter((mm) => Math.abs(mm) > MOST_MM)).toEqual([]);
  });
});

/** mm on the paper at the end. */
async function killedAfter(firmware: string, afterS: number): Promise<number> {
  const board = await PtyBoard.open({ firmware, wakeful: true });
  const driver = new PlotterDriver({ device: board.path });
  try {
    const args = [board.path, JSON.stringify([LOOPS])];
    const child = fork(childScript("plot-child"), args, { execArgv: [] });
    const journal: JournalEntry[] = [];
    child.on("message", (entry: JournalEntry) => journal.push(entry));
    await nextMessage(child);
    await waitS(afterS);
    child.kill("SIGKILL");
    await once(child, "exit");
    const { place: from, received } = journal[journal.length - 1];
    await driver.start();
    await untilIdle(driver);
    const run = await driver.plot(new LocalPlanner(STROKES), DEFAULT_PLOT_SETTINGS, { from, received });
    await run.resume();
    expect(await run.finished).toEqual({ kind: "done" });
    const { drawn } = await board.report();
    return drawnMm({
      drawn: () => drawn.map(({ penDown, xy }) => ({ penDown, xy: Float64Array.from(xy) })),
    });
  } finally {
    await driver.close();
    await board.close();
  }
}
