import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  plan,
  trajectoryStats,
  type MotionSettings,
  type PenSettings,
  type Trajectory,
} from "../../../src/index.js";
import { DEFAULT_FIT, MOTION_MODES, type MotionMode } from "../../../src/internal.js";
import { blockLength } from "../../../src/plan/trajectory.js";
import { AXIDRAW_LIKE } from "../../support/machines/machine.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { worstOf } from "../../support/trajectories/trajectory-checks.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";

const square: Point[] = [
  [10, 10],
  [30, 10],
  [30, 30],
  [10, 30],
  [10, 10],
];

describe.each(MOTION_MODES)("on a finely sampled circle, mode %s", (mode) => {
  it("never takes the curve faster than √(1.01 A r), whatever the sampling", () => {
    const draw = { speedMmPerS: 500, accelMmPerS2: 200, cornerMm: 0.05, jerkMmPerS3: 10_000 };
    for (const radius of [1, 2, 5, 10]) {
      for (const step of [0.02, 0.05, 0.2]) {
        for (const fit of [null, DEFAULT_FIT]) {
          const strokes = strokeSetOf([circle(radius, step, 2)]);
          const t = plan(strokes, { mode, draw, travel: draw, fit }, DEFAULT_PEN);
          // A merged piece's own curvature differs a little from the circle's: then |a| itself decides.
          if (fit === null) expect(topSpeed(t, 1) ** 2 / radius).toBeLessThanOrEqual(1.01 * 200);
          const worst = worstOf(t, strokes, draw, draw, 0.05);
          expect(worst.accel).toBeLessThanOrEqual(1.001);
        }
      }
    }
  });
});

describe("fitting", () => {
  const draw = { speedMmPerS: 50, accelMmPerS2: 500, cornerMm: 0.05, jerkMmPerS3: 10_000 };
  const strokes = strokeSetOf([circle(20, 0.05, 2)]);

  it("draws a circle of 20 mm radius at 50 mm/s in pieces of 40 ms and more (25 ms where they are filtered), within ε", () => {
    for (const mode of MOTION_MODES) {
      const t = plan(strokes, { mode, draw, travel: draw, fit: DEFAULT_FIT }, DEFAULT_PEN);
      const [first, end] = [t.runs.firstBlock[1], t.runs.firstBlock[2]];
      const drawS = t.penMoves.startS[1] - t.runs.startS[1];
      expect(drawS / (end - first)).toBeGreaterThan(mode === "scurve" ? 0.025 : 0.04);
      expect(worstOf(t, strokes, draw, draw, 0).distance).toBeLessThan(
        0.02 + sagitta(20, 0.05) + draw.cornerMm,
      );
      expect(farthestFromCircle(t, first, end, 20)).toBeLessThan(DEFAULT_FIT.toleranceMm + draw.cornerMm);
    }
  });

  it("keeps velocity continuous in blend mode, and acceleration in scurve mode", () => {
    const merged = (mode: MotionMode) =>
      worstOf(
        plan(strokes, { mode, draw, travel: draw, fit: DEFAULT_FIT }, DEFAULT_PEN),
        strokes,
        draw,
        draw,
        1,
      );
    expect(merged("blend").velocityJump).toBeLessThan(1e-9);
    expect(merged("blend").gap).toBeLessThan(1e-9);
    expect(merged("scurve").accelJump).toBeLessThan(1e-6);
    expect(merged("scurve").jerk).toBeLessThanOrEqual(1.001);
  });

  it("leaves a polygon's blocks as they are", () => {
    const motion: MotionSettings = { mode: "blend", draw, travel: draw, fit: null };
    const plain = plan(strokeSetOf([square]), motion, DEFAULT_PEN);
    const merged = plan(strokeSetOf([square]), { ...motion, fit: DEFAULT_FIT }, DEFAULT_PEN);
    expect(merged.blockCount).toBe(plain.blockCount);
    expect(merged.totalS).toBeCloseTo(plain.totalS, 9);
  });
});

describe("corners", () => {
  const draw = { speedMmPerS: 500, accelMmPerS2: 1000, cornerMm: 0.05, jerkMmPerS3: 1e12 };
  const corner: Point[] = [
    [0, 0],
    [50, 0],
    [50, 50],
  ];

  it("in blend mode are one block: a right angle is passed at v² = 4 A δ, δ inside the corner", () => {
    const t = plan(strokeSetOf([corner]), { mode: "blend", draw, travel: draw, fit: null }, DEFAULT_PEN);
    const k = Array.from({ length: t.blockCount }, (_, i) => i).find((i) => t.ax[i] < -1 && t.ay[i] > 1)!;
    expect(Math.hypot(t.vx[k], t.vy[k]) ** 2).toBeCloseTo(4 * 1000 * 0.05, 6);
    expect(Math.hypot(t.ax[k], t.ay[k])).toBeCloseTo(1000, 6);
    const half = t.durationS[k] / 2;
    const x = t.x[k] + t.vx[k] * half + (t.ax[k] * half * half) / 2;
    const y = t.y[k] + t.vy[k] * half + (t.ay[k] * half * half) / 2;
    expect(x - 50).toBeCloseTo(-0.05 / Math.SQRT2, 9);
    expect(y).toBeCloseTo(0.05 / Math.SQRT2, 9);
  });

  it("of triangles, stars and squares take less time in blend mode than in junction mode, at a speed of √(2 A δ)/s", () => {
    // At higher speed, turning takes longer under A than a jump of velocity: see docs/comparison.md.
    for (const [corners, times] of [
      [3, 1],
      [5, 2],
      [4, 1],
    ] as const) {
      const speedMmPerS = Math.sqrt(2 * 500 * 0.05) / Math.sin((Math.PI * times) / corners);
      const slow = { speedMmPerS, accelMmPerS2: 500, cornerMm: 0.05, jerkMmPerS3: 10_000 };
      for (const radius of [0.5, 2, 10]) {
        const points = Array.from({ length: corners + 1 }, (_, i): Point => {
          const angle = (2 * Math.PI * times * i) / corners;
          return [50 + radius * Math.cos(angle), 50 + radius * Math.sin(angle)];
        });
        const drawS = (mode: MotionMode) =>
          plan(strokeSetOf([points]), { mode, draw: slow, travel: slow, fit: null }, DEFAULT_PEN, {
            startX: points[0][0],
            startY: points[0][1],
            returnHome: false,
          }).totalS;
        expect(drawS("junction") - drawS("blend")).toBeGreaterThan(0.0005);
      }
    }
  });

  it("in scurve mode with hardly any limit on jerk take as long as in blend mode", () => {
    const time = (mode: MotionMode) =>
      plan(strokeSetOf([corner]), { mode, draw, travel: draw, fit: null }, DEFAULT_PEN).totalS;
    expect(time("scurve") / time("blend")).toBeCloseTo(1, 3);
  });
});

describe.each(["blend", "scurve"] as const)("a stroke of nine thousand points, mode %s", (mode) => {
  it("has no gap, and no jump of its place along the drawing, from beginning to end", () => {
    const points = Array.from({ length: 9_000 }, (_, i): Point => {
      const u = i / 50;
      return [30 + u, 20 + (i % 7 === 0 ? 0.3 : 0) + 3 * Math.sin(u)];
    });
    const strokes = strokeSetOf([points]);
    const t = plan(strokes, { ...DEFAULT_MOTION, mode, fit: null }, DEFAULT_PEN);
    const worst = worstOf(t, strokes, DEFAULT_MOTION.draw, DEFAULT_MOTION.travel, 0.025);
    expect(worst.finite).toBe(true);
    expect(worst.gap).toBeLessThan(1e-9);
    expect(worst.velocityJump).toBeLessThan(1e-6);
    expect(worst.distance).toBeLessThan(0.0251);
    expect(worst.clock).toBeLessThan(1e-9);
    const [first, end] = [t.runs.firstBlock[1], t.runs.firstBlock[2]];
    // A block covers about as much of the drawing as its length.
    let max = 0;
    for (let k = first; k + 1 < end; k++) {
      const stands = t.alongMm[k + 1] - t.alongMm[k];
      max = Math.max(max, Math.abs(stands - blockLength(t, k, t.durationS[k])));
    }
    expect(max).toBeLessThan(0.1);
  });
});

describe("settings beyond speed and acceleration", () => {
  const base: MotionSettings = { ...DEFAULT_MOTION, fit: null };

  it("draw the first and last millimetres slowly on request, in every mode", () => {
    for (const mode of MOTION_MODES) {
      const motion = { ...base, mode, ease: { lengthMm: 5, speedMmPerS: 10 } };
      const t = plan(strokeSetOf([[[0, 0], [40, 0]]]), motion, DEFAULT_PEN); // prettier-ignore
      for (let k = t.runs.firstBlock[0]; k < t.runs.firstBlock[1]; k++) {
        if (t.x[k] < 4.9 || t.x[k] > 35.1) expect(Math.abs(t.vx[k])).toBeLessThanOrEqual(10.0001);
      }
      expect(topSpeed(t, 0)).toBeGreaterThan(40);
    }
  });

  it("give a layer its own limits and its own pen", () => {
    const strokes = strokeSetOf([square, square.map(([x, y]): Point => [x + 40, y])], [0, 1]);
    const motion = { ...base, layers: { l1: { speedMmPerS: 5 } } };
    const pen: PenSettings = {
      ...DEFAULT_PEN,
      overlap: "off",
      layers: { l1: { downPct: 10, extraDropMs: 700 } },
    };
    const t = plan(strokes, motion, pen);
    expect(topSpeed(t, 1)).toBeGreaterThan(20);
    expect(topSpeed(t, 3)).toBeCloseTo(5, 6);
    expect(penMovesOf(t).map((m) => [m.heightPct, m.waitS])).toEqual([
      [30, 0.154],
      [60, 0.141],
      // The servo's time for 50 %, and the layer's own 700 ms.
      [10, 0.937],
      [60, 0.208],
    ]);
  });

  it("time the pen by its rate and delay", () => {
    const pen: PenSettings = {
      ...DEFAULT_PEN,
      extraLiftMs: 20,
      extraDropMs: 50,
      liftPctPerS: 60,
      dropPctPerS: 30,
    };
    const t = plan(strokeSetOf([square]), base, pen);
    // The servo could lift it in 137 ms, so the rate takes nearly all of the time.
    expect(t.penMoves.waitS[0]).toBeCloseTo(0.05 + 1.001, 9);
    expect(t.penMoves.waitS[1]).toBeCloseTo(0.02 + 0.501, 9);
  });

  it("keep every motor below the board's step rate, diagonals too", () => {
    const travel = { ...base.travel, speedMmPerS: 1000, accelMmPerS2: 20_000 };
    for (const mode of MOTION_MODES) {
      const t = plan(strokeSetOf([[[150, 150], [150, 0], [0, 150]]]), { ...base, mode, draw: travel, travel }, DEFAULT_PEN, { machine: AXIDRAW_LIKE }); // prettier-ignore
      expect(topMotorSpeed(t) * AXIDRAW_LIKE.stepsPerMm).toBeLessThan(25_000);
      expect(trajectoryStats(t).maxSpeed).toBeGreaterThan(220);
    }
  });

  it("that contradict each other are refused with a clear message", () => {
    const wrong: [Partial<MotionSettings>, Partial<PenSettings>, RegExp][] = [
      [{ fit: { toleranceMm: 0, floorMs: 15 } }, {}, /^Fit tolerance is 0/],
      [{ ease: { lengthMm: 5, speedMmPerS: 0 } }, {}, /^Slow-in speed/],
      [{ layers: { red: { accelMmPerS2: -1 } } }, {}, /^Layer "red" draw acceleration/],
      [{ motorAccelStepsPerS2: Number.NaN }, {}, /^The motor acceleration/],
      [{}, { dropPctPerS: 0 }, /^Pen lowering speed is 0/],
      [
        { layers: { red: { speedFactor: 3 } } },
        {},
        /^Layer "red" draw share of the speed is 3: it must be 0.01 to 1/,
      ],
      [{}, { contactPct: 120 }, /^Pen tip touches at is 120/],
      [{}, { overlap: "often" as never }, /^Pen overlap is "often": choose one of off, safe, fast/],
      [{}, { layers: { red: { downPct: 70 } } }, /^Layer "red" pen up height/],
    ];
    for (const [motion, pen, message] of wrong) {
      const run = () => plan(strokeSetOf([square]), { ...base, ...motion }, { ...DEFAULT_PEN, ...pen });
      expect(run).toThrow(message);
      expect(run).toThrow(/\.$/);
    }
  });
});

function circle(radius: number, step: number, turns: number): Point[] {
  const count = Math.round((2 * Math.PI * radius) / step);
  return Array.from({ length: turns * count + 1 }, (_, i): Point => [
    100 + radius * Math.cos((2 * Math.PI * i) / count),
    100 + radius * Math.sin((2 * Math.PI * i) / count),
  ]);
}

const sagitta = (radius: number, chord: number): number => (chord * chord) / (8 * radius);

function eachSample(
  t: Trajectory,
  first: number,
  end: number,
  see: (x: number, y: number, vx: number, vy: number) => void,
) {
  for (let k = first; k < end; k++) {
    for (let i = 0; i <= 8; i++) {
      const u = (t.durationS[k] * i) / 8;
      const [jx, jy] = [t.jx ? t.jx[k] : 0, t.jy ? t.jy[k] : 0];
      see(
        t.x[k] + u * (t.vx[k] + (u * t.ax[k]) / 2 + (u * u * jx) / 6),
        t.y[k] + u * (t.vy[k] + (u * t.ay[k]) / 2 + (u * u * jy) / 6),
        t.vx[k] + u * (t.ax[k] + (u * jx) / 2),
        t.vy[k] + u * (t.ay[k] + (u * jy) / 2),
      );
    }
  }
}

function topSpeed(t: Trajectory, run: number): number {
  let top = 0;
  const [first, end] = [t.runs.firstBlock[run], t.runs.firstBlock[run + 1]];
  eachSample(t, first, end, (_x, _y, vx, vy) => (top = Math.max(top, Math.hypot(vx, vy))));
  return top;
}

function topMotorSpeed(t: Trajectory): number {
  let top = 0;
  eachSample(t, 0, t.blockCount, (_x, _y, vx, vy) => (top = Math.max(top, Math.abs(vx) + Math.abs(vy))));
  return top;
}

function farthestFromCircle(t: Trajectory, first: number, end: number, radius: number): number {
  let far = 0;
  eachSample(t, first, end, (x, y) => (far = Math.max(far, Math.abs(Math.hypot(x - 100, y - 100) - radius))));
  return far;
}
