/**
 * One plot on a board in another process, over a real pseudo-terminal, with a fault at one instant. It is
 * resumed after each interruption, as a user would do by Recover and Resume. Then what the board drew is
 * compared with the drawing.
 */
import { NodePlotter } from "./node-plotter.js";
import type { JournalEntry, RunningPlot } from "../../../host/plotter/plotter-port.js";
import type { PlotwrightError, StrokeSet } from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { compareDrawn, type DrawnTruth } from "../drawings/drawn-truth.js";
import { LocalPlanner, strokesOf } from "./local-planner.js";
import { PtyBoard, type BoardReport } from "../processes/pty-board.js";
import { startAfter } from "./start-after.js";

/** Long and short lines, curves and corners, all some mm apart: about 8 s of plotting. */
export const FAULT_DRAWING: StrokeSet = strokesOf(
  Array.from({ length: 160 }, (_, i) => [
    30 + 16 * Math.cos((i / 165) * 2 * Math.PI),
    30 + 16 * Math.sin((i / 165) * 2 * Math.PI),
  ]).flat(),
  [60, 12, 100, 12, 100, 22, 60, 22, 62, 30, 66, 24, 70, 30, 74, 24, 78, 30],
  [60, 36, 63, 36],
  [68, 36, 70, 38],
  Array.from({ length: 120 }, (_, i) => [60 + i / 3, 45 + 3 * Math.sin(i / 6)]).flat(),
);

/** Each is longer than any plot with a fault needs. */
const MOST_INTERRUPTIONS = 4;
const IDLE_WITHIN_S = 40;

export interface Fault {
  readonly name: string;
  /** The fault and its repair, with the time between them. */
  happen(board: PtyBoard, random: () => number): void | Promise<void>;
}

export interface FaultyPlotResult extends DrawnTruth {
  /** How each run of the plot ended: "done", or the error's code and message. */
  readonly outcomes: readonly string[];
  readonly report: BoardReport;
  /** How long the machine did not run the board's process: a real board never stops. */
  readonly sleptS: number;
}

export const waitS = (s: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, 1_000 * s));

/** `afterS`: from the first movement to the fault. */
export async function plotWithFault(
  fault: Fault,
  firmware: string,
  afterS: number,
  random: () => number,
): Promise<FaultyPlotResult> {
  const board = await PtyBoard.open({ firmware, wakeful: true });
  const driver = new NodePlotter({ device: board.path });
  try {
    await driver.start();
    const journal: JournalEntry[] = [];
    const start = (): Promise<RunningPlot> =>
      driver.plot(new LocalPlanner(FAULT_DRAWING), DEFAULT_PLOT_SETTINGS, {
        ...startAfter(journal.at(-1)),
        journal: { record: (entry) => journal.push(entry) },
      });
    const { sleptS: sleptBeforeS } = await board.report();
    let run = await start();
    await untilUnderWay(run);
    const happened = waitS(afterS).then(() => fault.happen(board, random));
    const outcomes: string[] = [];
    for (;;) {
      const outcome = await outcomeOf(run);
      outcomes.push(outcome);
      if (outcome === "done" || outcomes.length > MOST_INTERRUPTIONS) break;
      await happened;
      await untilIdle(driver);
      run = await start();
      await run.resume();
    }
    await happened;
    const report = await board.report();
    const sleptS = report.sleptS - sleptBeforeS;
    return { outcomes, report, sleptS, ...compareDrawn(FAULT_DRAWING, report.drawn) };
  } finally {
    await driver.close();
    await board.close();
  }
}

/** Until the plot reports progress. Rejects if it fails before: then it reports none. */
export const untilUnderWay = (run: RunningPlot): Promise<unknown> =>
  Promise.race([new Promise<void>((resolve) => run.onProgress(() => resolve())), run.finished]);

const outcomeOf = (run: RunningPlot): Promise<string> =>
  run.finished.then(
    ({ kind }) => kind,
    (error: PlotwrightError) => `${error.code}: ${error.message}`,
  );

export async function untilIdle(driver: NodePlotter): Promise<void> {
  const untilMs = Date.now() + 1_000 * IDLE_WITHIN_S;
  while (driver.state.connection !== "idle") {
    if (Date.now() > untilMs) throw new Error(`the plotter is not idle again: ${driver.state.message}`);
    await waitS(0.05);
  }
}
