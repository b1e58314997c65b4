import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  PlotwrightError,
  plan,
  stateAt,
  trajectoryStats,
  type MotionSettings,
} from "../../../src/index.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";

const motion: MotionSettings = { ...DEFAULT_MOTION, mode: "junction", fit: null };
const square: Point[] = [
  [10, 10],
  [20, 10],
  [20, 20],
  [10, 20],
  [10, 10],
];

describe("settings that are left out", () => {
  it("have their defaults, at every depth", () => {
    const strokes = strokeSetOf([square]);
    const draw = { ...DEFAULT_MOTION.draw, speedMmPerS: 40 };
    const complete = plan(strokes, { ...DEFAULT_MOTION, draw }, { ...DEFAULT_PEN, upPct: 70 });
    expect(plan(strokes, { draw: { speedMmPerS: 40 } }, { upPct: 70 })).toEqual(complete);
    expect(plan(strokes)).toEqual(plan(strokes, DEFAULT_MOTION, DEFAULT_PEN));
  });

  it("are not mistaken for misspelt ones", () => {
    expect(() => plan(strokeSetOf([square]), { draw: { speedMmS: 40 } as never })).toThrow(
      /no draw setting "speedMmS"/,
    );
  });
});

describe("the sequence of runs", () => {
  it("is travel, drop, draw, lift for every stroke, then home", () => {
    const t = plan(
      strokeSetOf([
        square,
        [
          [50, 50],
          [60, 50],
        ],
      ]),
      motion,
      { ...DEFAULT_PEN, overlap: "off" },
    );
    expect(Array.from(t.runs.stroke)).toEqual([-1, 0, -1, 1, -1]);
    expect(penMovesOf(t).map((m) => [m.beforeRun, m.up, m.heightPct, m.waitS])).toEqual([
      [1, false, 30, 0.154],
      [2, true, 60, 0.141],
      [3, false, 30, 0.154],
      [4, true, 60, 0.141],
    ]);
    expect([t.endX, t.endY]).toEqual([0, 0]);
  });

  it("of an empty drawing is empty", () => {
    const t = plan(strokeSetOf([]), motion, DEFAULT_PEN);
    expect([t.blockCount, t.runs.count, t.penMoves.count, t.totalS]).toEqual([0, 0, 0, 0]);
  });

  it("has a drop and a lift for a dot, without motion between them", () => {
    const t = plan(strokeSetOf([[[30, 40]]]), motion, DEFAULT_PEN);
    expect(Array.from(t.runs.stroke)).toEqual([-1, 0, -1]);
    expect(t.runs.firstBlock[1]).toBe(t.runs.firstBlock[2]);
    expect(trajectoryStats(t)).toMatchObject({ drawMm: 0, penLiftCount: 1 });
    expect(trajectoryStats(t).travelMm).toBeCloseTo(100, 9);
  });

  it("has no travel to where the carriage already is, and none home if it should stay", () => {
    const t = plan(strokeSetOf([square]), motion, DEFAULT_PEN, { startX: 10, startY: 10, returnHome: false });
    expect(Array.from(t.runs.stroke)).toEqual([0]);
    expect(penMovesOf(t).map((m) => m.up)).toEqual([false, true]);
    expect([t.endX, t.endY]).toEqual([10, 10]);
  });

  it("keeps the pen down if a stroke continues from the last one, but not across layers", () => {
    const strokes: Point[][] = [
      [
        [0, 0],
        [5, 0],
      ],
      [
        [5, 0],
        [5, 5],
      ],
    ];
    expect(plan(strokeSetOf(strokes), motion, DEFAULT_PEN).penMoves.count).toBe(2);
    expect(plan(strokeSetOf(strokes, [0, 1]), motion, DEFAULT_PEN).penMoves.count).toBe(4);
  });

  it("begins in mid-stroke on request", () => {
    const t = plan(strokeSetOf([square]), motion, DEFAULT_PEN, { from: { stroke: 0, alongMm: 15 } });
    const first = t.runs.firstBlock[1];
    expect([t.x[first], t.y[first], t.alongMm[first]]).toEqual([20, 15, 15]);
    expect(trajectoryStats(t).drawMm).toBeCloseTo(25, 9);
  });
});

describe("the state at a time", () => {
  const t = plan(strokeSetOf([square]), motion, DEFAULT_PEN);

  it("is at rest at the start before it begins and at the end after it", () => {
    expect(stateAt(t, -1)).toMatchObject({ x: 0, y: 0, vx: 0, stroke: -1, penUp: true });
    expect(stateAt(t, t.totalS + 1)).toMatchObject({ x: 0, y: 0, vx: 0, ax: 0, stroke: -1, penUp: true });
  });

  it("does not move while the pen drops and lifts", () => {
    const [drop, lift] = penMovesOf(t);
    for (const move of [drop, lift]) {
      const s = stateAt(t, move.startS + move.waitS / 2);
      expect(s).toMatchObject({ vx: 0, vy: 0, ax: 0, ay: 0, stroke: -1, penUp: move.up });
      expect(Math.hypot(s.x - 10, s.y - 10)).toBeLessThan(1e-9);
    }
  });

  it("has stroke and distance along it while drawing", () => {
    const start = t.runs.startS[1];
    const end = t.penMoves.startS[1];
    const s = stateAt(t, (start + end) / 2);
    expect(s).toMatchObject({ stroke: 0, penUp: false });
    expect(s.alongMm).toBeCloseTo(20, 6);
    expect([s.x, s.y].map((v) => v.toFixed(6))).toEqual(["20.000000", "20.000000"]);
  });

  it("is refused for a time that is not a number", () => {
    expect(() => stateAt(t, Number.NaN)).toThrow(RangeError);
  });
});

describe("corner speed in junction mode", () => {
  it("on a circle sampled ever more finely converges to √(A r) instead of the speed limit", () => {
    for (const radius of [1, 2, 5, 10]) {
      for (const step of [0.2, 0.02, 0.002]) {
        const draw = { ...motion.draw, speedMmPerS: 500, accelMmPerS2: 200, cornerMm: 0.05 };
        const t = plan(strokeSetOf([circle(radius, step, 3)]), { ...motion, draw }, DEFAULT_PEN);
        const top = speedAt(t, 0.5);
        const centripetal = (top * top) / radius;
        expect(centripetal).toBeLessThanOrEqual(1.01 * 200);
        // The planner drops points that are closer than where the line bends by 4 µm.
        const plannedStep = Math.max(step, Math.sqrt(8 * radius * 0.004));
        expect(centripetal).toBeGreaterThan((1 - (plannedStep / radius) ** 2 / 4) * 200);
      }
    }
  });

  it("is kept between the points of a curve, but not between the corners of a zigzag", () => {
    // Both turn by 0.1 rad after each 0.5 mm.
    const draw = { ...motion.draw, speedMmPerS: 500, accelMmPerS2: 200, cornerMm: 0.05 };
    const zigzag = Array.from({ length: 180 }, (_, i): Point => [
      100 + 0.5 * i * Math.cos(0.05),
      100 + (i % 2) * 0.5 * Math.sin(0.1),
    ]);
    const accelAmongPoints = (points: Point[]): number => {
      const t = plan(strokeSetOf([points]), { ...motion, draw }, DEFAULT_PEN);
      const [first, end] = [t.runs.firstBlock[1], t.runs.firstBlock[2]];
      const middle = Array.from({ length: end - first }, (_, i) => first + i).slice(80, -80);
      expect(middle.length).toBeGreaterThan(15);
      return Math.max(...middle.map((k) => Math.hypot(t.ax[k], t.ay[k])));
    };
    for (const mirrored of [1, -1]) {
      const curve = circle(5, 0.5, 3).map(([x, y]): Point => [mirrored * (x - 100) + 100, y]);
      expect(accelAmongPoints(curve)).toBeLessThan(1e-6);
    }
    expect(accelAmongPoints(zigzag)).toBeGreaterThan(100);
  });

  it("at a right angle is junction deviation's √(2.414 A δ)", () => {
    const draw = { speedMmPerS: 500, accelMmPerS2: 1000, cornerMm: 0.05, jerkMmPerS3: 1e5 };
    const t = plan(
      strokeSetOf([
        [
          [0, 0],
          [50, 0],
          [50, 50],
        ],
      ]),
      { ...motion, draw },
      DEFAULT_PEN,
    );
    const corner = Array.from({ length: t.blockCount }, (_, k) => k).find(
      (k) => t.x[k] === 50 && t.y[k] === 0,
    )!;
    expect(Math.hypot(t.vx[corner], t.vy[corner])).toBeCloseTo(Math.sqrt((1 + Math.SQRT2) * 50), 9);
  });

  it("is zero at a reversal", () => {
    const t = plan(
      strokeSetOf([
        [
          [0, 0],
          [10, 0],
          [0, 0],
        ],
      ]),
      motion,
      DEFAULT_PEN,
      { returnHome: false },
    );
    const turn = Array.from({ length: t.blockCount }, (_, k) => k).find((k) => t.x[k] === 10)!;
    expect(Math.hypot(t.vx[turn], t.vy[turn])).toBe(0);
  });
});

describe("invalid input to the planner", () => {
  it("is refused with the setting's name and advice", () => {
    const cases: [MotionSettings, typeof DEFAULT_PEN, RegExp][] = [
      [{ ...motion, draw: { ...motion.draw, speedMmPerS: 0 } }, DEFAULT_PEN, /^Draw speed is 0/],
      [
        { ...motion, travel: { ...motion.travel, accelMmPerS2: Number.NaN } },
        DEFAULT_PEN,
        /^Travel acceleration/,
      ],
      [{ ...motion, draw: { ...motion.draw, cornerMm: -1 } }, DEFAULT_PEN, /corner/],
      [motion, { ...DEFAULT_PEN, upPct: 20, downPct: 40 }, /raise the up height or lower the down height/],
      [motion, { ...DEFAULT_PEN, extraLiftMs: -501 }, /extra wait after lifting/],
    ];
    for (const [m, pen, message] of cases) {
      expect(() => plan(strokeSetOf([square]), m, pen)).toThrow(message);
      expect(() => plan(strokeSetOf([square]), m, pen)).toThrow(PlotwrightError);
      expect(() => plan(strokeSetOf([square]), m, pen)).toThrow(/^[A-Z].*\.$/);
    }
  });

  it("is a caller's bug if a coordinate is not finite or the place is not in the drawing", () => {
    expect(() => plan(strokeSetOf([[[0, Number.NaN]]]), motion, DEFAULT_PEN)).toThrow(RangeError);
    expect(() =>
      plan(
        strokeSetOf([
          [
            [0, 0],
            [Infinity, 0],
          ],
        ]),
        motion,
        DEFAULT_PEN,
      ),
    ).toThrow(RangeError);
    expect(() =>
      plan(
        strokeSetOf([
          [
            [0, 0],
            [1e300, 0],
          ],
        ]),
        motion,
        DEFAULT_PEN,
      ),
    ).toThrow(RangeError);
    expect(() =>
      plan(strokeSetOf([square]), motion, DEFAULT_PEN, { from: { stroke: 7, alongMm: 0 } }),
    ).toThrow(RangeError);
  });
});

it("planning stops on request", () => {
  expect(() => plan(strokeSetOf([square]), motion, DEFAULT_PEN, { cancel: { aborted: true } })).toThrow(
    /cancelled/,
  );
});

function circle(radius: number, step: number, turns: number): Point[] {
  const count = Math.round((2 * Math.PI * radius) / step);
  return Array.from({ length: turns * count + 1 }, (_, i): Point => [
    100 + radius * Math.cos((2 * Math.PI * i) / count),
    100 + radius * Math.sin((2 * Math.PI * i) / count),
  ]);
}

function speedAt(t: ReturnType<typeof plan>, share: number): number {
  const start = t.runs.startS[1];
  const s = stateAt(t, start + share * (t.penMoves.startS[1] - start));
  return Math.hypot(s.vx, s.vy);
}
