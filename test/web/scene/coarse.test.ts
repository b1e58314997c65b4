import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, type StrokeSet } from "../../../src/index.js";
import { coarsePieces } from "../../../web/scene/coarse.js";
import { boxPieces, rangesInSight, type PieceRange } from "../../../web/scene/tasks.js";
import { LAYER_SHORT, PIECE_FLOATS, PIECE_SHORTS, type Pieces } from "../../../web/scene/pieces.js";
import { buildScene } from "../../../web/scene/scene.js";

/** Waves of two layers, side by side and apart. */
const waves = (strokes: number, points: number): StrokeSet => ({
  xy: Float64Array.from({ length: strokes * points * 2 }, (_, k) => {
    const stroke = Math.floor(k / 2 / points);
    const i = Math.floor(k / 2) % points;
    return k % 2 === 0 ? 10 + (i / points) * 180 : 10 + stroke * 5 + 2 * Math.sin(i / 15);
  }),
  offsets: Uint32Array.from({ length: strokes + 1 }, (_, i) => i * points),
  layer: Uint16Array.from({ length: strokes }, (_, i) => i % 2),
  layers: ["a", "b"].map((id) => ({ id, name: id, color: null })),
});
const strokes = waves(20, 1_500);
const { draw } = buildScene(plan(strokes, DEFAULT_MOTION, DEFAULT_PEN), strokes.layer);

const at = ({ bytes }: Pieces, i: number) => {
  const [x0, y0, x1, y1, t0, t1] = new Float32Array(bytes, i * PIECE_FLOATS * 4, 6);
  const layer = new Uint16Array(bytes)[i * PIECE_SHORTS + LAYER_SHORT];
  return { x0: x0, y0: y0, x1: x1, y1: y1, t0: t0, t1: t1, layer };
};
const all = (pieces: Pieces) => Array.from({ length: pieces.count }, (_, i) => at(pieces, i));

describe("a drawing in few pieces", () => {
  it("is the drawing itself if it has few", () => {
    expect(coarsePieces(draw, draw.count)).toBe(draw);
  });

  it("joins consecutive pieces, and omits none while there is room", () => {
    expect(draw.count).toBeGreaterThan(10_000);
    const coarse = coarsePieces(draw, 4_000);
    expect(coarse.count).toBeLessThanOrEqual(4_000);
    const pieces = all(coarse);
    // 5 mm lie between two strokes: a piece that joined them would be long.
    for (const { x0, y0, x1, y1 } of pieces) expect(Math.hypot(x1 - x0, y1 - y0)).toBeLessThan(4);
    for (let i = 1; i < pieces.length; i++) {
      expect(pieces[i].t0).toBeGreaterThanOrEqual(pieces[i - 1].t1 - 1e-3);
      if (pieces[i].layer !== pieces[i - 1].layer) continue;
      expect(pieces[i].x0).toBeCloseTo(pieces[i - 1].x1, 2);
    }
    expect(pieces[0].t0).toBe(at(draw, 0).t0);
    expect(pieces.at(-1)!.t1).toBe(at(draw, draw.count - 1).t1);
  });

  it("stays below its maximum if nothing can be joined", () => {
    const dots = waves(500, 1);
    const scene = buildScene(plan(dots, DEFAULT_MOTION, DEFAULT_PEN), dots.layer);
    expect(scene.draw.count).toBe(500);
    const coarse = coarsePieces(scene.draw, 60);
    expect(coarse.count).toBeGreaterThan(40);
    expect(coarse.count).toBeLessThanOrEqual(60);
    const places = new Set(all(scene.draw).map(({ x0, y0 }) => `${x0} ${y0}`));
    for (const { x0, y0 } of all(coarse)) expect(places.has(`${x0} ${y0}`)).toBe(true);
  });
});

describe("the visible pieces", () => {
  const boxes = boxPieces(draw);
  const whole: PieceRange = [0, draw.count];
  const has = (ranges: readonly PieceRange[], i: number): boolean =>
    ranges.some(([from, to]) => from <= i && i < to);

  it("are all of them if the whole paper is visible", () => {
    const seen = { view: { scale: 3, offsetX: 5, offsetY: 5 }, width: 700, height: 900 };
    expect(rangesInSight(boxes, whole, seen, 2)).toEqual([whole]);
  });

  it("include every piece that touches the frame, and exclude most of those far from it", () => {
    const seen = { view: { scale: 20, offsetX: -1_500, offsetY: -700 }, width: 600, height: 300 };
    const ranges = rangesInSight(boxes, whole, seen, 2);
    const { scale, offsetX, offsetY } = seen.view;
    let inSight = 0;
    all(draw).forEach(({ x0, y0, x1, y1 }, i) => {
      const isLeft = Math.max(x0, x1) * scale + offsetX < -2;
      const isRight = Math.min(x0, x1) * scale + offsetX > seen.width + 2;
      const isAbove = Math.max(y0, y1) * scale + offsetY < -2;
      const isBelow = Math.min(y0, y1) * scale + offsetY > seen.height + 2;
      if (isLeft || isRight || isAbove || isBelow) return;
      inSight++;
      expect(has(ranges, i)).toBe(true);
    });
    expect(inSight).toBeGreaterThan(100);
    const drawn = ranges.reduce((sum, [from, to]) => sum + to - from, 0);
    expect(drawn).toBeLessThan(draw.count / 3);
  });

  it("stay within the requested part", () => {
    const seen = { view: { scale: 3, offsetX: 5, offsetY: 5 }, width: 700, height: 900 };
    expect(rangesInSight(boxes, [700, 1_900], seen, 2)).toEqual([[700, 1_900]]);
    expect(rangesInSight(boxes, [700, 700], seen, 2)).toEqual([]);
  });
});
