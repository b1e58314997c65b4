import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  plan,
  stateAt,
  type StrokeSet,
  type Trajectory,
} from "../../../src/index.js";
import { strokeFigures } from "../../../web/preview/stroke.js";
import { hoverAt } from "../../../web/scene/hover.js";
import type { Planned } from "../../../web/worker/protocol.js";
import {
  LAYER_SHORT,
  PIECE_BYTES,
  PIECE_FLOATS,
  PIECE_SHORTS,
  VALUE_SHORT,
  type Pieces,
} from "../../../web/scene/pieces.js";
import {
  buildScene,
  piecesBefore,
  SLOWEST_TIMES,
  usualSpeeds,
  withSpeeds,
  withTimes,
} from "../../../web/scene/scene.js";
import { penMoveColumns } from "../../../src/plan/pen/pen-moves.js";

const strokeSet = (...strokes: (readonly number[])[]): StrokeSet => ({
  xy: Float64Array.from(strokes.flat()),
  offsets: Uint32Array.from([0, ...strokes.map((_, i) => strokes.slice(0, i + 1).flat().length / 2)]),
  layer: Uint16Array.from(strokes.map((_, i) => i)),
  layers: strokes.map((_, i) => ({ id: `l${i}`, name: `Layer ${i}`, color: null })),
});

const wave = Array.from({ length: 400 }, (_, i) => [20 + i / 4, 60 + 20 * Math.sin(i / 20)]).flat();
const drawing = strokeSet([10, 10, 50, 10, 50, 40, 30, 40, 30, 12], wave, [80, 80]);
const trajectory = plan(drawing, DEFAULT_MOTION, DEFAULT_PEN);
const scene = buildScene(trajectory, drawing.layer);

const pieceAt = (pieces: Pieces, i: number) => {
  const f = new Float32Array(pieces.bytes).subarray(i * PIECE_FLOATS);
  const s = new Uint16Array(pieces.bytes).subarray(i * PIECE_SHORTS);
  return {
    x0: f[0],
    y0: f[1],
    x1: f[2],
    y1: f[3],
    t0: f[4],
    t1: f[5],
    speed0: s[VALUE_SHORT] / 65_535,
    speed1: s[VALUE_SHORT + 1] / 65_535,
    layer: s[LAYER_SHORT],
  };
};
const allOf = (pieces: Pieces) => Array.from({ length: pieces.count }, (_, i) => pieceAt(pieces, i));

/** A quarter circle as one block of constant acceleration: the curve that blends corners. */
const parabola = (): Trajectory => ({
  blockCount: 1,
  durationS: Float64Array.of(1),
  x: Float64Array.of(0),
  y: Float64Array.of(0),
  vx: Float64Array.of(40),
  vy: Float64Array.of(0),
  ax: Float64Array.of(0),
  ay: Float64Array.of(40),
  jx: null,
  jy: null,
  startS: Float64Array.of(0),
  alongMm: Float64Array.of(0),
  runs: {
    count: 1,
    firstBlock: Uint32Array.of(0, 1),
    stroke: Int32Array.of(0),
    startS: Float64Array.of(0),
  },
  penMoves: penMoveColumns([]),
  totalS: 1,
  endX: 40,
  endY: 20,
});

describe("the scene", () => {
  it("shows each piece where the plan is at its two instants", () => {
    for (const pieces of [scene.draw, scene.travel]) {
      for (const piece of allOf(pieces)) {
        const middle = stateAt(trajectory, (piece.t0 + piece.t1) / 2);
        const along = Math.hypot(piece.x1 - piece.x0, piece.y1 - piece.y0);
        const toMiddle =
          Math.hypot(middle.x - piece.x0, middle.y - piece.y0) +
          Math.hypot(middle.x - piece.x1, middle.y - piece.y1);
        expect(toMiddle).toBeLessThan(along + 0.02);
      }
    }
  });

  it("colours each end by the true speed there", () => {
    for (const piece of allOf(scene.draw)) {
      if (piece.t1 === piece.t0) continue;
      const inside = piece.t0 + (piece.t1 - piece.t0) * 0.25;
      const { vx, vy } = stateAt(trajectory, inside);
      const low = Math.min(piece.speed0, piece.speed1) * scene.topDrawMmPerS;
      const high = Math.max(piece.speed0, piece.speed1) * scene.topDrawMmPerS;
      // In the middle of a corner's curve the pen is slightly slower than at both ends of a piece.
      expect(Math.hypot(vx, vy)).toBeGreaterThan(low - 0.01 * scene.topDrawMmPerS);
      expect(Math.hypot(vx, vy)).toBeLessThan(high + 0.2);
    }
  });

  it("limits the change of speed within a visible piece", () => {
    for (const piece of allOf(scene.draw)) {
      const length = Math.hypot(piece.x1 - piece.x0, piece.y1 - piece.y0);
      if (length > 0.5) expect(Math.abs(piece.speed1 - piece.speed0)).toBeLessThan(0.12);
    }
  });

  it("separates strokes from moves with the pen up, and has the layer of each stroke", () => {
    expect(new Set(allOf(scene.draw).map(({ layer }) => layer))).toEqual(new Set([0, 1, 2]));
    const drawMm = allOf(scene.draw).reduce((sum, p) => sum + Math.hypot(p.x1 - p.x0, p.y1 - p.y0), 0);
    let expectedMm = 40 + 30 + 20 + 28;
    for (let i = 2; i < wave.length; i += 2) {
      expectedMm += Math.hypot(wave[i] - wave[i - 2], wave[i + 1] - wave[i - 1]);
    }
    // Corners are drawn as small curves within the corner tolerance: the path is slightly shorter.
    expect(drawMm).toBeLessThan(expectedMm + 0.01);
    expect(drawMm).toBeGreaterThan(expectedMm - 0.5);
  });

  it("shows a dot where the pen touches without moving", () => {
    const dots = allOf(scene.draw).filter((piece) => piece.layer === 2);
    expect(dots).toHaveLength(1);
    expect(dots[0]).toMatchObject({ x0: 80, y0: 80, x1: 80, y1: 80 });
  });

  it("splits a curve so finely that the chords stay on it", () => {
    const curve = parabola();
    const { draw } = buildScene(curve, Uint16Array.of(0));
    expect(draw.count).toBeGreaterThan(10);
    for (const piece of allOf(draw)) {
      const middle = stateAt(curve, (piece.t0 + piece.t1) / 2);
      const gap = Math.hypot(middle.x - (piece.x0 + piece.x1) / 2, middle.y - (piece.y0 + piece.y1) / 2);
      expect(gap).toBeLessThan(0.01);
    }
  });

  it("counts what is drawn before a time", () => {
    expect(piecesBefore(scene.draw, -1)).toBe(0);
    expect(piecesBefore(scene.draw, scene.totalS + 1)).toBe(scene.draw.count);
    const half = piecesBefore(scene.draw, scene.totalS / 2);
    expect(pieceAt(scene.draw, half - 1).t0).toBeLessThan(scene.totalS / 2);
    expect(pieceAt(scene.draw, half).t0).toBeGreaterThanOrEqual(scene.totalS / 2);
  });

  it("has nothing drawn of the stroke that begins at that time, at any time of a long plot", () => {
    const rows = Array.from({ length: 40 }, (_, i) => [10, 10 + i, 210.3, 10 + i]);
    const long = plan(strokeSet(...rows), DEFAULT_MOTION, DEFAULT_PEN);
    const { draw } = buildScene(long, new Uint16Array(rows.length));
    const { runs } = long;
    for (let r = 0; r < runs.count; r++) {
      if (runs.stroke[r] < 0) continue;
      const startS = long.startS[runs.firstBlock[r]];
      expect(pieceAt(draw, piecesBefore(draw, startS)).t0).toBe(Math.fround(startS));
    }
  });

  it("is empty for a drawing without strokes", () => {
    const empty = strokeSet();
    const nothing = buildScene(plan(empty, DEFAULT_MOTION, DEFAULT_PEN), empty.layer);
    expect(nothing.draw.count).toBe(0);
    expect(nothing.travel.count).toBe(0);
  });
});

describe("hovering", () => {
  const planned = {
    scene,
    trajectory,
    drawnLayers: drawing.layers,
  } as unknown as Planned;
  const hover = (xMm: number, yMm: number) =>
    hoverAt(planned, { xPx: 0, yPx: 0, isRight: false, isLow: false, xMm, yMm }, 4);

  it("returns speed, time, stroke and layer of the plan at that place", () => {
    const found = hover(30, 10.2)!;
    expect(found.layerName).toBe("Layer 0");
    expect(found.strokeNumber).toBe(1);
    const state = stateAt(trajectory, found.tS);
    expect(state.x).toBeCloseTo(30, 1);
    expect(Math.abs(state.y - 10)).toBeLessThanOrEqual(DEFAULT_MOTION.draw.cornerMm);
    expect(found.speedMmPerS).toBeCloseTo(Math.hypot(state.vx, state.vy), 9);
  });

  it("returns the number of a dot", () => {
    expect(hover(80.5, 80)).toMatchObject({ strokeNumber: 3, layerName: "Layer 2" });
  });

  it("returns nothing beside the strokes", () => {
    expect(hover(200, 200)).toBeNull();
  });
});

describe("one stroke of a plan", () => {
  it("has its own line and no other's, its length and its time", () => {
    const { lengthMm, points, startS, durationS } = strokeFigures({ scene, trajectory }, 0)!;
    // Its corners are slightly rounded.
    expect(lengthMm).toBeGreaterThan(115);
    expect(lengthMm).toBeLessThanOrEqual(118.001);
    expect([...points.slice(0, 2), ...points.slice(-2)].map(Math.round)).toEqual([10, 10, 30, 12]);
    expect(stateAt(trajectory, startS + durationS / 2).y).toBeGreaterThan(9);
    const next = strokeFigures({ scene, trajectory }, 1)!;
    expect(next.startS).toBeGreaterThan(startS + durationS - 1e-9);
    expect(Math.min(...next.points)).toBeGreaterThan(19);
  });

  it("is a point for a dot, and nothing beyond the last", () => {
    expect([...strokeFigures({ scene, trajectory }, 2)!.points]).toEqual([80, 80, 80, 80]);
    expect(strokeFigures({ scene, trajectory }, 3)).toBeNull();
  });
});

describe("the scene of the view of speed", () => {
  it("has the same pieces, with their speeds within the range of most of the ink", () => {
    const range = usualSpeeds(scene);
    expect(range.from).toBeLessThan(range.to);
    const shown = withSpeeds(scene, range);
    const [speeds, values] = [new Uint16Array(scene.draw.bytes), new Uint16Array(shown.draw.bytes)];
    for (let i = 0; i < speeds.length; i++) {
      const part = i % PIECE_SHORTS;
      const isValue = part === VALUE_SHORT || part === VALUE_SHORT + 1;
      const share = (speeds[i] / 65_535 - range.from) / (range.to - range.from);
      if (isValue) expect(values[i] / 65_535).toBeCloseTo(Math.min(1, Math.max(0, share)), 4);
      else expect(values[i]).toBe(speeds[i]);
    }
  });

  it("begins at rest if nearly all is drawn at one speed, and has a range without ink", () => {
    const even = (count: number): Pieces => {
      const bytes = new ArrayBuffer(count * PIECE_BYTES);
      for (let i = 0; i < count; i++) {
        new Float32Array(bytes).set([0, 0, 1, 0], i * PIECE_FLOATS);
        new Uint16Array(bytes).set([65_535, 65_535], i * PIECE_SHORTS + VALUE_SHORT);
      }
      return { count, bytes };
    };
    expect(usualSpeeds({ draw: even(20) })).toEqual({ from: 0, to: 1 });
    expect(usualSpeeds({ draw: even(0) })).toEqual({ from: 0, to: 1 });
  });
});

describe("the scene of the view of time", () => {
  it("has the same pieces, with the time that a mm takes by ratio, from the fastest to ten times as slow", () => {
    const times = withTimes(scene);
    expect(times).toMatchObject({ travel: scene.travel, totalS: scene.totalS });
    expect(times.draw.count).toBe(scene.draw.count);
    const [speeds, values] = [new Uint16Array(scene.draw.bytes), new Uint16Array(times.draw.bytes)];
    for (let i = 0; i < speeds.length; i++) {
      const part = i % PIECE_SHORTS;
      if (part !== VALUE_SHORT && part !== VALUE_SHORT + 1) {
        expect(values[i]).toBe(speeds[i]);
        continue;
      }
      const slower = SLOWEST_TIMES ** (values[i] / 65_535);
      expect(slower).toBeCloseTo(Math.min(SLOWEST_TIMES, 65_535 / Math.max(1, speeds[i])), 2);
    }
  });
});
