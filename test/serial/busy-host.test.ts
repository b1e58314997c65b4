/**
 * A host that is busy for seconds, with its board on a real pseudo-terminal: replies that have arrived meanwhile are
 * read before the board counts as silent.
 */
import { expect, it } from "vitest";
import { NodePlotter } from "../support/plots/node-plotter.js";
import { nodeClock } from "../../server/serial/node-clock.js";
import { openSerial } from "../../server/serial/serial-transport.js";
import { BoardSession } from "../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { waitS } from "../support/plots/faulty-plots.js";
import { LocalPlanner, strokesOf } from "../support/plots/local-planner.js";
import { PtyBoard } from "../support/processes/pty-board.js";

function beBusyFor(s: number): void {
  const untilMs = Date.now() + 1_000 * s;
  while (Date.now() < untilMs);
}

// The board's patience ends during the first.
it.each([1.6, 4])("a busy host does not take a board for silent after %f s of work", async (s) => {
  const board = await PtyBoard.open();
  const session = new BoardSession(await openSerial(board.path), { clock: nodeClock });
  try {
    await session.identify();
    // Until the session's timer has run out, so that the next one starts with the query.
    await waitS(1);
    const answer = session.query("QM");
    beBusyFor(s);
    expect(await answer).toMatch(/^0,0,0/);
  } finally {
    await session.close();
    await board.close();
  }
});

it("a busy host finishes a plot although it works for seconds in between", async () => {
  const board = await PtyBoard.open();
  const driver = new NodePlotter({ device: board.path });
  try {
    await driver.start();
    const strokes = strokesOf([10, 10, 120, 10], [120, 20, 10, 20]);
    const run = await driver.plot(new LocalPlanner(strokes), DEFAULT_PLOT_SETTINGS);
    let reports = 0;
    run.onProgress(() => {
      reports++;
      if (reports % 15 === 10) beBusyFor(reports < 50 ? 1.7 : 3);
    });
    expect(await run.finished).toEqual({ kind: "done" });
    expect(reports).toBeGreaterThan(25);
  } finally {
    await driver.close();
    await board.close();
  }
});
