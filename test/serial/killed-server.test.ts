/**
 * Repeated kill -9 of the server in mid-plot, over a pseudo-terminal: the board plays what it had received,
 * and the job resumes from there.
 */
import { once } from "node:events";
import { expect, it, onTestFinished } from "vitest";
import { jobSchema, snapshotSchema, type Job } from "../../src/schema/index.js";
import { EventStream } from "../support/servers/event-stream.js";
import { PtyBoard, type BoardReport } from "../support/processes/pty-board.js";
import { folderOfTest } from "../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../support/processes/server-process.js";
import { countFor } from "../support/runs/full-run.js";

const KILL_COUNT = countFor("PLOTWRIGHT_KILLS", 50, 4);
const KILLS_PER_PLOT = 10;
const SPEED = 10;
/** Max number of progress reports (one in 60 ms) before the server is killed. */
/** Nothing is drawn during this time unless the user asks. */
const STILL_MS = 300;
const MOST_REPORTS = 12;

const ROWS = 25;
const SVG =
  `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100" fill="none" stroke="black">` +
  Array.from({ length: ROWS }, (_, i) => `<path d="M10 ${5 + 3 * i}H90"/>`).join("") +
  "</svg>";

/** The same times in every run: a linear congruential generator. */
let random = 7;
const below = (limit: number): number => {
  random = (random * 1_103_515_245 + 12_345) % 2 ** 31;
  return Math.floor((random / 2 ** 31) * limit);
};

const post = async (server: ServerProcess, path: string): Promise<void> => {
  const response = await fetch(`${server.url}/api/v1${path}`, { method: "POST" });
  expect([path, response.status, response.ok ? "" : await response.text()]).toEqual([path, 200, ""]);
};
const jobOf = async (server: ServerProcess, id: string): Promise<Job> =>
  snapshotSchema
    .parse(await (await fetch(`${server.url}/api/v1/state`)).json())
    .jobs.find((job) => job.id === id)!;
const drawnMm = async (board: PtyBoard): Promise<number> => (await board.report()).statistics.drawnMm;

/** Over all rows: the widest gap between the ends, and the length drawn more than once. */
function rowsOf(report: BoardReport, from: number): { count: number; gapMm: number; doubledMm: number } {
  const rows = new Map<number, [number, number][]>();
  for (const { xy } of report.drawn.slice(from).filter(({ penDown, xy }) => penDown && xy.length > 2)) {
    const row = Math.round(xy[1] * 2);
    const [x0, x1] = [xy[0], xy[xy.length - 2]];
    rows.set(row, [...(rows.get(row) ?? []), [Math.min(x0, x1), Math.max(x0, x1)]]);
  }
  const all = [...rows.values()].flat();
  const left = Math.min(...all.map(([x0]) => x0));
  const right = Math.max(...all.map(([, x1]) => x1));
  let [gapMm, doubledMm] = [0, 0];
  for (const row of rows.values()) {
    let reached = left;
    for (const [x0, x1] of row.sort((a, b) => a[0] - b[0])) {
      gapMm = Math.max(gapMm, x0 - reached);
      doubledMm += Math.max(0, Math.min(reached, x1) - x0);
      reached = Math.max(reached, x1);
    }
    gapMm = Math.max(gapMm, right - reached);
  }
  return { count: rows.size, gapMm, doubledMm };
}

it(
  "a killed server loses no stroke, draws nothing twice, and nothing unless the user asks",
  { timeout: 60_000 + 20_000 * KILL_COUNT },
  async () => {
    const data = folderOfTest();
    const board = await PtyBoard.open({ speed: SPEED });
    onTestFinished(() => board.close());
    const start = async (): Promise<ServerProcess> => {
      const args = ["--device", board.path];
      const server = await startServerProcess({ dataDir: data, virtualSpeed: SPEED, args });
      onTestFinished(() => server.stop());
      return server;
    };
    let server = await start();
    let kills = 0;
    while (kills < KILL_COUNT) {
      const linesBefore = (await board.report()).drawn.length;
      const added = await fetch(`${server.url}/api/v1/jobs?name=lines.svg`, { method: "POST", body: SVG });
      const { id } = jobSchema.parse(await added.json());
      let events = await EventStream.open(server.url);
      await post(server, `/jobs/${id}/start`);
      const done = () => events.find("job", ({ job }) => job.id === id && job.state === "done");
      for (let inPlot = 0; inPlot < KILLS_PER_PLOT && kills < KILL_COUNT; inPlot++) {
        const reports = new Set<unknown>();
        const most = 1 + below(MOST_REPORTS);
        const due = events.find("progress", (event) => event.jobId === id && reports.add(event).size >= most);
        if ((await Promise.race([due, done()])).type === "job") break;
        const ended = once(server.process, "exit");
        server.process.kill("SIGKILL");
        await ended;
        kills++;
        server = await start();
        events = await EventStream.open(server.url);
        const { state } = await jobOf(server, id);
        // Killed just after its end.
        if (state === "done") break;
        expect(state).toBe("interrupted");
        await post(server, `/jobs/${id}/recover`);
        // The server finds its board, which plays what it had received and lifts the pen.
        await events.find("job", ({ job }) => job.state === "paused");
        await expect
          .poll(async () => (await board.report()).state, { timeout: 20_000 })
          .toMatchObject({ penUp: true, isBusy: false });
        const leftMm = await drawnMm(board);
        await new Promise((resolve) => setTimeout(resolve, STILL_MS));
        expect(await drawnMm(board)).toBe(leftMm);
        await post(server, `/jobs/${id}/resume`);
      }
      if ((await jobOf(server, id)).state !== "done") await done();
      events.close();
      const report = await board.report();
      expect([report.state.steps1, report.state.steps2, report.state.penUp]).toEqual([0, 0, true]);
      const { count, gapMm, doubledMm } = rowsOf(report, linesBefore);
      expect(count).toBe(ROWS);
      expect(gapMm).toBeLessThan(0.02);
      // The journal's half second would be 25 mm per kill: the board's own counters are more accurate.
      expect(doubledMm).toBeLessThan(0.1 * (KILLS_PER_PLOT + 1));
    }
  },
);
