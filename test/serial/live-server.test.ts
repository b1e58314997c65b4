/** Live drawings on a running server over a pseudo-terminal: how their sender, and the server itself, can be lost. */
import { fork, type ChildProcess } from "node:child_process";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { WebSocket } from "ws";
import { strokesOf, type Line } from "../../src/index.js";
import { snapshotSchema, type Job, type Plotter } from "../../src/schema/index.js";
import { compareDrawn } from "../support/drawings/drawn-truth.js";
import { PtyBoard } from "../support/processes/pty-board.js";
import { folderOfTest } from "../support/processes/folders.js";
import { startServerProcess, type ServerProcess } from "../support/processes/server-process.js";

const LIMIT_MS = 120_000;
const LINE_END_MM = 200;
const LINE: Line = Array.from({ length: 361 }, (_, i) => [20 + i / 2, 40 + 6 * Math.sin(i / 10)] as const);

let dir: string;
let board: PtyBoard;
let server: ServerProcess;
const children: ChildProcess[] = [];
beforeEach(async () => {
  dir = folderOfTest();
  board = await PtyBoard.open({ wakeful: true });
  server = await start();
});
afterEach(async () => {
  for (const child of children.splice(0)) child.kill("SIGKILL");
  await server.stop();
  await board.close();
});

const start = (): Promise<ServerProcess> =>
  startServerProcess({ dataDir: dir, virtualSpeed: 1, args: ["--device", board.path] });

async function state(): Promise<{ readonly job: Job; readonly plotter: Plotter }> {
  const answer = await fetch(`${server.url}/api/v1/state`);
  const { jobs, plotters } = snapshotSchema.parse(await answer.json());
  return { job: jobs[0], plotter: plotters.find(({ device }) => device === board.path) ?? plotters[0] };
}
const post = async (path: string): Promise<void> => {
  const answer = await fetch(`${server.url}/api/v1${path}`, { method: "POST" });
  expect([path, answer.status]).toEqual([path, 200]);
};

/** Sends LINE in another process, which does not end the drawing. */
async function sender(): Promise<ChildProcess> {
  const { plotter } = await state();
  const child = fork(join(import.meta.dirname, "../support/processes/live-sender-child.mjs"), [
    `${server.url.replace("http", "ws")}/api/v1/plotters/${plotter.id}/live`,
    JSON.stringify(LINE),
  ]);
  children.push(child);
  return child;
}

const drawnTo = async (): Promise<number> => {
  const { drawn } = await board.report();
  const xs = drawn.filter(({ penDown }) => penDown).flatMap(({ xy }) => xy.filter((_, i) => i % 2 === 0));
  return Math.max(0, ...xs);
};

async function mustBeWhole(): Promise<void> {
  const { drawn, state: at } = await board.report();
  const { gapMm, overlapMm, awayMm } = compareDrawn(strokesOf([LINE]), drawn);
  expect(Math.max(gapMm, overlapMm)).toBeLessThan(0.5);
  expect(awayMm).toBeLessThan(0.2);
  expect(at).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
}

describe("a live drawing on a server", () => {
  it.each([
    ["is killed", "SIGKILL"],
    ["is suspended, so that its connection stays", "SIGSTOP"],
  ] as const)(
    "lifts the pen when its sender %s, and waits with what was received",
    async (_how, signal) => {
      const child = await sender();
      await expect.poll(drawnTo, { timeout: LIMIT_MS, interval: 50 }).toBeGreaterThan(60);
      expect((await board.report()).state.penUp).toBe(false);
      child.kill(signal);
      await expect.poll(async () => (await board.report()).state.penUp, { interval: 20 }).toBe(true);
      expect(await drawnTo()).toBeLessThan(LINE_END_MM - 10);
      await expect.poll(async () => (await state()).job.state).toBe("paused");
      const { job, plotter } = await state();
      expect(job.message).toMatch(/sender of this live drawing/);
      expect(plotter).toMatchObject({ penUp: true, xMm: expect.any(Number) as number });
      if (signal === "SIGSTOP") {
        child.kill("SIGCONT");
        await expect.poll(async () => (await state()).job.state).toBe("plotting");
        child.kill("SIGKILL");
        await expect.poll(async () => (await state()).job.state).toBe("paused");
      }
      await post(`/jobs/${job.id}/resume`);
      await expect.poll(async () => (await state()).job.state, { timeout: LIMIT_MS }).toBe("done");
      await mustBeWhole();
    },
    LIMIT_MS,
  );

  it(
    "ends as done when its sender is lost after everything was drawn",
    async () => {
      const { plotter } = await state();
      const socket = new WebSocket(
        `${server.url.replace("http", "ws")}/api/v1/plotters/${plotter.id}/live`,
        "plotwright-live",
      );
      socket.on("open", () => socket.send('{"begin":{}}'));
      await new Promise((resolve) => socket.once("message", resolve));
      socket.send('{"lineTo":[[20,20],[40,20]]}');
      await new Promise<void>((resolve) =>
        socket.on("message", (data: Buffer) => data.includes('"state":"waiting"') && resolve()),
      );
      socket.terminate();
      await expect.poll(async () => (await state()).job.state, { timeout: LIMIT_MS }).toBe("done");
      expect((await board.report()).state).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
    },
    LIMIT_MS,
  );

  it(
    "is continued with what was received when the server was killed",
    async () => {
      await sender();
      await expect.poll(drawnTo, { timeout: LIMIT_MS, interval: 50 }).toBeGreaterThan(60);
      server.process.kill("SIGKILL");
      server = await start();
      const { job } = await state();
      expect(job).toMatchObject({ state: "interrupted", name: "Live drawing" });
      await expect.poll(async () => (await state()).job.stats).toMatchObject({ strokeCount: 1 });
      await post(`/jobs/${job.id}/recover`);
      await expect.poll(async () => (await board.report()).state.penUp, { timeout: 20_000 }).toBe(true);
      await post(`/jobs/${job.id}/resume`);
      await expect.poll(async () => (await state()).job.state, { timeout: LIMIT_MS }).toBe("done");
      await mustBeWhole();
    },
    LIMIT_MS,
  );
});
