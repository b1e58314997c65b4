/**
 * Many browsers and scripts at once while the plotter draws at real speed: 50 event streams and 20 requests
 * per second do not slow the pen.
 */
import { expect, it, onTestFinished } from "vitest";
import { jobSchema } from "../../src/schema/index.js";
import { EventStream } from "../support/servers/event-stream.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { folderOfTest } from "../support/processes/folders.js";
import { startServerProcess } from "../support/processes/server-process.js";
import { IS_FULL } from "../support/runs/full-run.js";

const STREAM_COUNT = 50;
const REQUESTS_PER_S = 20;
const MOST_AT_ONCE = 4;
const LEAST_PLOT_S = IS_FULL ? 20 : 5;

/** One dense curve of about 1000 mm. */
const CHORD_COUNT = 3_000;
/** The part of the curve that is drawn. */
const SHARE = IS_FULL ? 1 : 0.3;
const CURVE = Array.from({ length: SHARE * CHORD_COUNT + 1 }, (_, i) => {
  const t = (i / CHORD_COUNT) * 1.35 * Math.PI;
  return `${(130 + 70 * Math.sin(3 * t)).toFixed(3)} ${(100 + 60 * Math.cos(2 * t)).toFixed(3)}`;
}).join("L");
const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="260mm" height="200mm" viewBox="0 0 260 200" stroke="black" fill="none"><path d="M${CURVE}"/></svg>`;

/** Reads an event stream as bytes, because most of a browser's work with them is not ours. */
async function countBytes(url: string, signal: AbortSignal): Promise<{ bytes: number }> {
  const counted = { bytes: 0 };
  const { body } = await fetch(`${url}/api/v1/events`, { signal });
  const read = async (): Promise<void> => {
    for await (const chunk of body!) counted.bytes += (chunk as Uint8Array).length;
  };
  read().catch(() => undefined);
  return counted;
}

it("50 browsers and 20 requests a second never starve the board", { timeout: 240_000 }, async () => {
  const data = folderOfTest();
  const board = await PtyBoard.open({ wakeful: true });
  onTestFinished(() => board.close());
  const server = await startServerProcess({
    dataDir: data,
    virtualSpeed: 1,
    args: ["--device", board.path],
  });
  onTestFinished(() => server.stop());
  const added = await fetch(`${server.url}/api/v1/jobs?name=curve.svg`, { method: "POST", body: SVG });
  const { id, stats } = jobSchema.parse(await added.json());
  expect(stats!.durationS).toBeGreaterThan(LEAST_PLOT_S);

  const stop = new AbortController();
  onTestFinished(() => stop.abort());
  const streams = await Promise.all(
    Array.from({ length: STREAM_COUNT }, () => countBytes(server.url, stop.signal)),
  );
  const events = await EventStream.open(server.url);
  onTestFinished(() => events.close());
  const started = await fetch(`${server.url}/api/v1/jobs/${id}/start`, { method: "POST" });
  expect(started.status).toBe(200);
  await events.find("progress", (event) => !event.penUp);

  const answers: Promise<number>[] = [];
  const paths = ["/state", `/jobs/${id}`, "/openapi.json", `/jobs/${id}/drawing`, "/plotters/main"];
  const ask = async (path: string): Promise<number> => {
    const response = await fetch(`${server.url}/api/v1${path}`);
    await response.arrayBuffer();
    return response.status;
  };
  const from = Date.now();
  const asking = setInterval(() => {
    // A busy computer skips some beats: their requests are sent with the next ones.
    const due = ((Date.now() - from) / 1_000) * REQUESTS_PER_S;
    for (let more = 0; more < MOST_AT_ONCE && answers.length < due; more++) {
      answers.push(ask(paths[answers.length % paths.length]));
    }
  }, 1_000 / REQUESTS_PER_S);
  onTestFinished(() => clearInterval(asking));
  const { job } = await events.find(
    "job",
    (event) => event.job.state === "done" || event.job.state === "failed",
  );
  clearInterval(asking);

  expect(job.state).toBe("done");
  expect(answers.length).toBeGreaterThan(0.8 * LEAST_PLOT_S * REQUESTS_PER_S);
  expect(new Set(await Promise.all(answers))).toEqual(new Set([200]));
  for (const stream of streams)
    await expect.poll(() => stream.bytes).toBeGreaterThan(100 * 16 * 0.5 * LEAST_PLOT_S);
  const { statistics, state } = await board.report();
  expect([statistics.underrunCount, statistics.underrunS]).toEqual([0, 0]);
  expect(state).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
});
