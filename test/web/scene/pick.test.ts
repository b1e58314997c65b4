import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { buildPickGrid, nearestPiece } from "../../../web/scene/pick.js";
import { PIECE_BYTES, PIECE_FLOATS, type Pieces } from "../../../web/scene/pieces.js";
import { cases } from "../../support/runs/full-run.js";

type Line = readonly [number, number, number, number];
const piecesOf = (lines: readonly Line[]): Pieces => {
  const bytes = new ArrayBuffer(lines.length * PIECE_BYTES);
  const floats = new Float32Array(bytes);
  lines.forEach((line, i) => floats.set(line, i * PIECE_FLOATS));
  return { count: lines.length, bytes };
};
const distance = ([x0, y0, x1, y1]: Line, x: number, y: number): number => {
  const dx = x1 - x0;
  const dy = y1 - y0;
  const length2 = dx * dx + dy * dy;
  const f = length2 > 0 ? Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / length2)) : 0;
  return Math.hypot(x - x0 - f * dx, y - y0 - f * dy);
};
const mm = fc.integer({ min: 0, max: 400 }).map((n) => n / 2);
const lines = fc.array(fc.tuple(mm, mm, mm, mm), { minLength: 1, maxLength: 60 });

describe("picking", () => {
  it("finds the nearest piece, like a search of all of them", () => {
    fc.assert(
      fc.property(lines, mm, mm, fc.double({ min: 0.5, max: 30, noNaN: true }), (drawn, x, y, reachMm) => {
        const pieces = piecesOf(drawn);
        const found = nearestPiece(buildPickGrid(pieces), pieces, x, y, reachMm);
        const nearest = Math.min(...drawn.map((line) => distance(line, x, y)));
        if (found) expect(found.distanceMm).toBeCloseTo(nearest, 4);
        else expect(nearest).toBeGreaterThan(reachMm);
      }),
      { numRuns: cases() },
    );
  });

  it("prefers the later one if strokes overlap", () => {
    const pieces = piecesOf([
      [0, 0, 10, 0],
      [0, 0, 10, 0],
    ]);
    expect(nearestPiece(buildPickGrid(pieces), pieces, 5, 0.1, 1)?.piece).toBe(1);
  });

  it("finds nothing in an empty drawing", () => {
    const pieces = piecesOf([]);
    expect(nearestPiece(buildPickGrid(pieces), pieces, 0, 0, 10)).toBeNull();
  });
});
