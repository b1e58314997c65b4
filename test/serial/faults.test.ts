/**
 * Faults of a connection during a plot, over a real pseudo-terminal: each ends in a defined state. Those of the board itself
 * are tested without real time, in test/host/plotter/connection/plotter.test.ts.
 */
import { fork } from "node:child_process";
import { once } from "node:events";
import { chmodSync } from "node:fs";
import { describe, expect, it, type TestContext } from "vitest";
import { NodePlotter, type PlotterState } from "../support/plots/node-plotter.js";
import type { JournalEntry, RunningPlot } from "../../host/plotter/plotter-port.js";
import type { PlotwrightError } from "../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { childScript, hasEnded, nextMessage } from "../support/processes/child-script.js";
import { LocalPlanner, strokesOf } from "../support/plots/local-planner.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { wakefulClock } from "../support/clocks/wakeful-clock.js";

const LONG = strokesOf([10, 10, 250, 10, 250, 20, 10, 20, 10, 30, 250, 30]);
/**
 * An undetected fault never ends, or only with the plot. test/host/plotter/connection/plotter.test.ts tests the limit of 3 s, without real
 * time: here a busy computer delays the board and the driver.
 */
const WITHIN_S = 15;
const clock = wakefulClock({ countsWork: true });

/** Everything opened here is closed when its own test ends, because other tests run beside it. */
function closeAfter<T extends { close(): Promise<void> }>({ onTestFinished }: TestContext, thing: T): T {
  onTestFinished(() => thing.close());
  return thing;
}

interface Plot {
  readonly board: PtyBoard;
  readonly driver: NodePlotter;
  readonly run: RunningPlot;
  readonly journal: JournalEntry[];
  /** How `finished` ended, and the seconds for which this process ran until then. */
  ended(): Promise<{ outcome: string; afterS: number }>;
}

/** A plot at real speed that is drawing a line. */
async function drawing(test: TestContext, firmware = "2.8.1"): Promise<Plot> {
  const board = closeAfter(test, await PtyBoard.open({ firmware }));
  const driver = closeAfter(test, new NodePlotter({ device: board.path }));
  await driver.start();
  const journal: JournalEntry[] = [];
  const run = await driver.plot(new LocalPlanner(LONG), DEFAULT_PLOT_SETTINGS, {
    journal: { record: (entry) => journal.push(entry) },
  });
  await new Promise<void>((resolve) => run.onProgress(({ penUp }) => penUp || resolve()));
  const ended = async () => {
    const from = clock.nowS();
    const outcome = await run.finished.then(
      ({ kind }) => kind,
      (error: PlotwrightError) => `${error.code}: ${error.message}`,
    );
    return { outcome, afterS: clock.nowS() - from };
  };
  return { board, driver, run, journal, ended };
}

// They mostly wait for the board, so some run side by side.
describe.concurrent("in mid-plot", () => {
  it("an unplugged board ends the plot as disconnected, with the position in the journal", async (test) => {
    const { board, driver, journal, ended } = await drawing(test);
    board.tell({ type: "unplug" });
    const { outcome, afterS } = await ended();
    expect(outcome).toMatch(/^disconnected: .*USB cable/);
    expect(afterS).toBeLessThan(WITHIN_S);
    expect(driver.state.connection).toBe("fault");
    expect(journal[journal.length - 1].place.stroke).toBe(0);
  });

  it("a board whose power fails briefly ends the plot as disconnected, with the position in the journal", async (test) => {
    const { board, driver, journal, ended } = await drawing(test);
    board.tell({ type: "reset" });
    const { outcome, afterS } = await ended();
    expect(outcome).toMatch(/^disconnected: /);
    expect(afterS).toBeLessThan(WITHIN_S);
    // Its counters are gone: only the user knows where home is.
    expect(driver.state).toMatchObject({ connection: "fault", xMm: null });
    expect(journal[journal.length - 1].place.stroke).toBe(0);
  });

  it("a board that another program switched to its other syntax continues, or is a fault with its own message", async (test) => {
    const { board, run, ended } = await drawing(test, "3.0.3");
    board.tell({ type: "send", line: "CU,10,1\r" });
    await run.change({ speedPct: 200 });
    expect((await ended()).outcome).toBe("done");
    expect((await board.report()).state).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
  });

  it.for([
    ["garbage on the connection", { type: "garbage", bytes: [0xff, 0x21, 13, 0x80, 0x41, 13, 10] }],
    ["lost replies", { type: "lose", count: 2 }],
    ["a slow connection", { type: "slow", bytesPerS: 4_000 }],
  ] as const)("%s does not disturb the plot: the motors end where they should", async ([, fault], test) => {
    const { board, run, ended } = await drawing(test);
    board.tell(fault);
    await run.change({ speedPct: 200 });
    expect((await ended()).outcome).toBe("done");
    expect((await board.report()).state).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
  });

  it("a board moved by another program is detected by its counters", async (test) => {
    const { board, run, ended } = await drawing(test);
    board.tell({ type: "send", line: "CS\r" });
    void run.cancel().catch(() => undefined);
    const { outcome, afterS } = await ended();
    expect(outcome).toMatch(/^board-error: The board's motors are at .* Set home again/);
    expect(afterS).toBeLessThan(WITHIN_S);
  });
});

describe.concurrent("when connecting", () => {
  const connected = async (test: TestContext, path: string): Promise<PlotterState> => {
    const driver = closeAfter(test, new NodePlotter({ device: path }));
    const from = clock.nowS();
    await driver.start();
    expect(clock.nowS() - from).toBeLessThan(WITHIN_S);
    return driver.state;
  };

  it("a missing device is reported as absent", async (test) => {
    expect(await connected(test, "/dev/no-such-plotter")).toMatchObject({
      connection: "absent",
      message: expect.stringContaining("plug the plotter in"),
    });
  });

  it("a board in use by another program is a fault with its own message", async (test) => {
    const { board, run } = await drawing(test);
    expect(await connected(test, board.path)).toMatchObject({
      connection: "fault",
      message: expect.stringContaining("Another program is using"),
    });
    await run.cancel();
  });

  it("a port without permission is a fault that names the group and the udev rule", async (test) => {
    const board = closeAfter(test, await PtyBoard.open());
    chmodSync(board.path, 0);
    // Root may open everything: then another account tries.
    const child = fork(childScript("connect-child"), [board.path], {
      execArgv: [],
      ...(process.getuid?.() === 0 ? { uid: 65_534, gid: 65_534 } : {}),
    });
    const found = await nextMessage<PlotterState>(child);
    expect(found).toMatchObject({
      connection: "fault",
      message: expect.stringMatching(/may not open .*dialout.*udev rule/) as string,
    });
    if (!hasEnded(child)) await once(child, "exit");
  });
});
