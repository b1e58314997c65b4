/**
 * Live drawing: how long after `stroke` the first step comes on an idle board, and how much memory a million points take:
 * in a program that has the plotter itself, and in a server. For the million points the time of the virtual board runs
 * faster.
 */
import { fork } from "node:child_process";
import { once } from "node:events";
import path from "node:path";
import { Readable } from "node:stream";
import { setTimeout as delay } from "node:timers/promises";
import { openOwnPlotter } from "../host/handle/own-plotter.js";
import { serverClient } from "../host/handle/server-client.js";
import type { LiveDrawing, PlotterHandle } from "../host/handle/plotter-handle.js";
import { openPlotter } from "../server/plotter/open-plotter.js";
import { nodeClock } from "../server/serial/node-clock.js";
import { VirtualBoard, type Clock, type Transport } from "../src/index.js";
import { scaledClock } from "../src/internal.js";
import { temporaryFolder } from "../test/support/processes/folders.js";
import type { FromServer } from "./live-server.js";
import type { Report } from "./run.js";

const STROKES = 40;
const POINTS = 1_000_000;
const STROKE_POINTS = 5_000;
const SPEEDUP = 10;
const SERVER_SPEEDUP = 100;
/** Commands with steps. */
const MOTION = /^(LT|LM|SM|XM|T3|L3|TD),/m;

export default async function liveBench(report: Report): Promise<void> {
  report("Live drawing", [...(await latency()), ...(await memory()), ...(await serverMemory())]);
}

/** `wrote`: gets what the host writes to the board. */
async function plotterOn(clock: Clock, wrote: (text: string) => void): Promise<PlotterHandle> {
  const board = new VirtualBoard({ clock, recordLine: false });
  const open = (): Promise<Transport> => {
    const line = board.transport();
    const write = (bytes: Uint8Array): Promise<void> => {
      wrote(new TextDecoder().decode(bytes));
      return line.write(bytes);
    };
    return Promise.resolve(
      new Proxy(line, { get: (of, name) => (name === "write" ? write : bound(of, name)) }),
    );
  };
  const devices = { find: () => Promise.resolve([]), open };
  return openOwnPlotter({ device: "port" }, {}, { clock, devices });
}

function bound(of: Transport, name: string | symbol): unknown {
  const value: unknown = Reflect.get(of, name);
  return typeof value === "function" ? (value.bind(of) as unknown) : value;
}

async function latency() {
  let sentMs = 0;
  let isWaiting = false;
  const times: number[] = [];
  const plotter = await plotterOn(nodeClock, (text) => {
    if (!isWaiting || !MOTION.test(text)) return;
    isWaiting = false;
    times.push(performance.now() - sentMs);
  });
  const live = await plotter.live();
  for (let i = 0; i < STROKES; i++) {
    const [x, y] = [50 + 4 * (i % 8), 50 + 3 * (i % 5)];
    sentMs = performance.now();
    isWaiting = true;
    await live.stroke([
      [x, y],
      [x + 2, y + 1],
    ]);
    await live.idle();
  }
  await live.end();
  await plotter.close();
  times.sort((a, b) => a - b);
  const at = (share: number): string => `${times[Math.floor(share * (times.length - 1))].toFixed(0)} ms`;
  return [
    { what: "from stroke() to the first step, 50 %", value: at(0.5) },
    { what: "from stroke() to the first step, 95 %", value: at(0.95) },
  ];
}

async function memory() {
  const plotter = await plotterOn(scaledClock(nodeClock, SPEEDUP), () => undefined);
  const live = await plotter.live({ speed: 80 });
  const before = process.memoryUsage();
  let mostHeap = 0;
  let mostArrays = 0;
  const startMs = performance.now();
  await drawPoints(live, () => {
    const { heapUsed, arrayBuffers } = process.memoryUsage();
    mostHeap = Math.max(mostHeap, heapUsed - before.heapUsed);
    mostArrays = Math.max(mostArrays, arrayBuffers - before.arrayBuffers);
  });
  await live.end();
  const s = (performance.now() - startMs) / 1_000;
  await plotter.close();
  return [
    { what: "a million points: most heap", value: mb(mostHeap) },
    { what: "a million points: most in arrays", value: mb(mostArrays) },
    { what: `a million points: time on a board ${SPEEDUP} times as fast`, value: `${s.toFixed(0)} s` },
  ];
}

const mb = (bytes: number): string => `${(bytes / 1e6).toFixed(0)} MB`;

const pointOf = (i: number): [x: number, y: number] => [
  20 + (i % STROKE_POINTS) / 25,
  30 + 0.5 * Math.floor(i / STROKE_POINTS) + 5 * Math.sin(i / 200),
];

/** `sample`: called now and then. */
async function drawPoints(live: LiveDrawing, sample: () => void): Promise<void> {
  for (let i = 0; i < POINTS; i++) {
    await live.lineTo(...pointOf(i));
    if (i % STROKE_POINTS === STROKE_POINTS - 1) live.penUp();
    if (i % 1_000 === 0) sample();
  }
}

function* linesOfPoints(): Generator<string> {
  for (let i = 0; i < POINTS; i += STROKE_POINTS) {
    const stroke = Array.from({ length: STROKE_POINTS }, (_, k) => pointOf(i + k).join(" "));
    yield `${stroke.join("\n")}\nup\n`;
  }
}

/** The memory of the whole process of a server. */
async function serverMemory() {
  const data = temporaryFolder("bench-live");
  const child = fork(path.join(import.meta.dirname, "live-server.ts"), [data.path, String(SERVER_SPEEDUP)], {
    execArgv: ["--import", "tsx"],
  });
  const said = async (): Promise<FromServer> => ((await once(child, "message")) as [FromServer])[0];
  const most = async (): Promise<string> => {
    child.send("most");
    const answer = await said();
    return "mostBytes" in answer ? mb(answer.mostBytes) : "";
  };
  const begun = await said();
  const url = "url" in begun ? begun.url : "";
  const { state } = serverClient({ url });
  const plotter = await openPlotter({ url });
  await delay(1_000);
  const atRest = await most();
  const live = await plotter.live({ speed: 80 });
  await drawPoints(live, () => undefined);
  await live.end();
  const bySocket = await most();
  await plotter.close();
  while ((await state.get()).jobs[0].stats === null) await delay(100);
  const measuring = await most();
  const init = { method: "POST", body: Readable.toWeb(Readable.from(linesOfPoints())), duplex: "half" };
  const answer = await fetch(`${url}/api/v1/plotters/main/live`, init as RequestInit);
  if (!answer.ok) throw new Error(await answer.text());
  const byRequest = await most();
  child.disconnect();
  await once(child, "exit");
  data.remove();
  return [
    { what: "a server at rest: its whole memory", value: atRest },
    { what: "a server that gets a million points over a WebSocket", value: bySocket },
    { what: "a server that then measures that drawing, as any other job", value: measuring },
    { what: "a server that gets a million points as the lines of a request", value: byRequest },
  ];
}
