/**
 * A fault of the connection in mid-plot, over a real pseudo-terminal: whatever happens, the whole drawing is on the paper at
 * the end, once. PLOTWRIGHT_FAULTS=20, or the full run: that many random times of each, on
 * both firmware versions.
 */
import { describe, expect, it } from "vitest";
import { plotWithFault, waitS, type Fault, type FaultyPlotResult } from "../support/plots/faulty-plots.js";
import { seeded } from "../support/plots/live-plot.js";
import { countFor } from "../support/runs/full-run.js";

const COUNT = countFor("PLOTWRIGHT_FAULTS", 20, 1);
const FIRMWARES = COUNT > 1 ? ["2.8.1", "3.0.3"] : ["2.8.1"];
const EARLIEST_S = 0.3;
const LATEST_S = 7;

/** Max mm missing in one piece. */
const MOST_MM = 0.05;
/** Max mm drawn twice in total: a plot resumes from the earliest place that fits the carriage's. */
const MOST_TWICE_MM = 0.1;
/** Max distance from the drawing: a rounded corner. */
const MOST_AWAY_MM = 0.1;
const MOST_SLEPT_S = 1;
const MOST_TRIES = 3;

const GARBAGE_BYTES = 300;

const FAULTS: readonly Fault[] = [
  { name: "nothing", happen: () => undefined },
  {
    name: "bytes lost while the connection is mute",
    happen: async (board, random) => {
      board.tell({ type: "deaf", deaf: true, afterBytes: Math.floor(60 * random()) });
      await waitS(6);
      board.tell({ type: "deaf", deaf: false });
    },
  },
  {
    name: "a stray reply",
    happen: (board) => board.tell({ type: "garbage", bytes: [...Buffer.from("OK\r\n")] }),
  },
  {
    name: "an unplugged cable",
    happen: async (board) => {
      board.tell({ type: "unplug" });
      await waitS(2);
      board.tell({ type: "replug" });
    },
  },
  {
    name: "silence",
    happen: async (board) => {
      board.tell({ type: "mute", mute: true });
      await waitS(4);
      board.tell({ type: "mute", mute: false });
    },
  },
  {
    name: "garbage",
    happen: (board, random) => {
      const bytes = Array.from({ length: GARBAGE_BYTES }, () => Math.floor(256 * random()));
      board.tell({ type: "garbage", bytes });
    },
  },
];

/** Repeats the plot if the machine was so busy that the board seemed to be dead. */
async function undisturbed(plot: () => Promise<FaultyPlotResult>): Promise<FaultyPlotResult> {
  for (let tries = 1; ; tries++) {
    const result = await plot();
    if (result.sleptS < MOST_SLEPT_S || tries === MOST_TRIES) return result;
  }
}
// They mostly wait, so some run side by side.
describe.concurrent.each(FIRMWARES)("on firmware %s", (firmware) => {
  it.each(FAULTS)(
    "$name leaves no gap and draws nothing twice",
    { timeout: 120_000 + 90_000 * COUNT },
    async (fault) => {
      const random = seeded(1_000_003 * (1 + FAULTS.indexOf(fault)));
      const wrong: unknown[] = [];
      for (let i = 0; i < COUNT; i++) {
        const afterS = EARLIEST_S + (LATEST_S - EARLIEST_S) * random();
        const result = await undisturbed(() => plotWithFault(fault, firmware, afterS, random));
        const { gapMm, overlapMm, awayMm, outcomes, sleptS } = result;
        const isDone = outcomes[outcomes.length - 1] === "done";
        if (!isDone || gapMm > MOST_MM || overlapMm > MOST_TWICE_MM || awayMm > MOST_AWAY_MM) {
          wrong.push({ afterS, gapMm, overlapMm, awayMm, outcomes, sleptS });
        }
      }
      expect(wrong).toEqual([]);
    },
  );
});
