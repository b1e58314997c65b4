/**
 * The board's faults as the user sees them: the server survives, the job is interrupted with advice,
 * resumes from its position when the fault is fixed, and can be cancelled at any time.
 */
import { describe, expect, it, onTestFinished } from "vitest";
import { createServer, type PlotwrightServer } from "../../server/index.js";
import { jobSchema, snapshotSchema, type Job, type Snapshot } from "../../src/schema/index.js";
import { EventStream } from "../support/servers/event-stream.js";
import { PtyBoard, type ToBoard } from "../support/processes/pty-board.js";
import { folderOfTest } from "../support/processes/folders.js";
import { wakefulClock } from "../support/clocks/wakeful-clock.js";

/** An undetected fault never ends. The limit of 3 s is tested without real time, in test/host/plotter/connection/plotter.test.ts. */
const WITHIN_S = 15;
const clock = wakefulClock({ countsWork: true });
const SVG =
  '<svg xmlns="http://www.w3.org/2000/svg" width="260mm" height="100mm" viewBox="0 0 260 100" stroke="black">' +
  '<path d="M10 20H250M250 40H10"/></svg>';

/** A server whose job is drawing on a board at real speed. */
async function drawing(firmware: string) {
  const data = folderOfTest();
  const board = await PtyBoard.open({ firmware });
  onTestFinished(() => board.close());
  const server: PlotwrightServer = await createServer({ port: 0, device: board.path, dataDir: data });
  onTestFinished(() => server.close());
  const events = await EventStream.open(server.url);
  onTestFinished(() => events.close());
  const added = await fetch(`${server.url}/api/v1/jobs?name=lines.svg`, { method: "POST", body: SVG });
  const { id } = jobSchema.parse(await added.json());
  const post = async (action: string): Promise<void> => {
    const response = await fetch(`${server.url}/api/v1/jobs/${id}/${action}`, { method: "POST" });
    expect([action, response.status, response.ok ? "" : await response.text()]).toEqual([action, 200, ""]);
  };
  /** The next event of the job in that state, from now on. */
  const reaches = async (state: Job["state"]): Promise<Job> => {
    const before = new Set(events.seen);
    const { job } = await events.find("job", (event) => !before.has(event) && event.job.state === state);
    return job;
  };
  await post("start");
  await events.find("progress", (event) => !event.penUp && event.progress > 0.05);
  const state = async (): Promise<Snapshot> =>
    snapshotSchema.parse(await (await fetch(`${server.url}/api/v1/state`)).json());
  return { board, events, post, reaches, state };
}

const FAULTS: readonly (readonly [
  name: string,
  firmware: string,
  fault: ToBoard,
  words: RegExp,
  mend: ToBoard,
])[] = [
  [
    "stops moving",
    "3.0.3",
    { type: "frozen", frozen: true },
    /does not finish/,
    { type: "frozen", frozen: false },
  ],
  ["is silent", "2.8.1", { type: "mute", mute: true }, /stopped answering/, { type: "mute", mute: false }],
  [
    "has USB power alone",
    "2.8.1",
    { type: "volts", volts: 5 },
    /no power, or too little/,
    { type: "volts", volts: 9.1 },
  ],
];

describe("a fault of a board", () => {
  it.each(FAULTS)(
    "a job whose board %s (firmware %s) is interrupted in time, resumed after the fault is fixed, and cancelled",
    async (_, firmware, fault, words, mend) => {
      const { board, events, post, reaches, state } = await drawing(firmware);
      const interrupted = reaches("interrupted");
      board.tell(fault);
      const from = clock.nowS();
      const { message, place } = await interrupted;
      expect(clock.nowS() - from).toBeLessThan(WITHIN_S);
      expect(message).toMatch(words);
      expect(place?.strokeIndex).toBe(0);
      board.tell(mend);
      for (;;) {
        const before = new Set(events.seen);
        if ((await state()).plotters[0].connection === "idle") break;
        await events.find("plotter", (event) => !before.has(event));
      }
      const paused = reaches("paused");
      await post("recover");
      await paused;
      const cancelled = reaches("cancelled");
      await post("cancel");
      await cancelled;
      expect((await board.report()).state.penUp).toBe(true);
    },
  );

  it("a job whose board stops moving is cancelled in time, before the fault is detected", async () => {
    const { board, post, reaches, state } = await drawing("2.8.1");
    board.tell({ type: "frozen", frozen: true });
    const ended = Promise.race([reaches("cancelled"), reaches("interrupted")]);
    const from = clock.nowS();
    await post("cancel");
    const { state: end } = await ended;
    if (end === "interrupted") await post("cancel");
    expect(clock.nowS() - from).toBeLessThan(WITHIN_S);
    expect((await state()).jobs[0].state).toBe("cancelled");
  });
});
