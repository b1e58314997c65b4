/**
 * Inverse dynamics, to compare shapers with: u = q + (2ζ/ω) q′ + q″/ω² of a jerk-limited plan q moves the pen of a spring
 * on q itself. Where the jerk jumps by Δj, the velocity of u jumps by Δj/ω². In pieces of a millisecond.
 */
import type { Trajectory } from "../../../src/index.js";
import type { Springs } from "../../../src/internal.js";
import { BlockColumns } from "../../../src/plan/block-columns.js";
import { blockState, newMotionState } from "../../../src/plan/trajectory.js";

const PIECE_S = 0.001;

export function inverseMotion(t: Trajectory, { xHz, yHz, damping }: Springs): Trajectory {
  const out = new BlockColumns(t.blockCount, false);
  const [wx, wy] = [2 * Math.PI * xHz, 2 * Math.PI * yHz];
  const firstBlock = new Uint32Array(t.runs.count + 1);
  for (let run = 0; run < t.runs.count; run++) {
    firstBlock[run] = out.count;
    for (let k = t.runs.firstBlock[run]; k < t.runs.firstBlock[run + 1]; k++) {
      const [jx, jy] = [t.jx?.[k] ?? 0, t.jy?.[k] ?? 0];
      const pieces = Math.ceil(t.durationS[k] / PIECE_S);
      const dt = t.durationS[k] / pieces;
      for (let i = 0; i < pieces; i++) {
        const q = blockState(t, k, i * dt, newMotionState());
        const middle = blockState(t, k, (i + 0.5) * dt, newMotionState());
        out.clockS = t.startS[k] + i * dt;
        out.push(
          dt,
          q.x + ((2 * damping) / wx) * q.vx + q.ax / wx ** 2,
          q.y + ((2 * damping) / wy) * q.vy + q.ay / wy ** 2,
          q.vx + ((2 * damping) / wx) * q.ax + jx / wx ** 2,
          q.vy + ((2 * damping) / wy) * q.ay + jy / wy ** 2,
          middle.ax + ((2 * damping) / wx) * jx,
          middle.ay + ((2 * damping) / wy) * jy,
          q.alongMm,
        );
      }
    }
  }
  firstBlock[t.runs.count] = out.count;
  const { durationS, x, y, vx, vy, ax, ay, startS, alongMm } = out;
  const columns = { durationS, x, y, vx, vy, ax, ay, startS, alongMm, jx: null, jy: null };
  return { ...t, ...columns, blockCount: out.count, runs: { ...t.runs, firstBlock } };
}
