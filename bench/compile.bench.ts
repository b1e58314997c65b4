/** Compiling a plan of a million blocks for each generation of firmware, and the growth with its length. */
import { performance } from "node:perf_hooks";
import {
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  machineById,
  plan,
  type StrokeSet,
  type Trajectory,
} from "../src/index.js";

type Report = (section: string, rows: readonly Record<string, string | number>[]) => void;

const FIRMWARE = ["2.4.4", "2.5.3", "2.8.1", "3.0.3"];
const BLOCKS = 1_000_000;
const MACHINE = machineById("axidraw-v3");

export default async function compileBench(report: Report): Promise<void> {
  const trajectory = lettering(BLOCKS);
  report(
    `Compiling ${trajectory.blockCount} blocks, one thread`,
    FIRMWARE.map((firmware) => measured(trajectory, firmware)),
  );
  report(
    "Compiling for firmware 3.0.3: growth",
    [BLOCKS / 100, BLOCKS / 10, BLOCKS].map((blocks) => measured(lettering(blocks), "3.0.3")),
  );
}

function measured(trajectory: Trajectory, firmware: string): Record<string, string | number> {
  const startMs = performance.now();
  const stream = compile(trajectory, { machine: MACHINE, firmware, pen: DEFAULT_PEN });
  const ms = performance.now() - startMs;
  return {
    firmware,
    blocks: trajectory.blockCount,
    commands: stream.count,
    ms: Math.round(ms),
    "µs a block": Number(((ms * 1_000) / trajectory.blockCount).toFixed(2)),
    "MB of text": Number((stream.text.length / 1e6).toFixed(1)),
  };
}

/** Small loops side by side, as in a page of handwriting: about three blocks per segment. */
function lettering(blocks: number): Trajectory {
  const pointsAStroke = 40;
  const strokes = Math.max(1, Math.round(blocks / (2.4 * pointsAStroke)));
  const xy = new Float64Array(2 * strokes * pointsAStroke);
  const offsets = new Uint32Array(strokes + 1);
  for (let s = 0; s < strokes; s++) {
    offsets[s + 1] = (s + 1) * pointsAStroke;
    for (let i = 0; i < pointsAStroke; i++) {
      const angle = (i * 2 * Math.PI) / 16;
      const at = 2 * (s * pointsAStroke + i);
      xy[at] = 10 + (s % 100) * 2.5 + i * 0.05 + 1.2 * Math.cos(angle);
      xy[at + 1] = 10 + ((s / 100) % 60) * 3 + (1 + (i % 3) / 3) * Math.sin(angle);
    }
  }
  const set: StrokeSet = {
    xy,
    offsets,
    layer: new Uint16Array(strokes),
    layers: [{ id: "a", name: "a", color: null }],
  };
  return plan(set, DEFAULT_MOTION, DEFAULT_PEN);
}
