/**
 * Live drawing: how long after `stroke` the first step comes on an idle board, and how much memory a million points take.
 * The virtual board runs in this process; for the million points the time of board and host runs faster.
 */
import { openOwnPlotter } from "../host/handle/own-plotter.js";
import type { PlotterHandle } from "../host/handle/plotter-handle.js";
import { nodeClock } from "../server/serial/node-clock.js";
import { VirtualBoard, type Clock, type Transport } from "../src/index.js";
import { scaledClock } from "../src/internal.js";
import type { Report } from "./run.js";

const STROKES = 40;
const POINTS = 1_000_000;
const SPEEDUP = 10;
/** Commands with steps. */
const MOTION = /^(LT|LM|SM|XM|T3|L3|TD),/m;

export default async function liveBench(report: Report): Promise<void> {
  report("Live drawing", [...(await latency()), ...(await memory())]);
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
  for (let i = 0; i < POINTS; i++) {
    const [x, y] = [20 + (i % 5_000) / 25, 30 + 0.5 * Math.floor(i / 5_000) + 5 * Math.sin(i / 200)];
    await live.lineTo(x, y);
    if (i % 5_000 === 4_999) live.penUp();
    if (i % 1_000 > 0) continue;
    const { heapUsed, arrayBuffers } = process.memoryUsage();
    mostHeap = Math.max(mostHeap, heapUsed - before.heapUsed);
    mostArrays = Math.max(mostArrays, arrayBuffers - before.arrayBuffers);
  }
  await live.end();
  const s = (performance.now() - startMs) / 1_000;
  await plotter.close();
  const mb = (bytes: number): string => `${(bytes / 1e6).toFixed(0)} MB`;
  return [
    { what: "a million points: most heap", value: mb(mostHeap) },
    { what: "a million points: most in arrays", value: mb(mostArrays) },
    { what: `a million points: time on a board ${SPEEDUP} times as fast`, value: `${s.toFixed(0)} s` },
  ];
}
