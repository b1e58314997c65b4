/** The simulated pen as pieces of a picture: exact, small, and coloured by the error. */
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, planJob } from "../../../src/index.js";
import { penError, swingPen, type PenPoint } from "../../../src/internal.js";
import {
  LAYER_SHORT,
  PIECE_BYTES,
  PIECE_FLOATS,
  PIECE_SHORTS,
  VALUE_SHORT,
} from "../../../web/scene/pieces.js";
import { piecesBefore } from "../../../web/scene/scene.js";
import { scaleTop, swingPicture } from "../../../web/scene/swing-scene.js";
import { strokeSetOf } from "../../support/drawings/arbitraries.js";
import { FIGURES, SPRINGS, swinging } from "../../support/machines/swinging.js";

const [springs] = SPRINGS;
const planned = (strokes: typeof FIGURES.stars) =>
  planJob({ strokes }, { motion: DEFAULT_MOTION, pen: DEFAULT_PEN }, swinging(springs)).trajectory;

describe("the picture of a swinging pen", () => {
  it.each(["stars", "curves", "zigzags"] as const)("is within 0.006 mm of each sample of %s", (name) => {
    const strokes = FIGURES[name];
    const trajectory = planned(strokes);
    const { pieces } = swingPicture(strokes, trajectory, springs);
    const floats = new Float32Array(pieces.bytes);
    const samples: PenPoint[] = [];
    swingPen(trajectory, springs, 0.001, (pen) => void (pen.stroke >= 0 && samples.push({ ...pen })));
    let worst = 0;
    let piece = 0;
    for (const { tS, x, y } of samples) {
      while (piece < pieces.count - 1 && floats[piece * PIECE_FLOATS + 5] < tS - 1e-4) piece++;
      // The sample may be the last one of the piece before.
      const near = [piece - 1, piece, piece + 1].filter((i) => i >= 0 && i < pieces.count);
      worst = Math.max(worst, Math.min(...near.map((i) => distance(floats, i, x, y))));
    }
    expect(worst).toBeLessThan(0.006);
    expect(pieces.count).toBeLessThan(samples.length / 2);
    expect(pieces.bytes.byteLength).toBe(pieces.count * PIECE_BYTES);
  });

  it("has the error as the share of its scale, and reports its progress", () => {
    const strokes = FIGURES.squares;
    const trajectory = planned(strokes);
    const shares: number[] = [];
    const { pieces, error, topMm } = swingPicture(strokes, trajectory, springs, (share) =>
      shares.push(share),
    );
    expect(error).toEqual(penError(strokes, trajectory, springs));
    expect(topMm).toBe(scaleTop(error.p99Mm));
    const shorts = new Uint16Array(pieces.bytes);
    let largest = 0;
    for (let i = 0; i < pieces.count; i++) {
      for (const end of [0, 1])
        largest = Math.max(largest, shorts[i * PIECE_SHORTS + VALUE_SHORT + end] / 65_535);
    }
    expect(largest * topMm).toBeGreaterThan(Math.min(topMm, error.maxMm) - 0.011);
    expect(largest).toBeLessThanOrEqual(1);
    expect(shares).toEqual([...shares].sort((a, b) => a - b));
    expect(shares[shares.length - 1]).toBeLessThanOrEqual(1 + 1e-9);
  });

  it("is in order of time, with each layer's strokes and dots where its pen draws them", () => {
    const set = strokeSetOf(
      [
        [
          [10, 10],
          [40, 10],
          [40, 40],
        ],
        [[60, 60]],
        [
          [80, 10],
          [80, 40],
        ],
      ],
      [0, 1, 1],
    );
    const layers = set.layers.map((layer, i) => (i === 1 ? { ...layer, shiftMm: { x: 5, y: 0 } } : layer));
    const strokes = { ...set, layers };
    const trajectory = planned(strokes);
    const { pieces } = swingPicture(strokes, trajectory, springs);
    const floats = new Float32Array(pieces.bytes);
    const shorts = new Uint16Array(pieces.bytes);
    const rows = Array.from({ length: pieces.count }, (_, i) => ({
      xy: [...floats.slice(i * PIECE_FLOATS, i * PIECE_FLOATS + 4)],
      t: floats[i * PIECE_FLOATS + 4],
      layer: shorts[i * PIECE_SHORTS + LAYER_SHORT],
    }));
    expect(rows.map(({ t }) => t)).toEqual(rows.map(({ t }) => t).sort((a, b) => a - b));
    expect(rows.filter(({ xy }) => xy.join() === "55,60,55,60")).toHaveLength(1);
    const last = rows[rows.length - 1];
    expect(last.layer).toBe(1);
    expect(last.xy[2]).toBeCloseTo(75, 0);
    expect(piecesBefore(pieces, trajectory.totalS)).toBe(pieces.count);
  });

  it("has a scale that ends at a round number, with a minimum", () => {
    expect([0, 0.004, 0.05, 0.06, 0.13, 0.31, 0.5, 1.2].map(scaleTop)).toEqual([
      0.05, 0.05, 0.05, 0.07, 0.15, 0.5, 0.5, 1.5,
    ]);
    expect(scaleTop(NaN)).toBe(0.05);
  });
});

const distance = (floats: Float32Array, piece: number, x: number, y: number): number => {
  const [x0, y0, x1, y1] = floats.subarray(piece * PIECE_FLOATS, piece * PIECE_FLOATS + 4);
  const [dx, dy] = [x1 - x0, y1 - y0];
  const length2 = dx * dx + dy * dy;
  const share = length2 > 0 ? Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / length2)) : 0;
  return Math.hypot(x - x0 - share * dx, y - y0 - share * dy);
};
