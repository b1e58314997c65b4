/**
 * kill -9 of a plotting process and an unplugged cable while the pen moves in flight, over a real pseudo-terminal, with
 * a servo that deviates from the planner's assumptions. PLOTWRIGHT_FAULTS=20, or the full run: 20 times each.
 */
import { fork } from "node:child_process";
import { once } from "node:events";
import { describe, expect, it } from "vitest";
import { NodePlotter } from "../support/plots/node-plotter.js";
import type { JournalEntry } from "../../host/plotter/plotter-port.js";
import { machineById, planJob } from "../../src/index.js";
import type { PenOverlap } from "../../src/internal.js";
import { childScript, nextMessage } from "../support/processes/child-script.js";
import { untilIdle, untilUnderWay, waitS } from "../support/plots/faulty-plots.js";
import {
  HOPS,
  instant,
  marksOn,
  penSettings,
  SERVOS,
  STATED_SERVO,
  virtualServo,
  type FlyingServo,
} from "../support/machines/flying-pens.js";
import { countFor } from "../support/runs/full-run.js";
import { seeded } from "../support/plots/live-plot.js";
import { LocalPlanner } from "../support/plots/local-planner.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { startAfter } from "../support/plots/start-after.js";

const COUNT = countFor("PLOTWRIGHT_FAULTS", 20, 1);
/** Missing or drawn twice, mm. */
const UNSEEN_MM = 0.05;
/** How far from a stroke there may be a mark, mm. */
const BESIDE_MM = { off: 0.05, safe: 0.15, fast: 0.3 };
const LINES = Array.from({ length: HOPS.offsets.length - 1 }, (_, i) => [
  ...HOPS.xy.subarray(2 * HOPS.offsets[i], 2 * HOPS.offsets[i + 1]),
]);

interface Case {
  readonly overlap: PenOverlap;
  readonly firmware: string;
  readonly servo: FlyingServo;
}

const caseOf = (i: number): Case => {
  const firmware = i % 2 === 0 ? "3.0.3" : "2.8.1";
  if (i % 5 === 4) return { overlap: "fast", firmware, servo: STATED_SERVO };
  return { overlap: "safe", firmware, servo: SERVOS[i % SERVOS.length] };
};

type Interrupt = (board: PtyBoard, overlap: PenOverlap, afterS: number) => Promise<JournalEntry>;

/** The process that plots is killed. */
const kill: Interrupt = async (board, overlap, afterS) => {
  const args = [board.path, JSON.stringify(LINES), JSON.stringify({ overlap })];
  const child = fork(childScript("plot-child"), args, { execArgv: [] });
  const journal: JournalEntry[] = [];
  child.on("message", (entry: JournalEntry) => journal.push(entry));
  await nextMessage(child);
  await waitS(afterS);
  child.kill("SIGKILL");
  await once(child, "exit");
  return journal[journal.length - 1];
};

const unplug: Interrupt = async (board, overlap, afterS) => {
  const driver = new NodePlotter({ device: board.path });
  try {
    await driver.start();
    const journal: JournalEntry[] = [];
    const record = (entry: JournalEntry): void => void journal.push(entry);
    const run = await driver.plot(new LocalPlanner(HOPS), penSettings(overlap), { journal: { record } });
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
};

/** The plot is resumed by another process, as after a restart of the server. */
async function resumed(interrupt: Interrupt, { overlap, firmware, servo }: Case, afterS: number) {
  const board = await PtyBoard.open({ firmware, wakeful: true, servo: virtualServo(servo) });
  try {
    const last = await interrupt(board, overlap, afterS);
    const driver = new NodePlotter({ device: board.path });
    try {
      await driver.start();
      await untilIdle(driver);
      const run = await driver.plot(new LocalPlanner(HOPS), penSettings(overlap), startAfter(last));
      await run.resume();
      expect(await run.finished).toEqual({ kind: "done" });
    } finally {
      await driver.close();
    }
    const { drawn } = await board.report();
    return marksOn(drawn.map(({ penDown, xy }) => ({ penDown, xy: Float64Array.from(xy) })));
  } finally {
    await board.close();
  }
}

// They mostly wait, so they run side by side.
describe.concurrent("a pen in flight", () => {
  it.each([
    ["a kill", kill, 0],
    ["an unplugged cable", unplug, 1],
  ] as const)(
    "%s while the pen is in flight leaves no gap, no doubled stretch and no mark between strokes",
    { timeout: 60_000 + 60_000 * COUNT },
    async (name, interrupt, firstCase) => {
      const random = seeded(name.length);
      const wrong: unknown[] = [];
      const max = { gapMm: 0, overlapMm: 0, besideMm: 0 };
      for (let i = 0; i < COUNT; i++) {
        const one = caseOf(firstCase + i);
        const { overlap, firmware } = one;
        const job = planJob({ strokes: HOPS }, penSettings(overlap), machineById("axidraw-v3"), { firmware });
        const afterS = instant(job.trajectory, random);
        const { gapMm, overlapMm, awayMm } = await resumed(interrupt, one, Math.max(0.3, afterS));
        const besideMm = awayMm / BESIDE_MM[one.overlap];
        if (gapMm > UNSEEN_MM || overlapMm > UNSEEN_MM || besideMm > 1) {
          wrong.push({ ...one, afterS, gapMm, overlapMm, awayMm });
        }
        max.gapMm = Math.max(max.gapMm, gapMm);
        max.overlapMm = Math.max(max.overlapMm, overlapMm);
        max.besideMm = Math.max(max.besideMm, awayMm);
      }
      if (COUNT > 10) console.info(name, COUNT, max);
      expect(wrong).toEqual([]);
    },
  );
});
