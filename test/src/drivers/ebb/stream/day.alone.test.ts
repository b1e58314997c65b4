import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { expect, it } from "vitest";
import { BoardSession, VirtualBoard } from "../../../../../src/index.js";
import { Streamer } from "../../../../../src/internal.js";
import { makeStream, type StreamRow } from "../../../../support/drawings/make-stream.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";

const DAY_S = 86_400;
const ROUND_S = 1_800;
const MOVE_S = 2;

setFlagsFromString("--expose_gc");
const collect = runInNewContext("gc") as () => void;

function heapBytes(): number {
  collect();
  return process.memoryUsage().heapUsed;
}

/** Out and back, ending with the pen up: a pause there is not an underrun. */
const round = (): StreamRow[] => [
  ...Array.from({ length: ROUND_S / MOVE_S }, (_, i) => {
    const steps = i % 2 === 0 ? ([900 + i, -700] as const) : ([-899 - i, 700] as const);
    return { line: `SM,${MOVE_S * 1000},${steps[0]},${steps[1]}`, durationS: MOVE_S, steps, run: 0 };
  }),
  { line: "SP,1,100", durationS: 0.1 },
];

it("a day of streaming leaks no memory, loses no step and has no underrun", async () => {
  const clock = new ManualClock();
  const board = new VirtualBoard({ clock, firmware: "2.8.1", recordLine: false });
  const session = new BoardSession(board.transport(), { clock, logLines: 5_000 });
  await clock.run(session.identify());
  await clock.run(session.send("EM,1,1"));
  let at: readonly [number, number] = [0, 0];
  let firstBytes = 0;
  for (let done = 0; done < DAY_S; done += ROUND_S) {
    const stream = makeStream(round(), at);
    const streamer = new Streamer(session, { clock, poll: { lines: ["QG"], everyS: 1 } });
    const report = await clock.run(streamer.play(stream));
    expect(report).toMatchObject({ complete: true, exact: true });
    expect(streamer.underrunCount).toBe(0);
    at = [report.steps1!, report.steps2!];
    if (done === ROUND_S) firstBytes = heapBytes();
  }
  expect(clock.nowS()).toBeGreaterThan(DAY_S);
  expect((heapBytes() - firstBytes) / 1e6).toBeLessThan(20);
  expect(board.statistics().underrunCount).toBe(0);
});
