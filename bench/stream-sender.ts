/** The host of bench/stream.bench.ts: plans a dense curve, streams it to the given port, reports, and ends. */
import {
  BoardSession,
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  machineById,
  plan,
  streamCommands,
  type StrokeSet,
} from "../src/index.js";
import { motionOfQuality } from "../src/internal.js";
import { nodeClock } from "../server/serial/node-clock.js";
import { openSerial } from "../server/serial/serial-transport.js";

export interface SenderTask {
  readonly pacing: "window" | "acks";
  /** False: one command for every piece of the polyline, as planned. */
  readonly merged: boolean;
  /** Quality fast, on springs of 15 and 25 Hz. */
  readonly shaped?: boolean;
}

export interface SenderReport {
  readonly commandCount: number;
  readonly plannedS: number;
  readonly underrunCount: number;
  readonly steps1: number;
  readonly steps2: number;
}

/** A rose of three nested turns: smooth, curved everywhere, a point every 0.3 mm, over 60 s long. */
function denseCurve(): StrokeSet {
  const points: number[] = [];
  const turns = 12;
  let lastX = Infinity;
  let lastY = Infinity;
  for (let a = 0; a <= 2 * Math.PI * turns; a += 0.0005) {
    const r = 45 + 22 * Math.cos((a * 7) / turns);
    const x = 100 + r * Math.cos(a);
    const y = 75 + r * Math.sin(a);
    if (Math.hypot(x - lastX, y - lastY) < 0.3) continue;
    points.push(x, y);
    lastX = x;
    lastY = y;
  }
  return {
    xy: Float64Array.from(points),
    offsets: Uint32Array.of(0, points.length / 2),
    layer: new Uint16Array(1),
    layers: [{ id: "all", name: "All", color: null }],
  };
}

const [port, taskText] = process.argv.slice(2);
const task = JSON.parse(taskText!) as SenderTask;
const session = new BoardSession(await openSerial(port!), { clock: nodeClock });
const { firmware } = await session.identify();
await session.send("EM,1,1");
const springs = { xHz: 15, yHz: 25, damping: 0.05 };
const machine = { ...machineById("axidraw-v3"), springs };
const plain = task.merged ? DEFAULT_MOTION : { ...DEFAULT_MOTION, mode: "junction" as const, fit: null };
const motion = task.shaped ? { ...plain, ...motionOfQuality("fast", springs) } : plain;
const trajectory = plan(denseCurve(), motion, DEFAULT_PEN, task.shaped ? { machine } : {});
const commands = compile(trajectory, {
  machine,
  firmware,
  pen: DEFAULT_PEN,
  start: { steps1: 0, steps2: 0, acc1: 0, acc2: 0 },
});
const { underrunCount, steps1, steps2 } = await streamCommands(session, commands, {
  clock: nodeClock,
  pacing: task.pacing,
  poll: { lines: ["QG"], everyS: 0.25 },
}).catch((error: unknown) => {
  // The last lines show whether the board, the connection or this process failed.
  console.error(session.log.tail(30).join("\n"));
  console.error(
    `${session.unansweredCount} unanswered, ${session.lostReplyCount} lost, ${session.strayCount} stray`,
  );
  throw error;
});
const report: SenderReport = {
  commandCount: commands.count,
  plannedS: commands.boardS[commands.count],
  underrunCount,
  steps1: steps1!,
  steps2: steps2!,
};
await session.close();
process.send!(report, () => process.exit(0));
