import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, plan, stateAt, trajectoryStats, type MotionSettings } from "../../../src/index.js";
import {
  DEFAULT_FIT,
  MOTION_MODES,
  strokeCount,
  timesByLayer,
  type LayerTimes,
  type MotionMode,
} from "../../../src/internal.js";
import {
  arbitraryLimits,
  arbitraryGridStroke,
  arbitraryStroke,
  arbitraryStrokeSet,
  strokeSetOf,
  type Point,
} from "../../support/drawings/arbitraries.js";
import { worstOf } from "../../support/trajectories/trajectory-checks.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";
import { cases } from "../../support/runs/full-run.js";
import { MAX_MOVED_MM } from "../../../src/plan/resample.js";

const RUNS = { numRuns: cases() };
const motionIn = (mode: MotionMode): fc.Arbitrary<MotionSettings> =>
  fc.record({
    mode: fc.constant(mode),
    draw: arbitraryLimits,
    travel: arbitraryLimits,
    fit: fc.constant(null),
  });

describe.each(MOTION_MODES)("a plan of any drawing in mode %s", (mode) => {
  const arbitraryMotion = motionIn(mode);

  it("stays within its limits at every instant, rests between runs, and leaves no gap", () => {
    fc.assert(
      fc.property(arbitraryStrokeSet, arbitraryMotion, (strokes, motion) => {
        const trajectory = plan(strokes, motion, DEFAULT_PEN);
        const deviation = mode === "junction" ? 0 : motion.draw.cornerMm;
        const worst = worstOf(trajectory, strokes, motion.draw, motion.travel, deviation);
        // 1e-9 mm, or the double precision of coordinates of a kilometre.
        const size = Math.max(...Array.from(strokes.xy, Math.abs), 1);
        const far = size > 10_000;
        expect(worst.finite).toBe(true);
        expect(worst.speed).toBeLessThanOrEqual(1.001);
        expect(worst.accel).toBeLessThanOrEqual(1.001);
        expect(worst.restSpeed).toBeLessThan(far ? 1e-2 : 1e-6);
        if (!far || mode !== "scurve") expect(worst.gap).toBeLessThanOrEqual(Math.max(1e-9, size * 1e-14));
        expect(worst.clock).toBeLessThanOrEqual(1e-9 * Math.max(1, trajectory.totalS));
        expect(worst.distance).toBeLessThanOrEqual(deviation * 1.001 + MAX_MOVED_MM + (far ? 1e-3 : 0));
        if (mode !== "junction") expect(worst.velocityJump).toBeLessThan(far ? 1e-2 : 1e-6);
        if (mode === "scurve") {
          expect(worst.jerk).toBeLessThanOrEqual(1.001);
          expect(worst.accelJump).toBeLessThan(far ? 1 : 1e-3);
        }
      }),
      RUNS,
    );
  });

  it("has times by layer and by kind that add up to the whole", () => {
    fc.assert(
      fc.property(arbitraryStrokeSet, arbitraryMotion, fc.array(fc.nat(2)), (strokes, motion, jumps) => {
        const count = strokeCount(strokes);
        // Layers in order, some of them without strokes.
        const layer = new Uint16Array(count);
        for (let i = 1; i < count; i++) layer[i] = layer[i - 1] + (jumps[i] ?? 0);
        const trajectory = plan(strokes, motion, DEFAULT_PEN);
        const { layers, home } = timesByLayer(trajectory, layer);
        const sum = (value: (one: LayerTimes) => number): number =>
          layers.reduce((total, one) => total + value(one), 0);
        const { drawMm, durationS } = trajectoryStats(trajectory);
        const whole = sum(({ drawS, travelS, penS }) => drawS + travelS + penS) + home.travelS + home.penS;
        expect(whole).toBeCloseTo(durationS, 6);
        expect(sum((one) => one.drawMm)).toBeCloseTo(drawMm, 6);
        expect(layers.map((one) => one.layer)).toEqual([...new Set(layer)]);
        for (const { drawS, travelS, penS } of [...layers, home])
          expect(Math.min(drawS, travelS, penS)).toBeGreaterThan(-1e-9 * Math.max(1, durationS));
      }),
      RUNS,
    );
  });

  it("draws every stroke once, in order, and has the pen down only while it draws", () => {
    fc.assert(
      fc.property(arbitraryStrokeSet, arbitraryMotion, (strokes, motion) => {
        const planned = plan(strokes, motion, DEFAULT_PEN);
        const { runs } = planned;
        const penMoves = penMovesOf(planned);
        const drawn = Array.from(runs.stroke).filter((stroke) => stroke >= 0);
        expect(drawn).toEqual(Array.from({ length: strokes.offsets.length - 1 }, (_, i) => i));
        let up = true;
        let move = 0;
        for (let run = 0; run <= runs.count; run++) {
          for (; move < penMoves.length && penMoves[move].beforeRun === run; move++) up = penMoves[move].up;
          if (run < runs.count) expect(up).toBe(runs.stroke[run] < 0);
        }
        expect(up).toBe(true);
        expect(move).toBe(penMoves.length);
      }),
      RUNS,
    );
  });

  it("takes as long backwards as forwards", () => {
    fc.assert(
      fc.property(arbitraryGridStroke, arbitraryMotion, (stroke, motion) => {
        const forwards = drawTime(stroke, motion);
        const backwards = drawTime([...stroke].reverse(), motion);
        // Points that carry no shape are dropped from the start of the line on.
        expect(Math.abs(backwards - forwards)).toBeLessThanOrEqual(0.01 * forwards + 4e-3);
      }),
      RUNS,
    );
  });

  it("takes as long if space and all limits are scaled by the same factor", () => {
    // So coarse that all points carry shape.
    const coordinate = (max: number) => fc.integer({ min: 0, max }).map((value) => 10 * value);
    const clean = fc.array(fc.tuple(coordinate(300), coordinate(200)), { minLength: 2, maxLength: 12 });
    fc.assert(
      fc.property(
        clean,
        arbitraryMotion,
        fc.double({ min: 0.2, max: 100, noNaN: true }),
        (stroke, motion, k) => {
          const { speedMmPerS, accelMmPerS2, cornerMm, jerkMmPerS3 } = motion.draw;
          const draw = {
            speedMmPerS: k * speedMmPerS,
            accelMmPerS2: k * accelMmPerS2,
            cornerMm: k * cornerMm,
            jerkMmPerS3: k * jerkMmPerS3,
          };
          const scaled = stroke.map(([x, y]): Point => [k * x, k * y]);
          const time = drawTime(stroke, motion);
          expect(Math.abs(drawTime(scaled, { ...motion, draw }) - time)).toBeLessThanOrEqual(
            1e-4 * (1 + time),
          );
        },
      ),
      RUNS,
    );
  });

  it("gives at any instant the state computed from its blocks", () => {
    fc.assert(
      fc.property(
        arbitraryStrokeSet,
        arbitraryMotion,
        fc.double({ min: 0, max: 1, noNaN: true }),
        (strokes, motion, share) => {
          const trajectory = plan(strokes, motion, DEFAULT_PEN);
          const t = share * trajectory.totalS;
          const now = stateAt(trajectory, t);
          const soon = stateAt(trajectory, t + 1e-6);
          const reach = Math.max(motion.draw.speedMmPerS, motion.travel.speedMmPerS) * 1e-6;
          expect(Math.hypot(soon.x - now.x, soon.y - now.y)).toBeLessThanOrEqual(
            1.01 * reach + 1e-9 * (1 + Math.abs(now.x) + Math.abs(now.y)),
          );
          if (now.stroke >= 0) expect(now.penUp).toBe(false);
        },
      ),
      RUNS,
    );
  });
});

describe.each(MOTION_MODES)("a merged plan of any drawing in mode %s", (mode) => {
  it("stays within the same limits, has the same end, and leaves the line by at most ε more", () => {
    fc.assert(
      fc.property(arbitraryStrokeSet, motionIn(mode), (strokes, motion) => {
        const size = Math.max(...Array.from(strokes.xy, Math.abs), 1);
        fc.pre(size < 10_000);
        const trajectory = plan(strokes, { ...motion, fit: DEFAULT_FIT }, DEFAULT_PEN);
        const allowed = motion.draw.cornerMm + DEFAULT_FIT.toleranceMm;
        const worst = worstOf(trajectory, strokes, motion.draw, motion.travel, allowed);
        expect(worst.finite).toBe(true);
        expect(worst.speed).toBeLessThanOrEqual(1.001);
        expect(worst.accel).toBeLessThanOrEqual(1.001);
        expect(worst.restSpeed).toBeLessThan(1e-6);
        expect(worst.gap).toBeLessThanOrEqual(1e-9);
        expect(worst.distance).toBeLessThanOrEqual(allowed + MAX_MOVED_MM);
        if (mode !== "junction") expect(worst.velocityJump).toBeLessThan(1e-6);
        if (mode === "scurve") {
          expect(worst.jerk).toBeLessThanOrEqual(1.001);
          expect(worst.accelJump).toBeLessThan(1e-2);
        }
      }),
      RUNS,
    );
  });
});

describe("an scurve plan", () => {
  it("leaves no gap where a line bends so little that speeds differ only by rounding", () => {
    const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });
    const steps = fc.array(fc.tuple(real(0.005, 3), real(-9, -4)), { minLength: 2, maxLength: 40 });
    fc.assert(
      fc.property(steps, real(0, 6.3), arbitraryLimits, (bends, start, draw) => {
        const points: Point[] = [[0, 0]];
        let heading = start;
        for (const [length, exponent] of bends) {
          const [x, y] = points[points.length - 1];
          points.push([x + length * Math.cos(heading), y + length * Math.sin(heading)]);
          heading += 10 ** exponent;
        }
        const strokes = strokeSetOf([points]);
        const trajectory = plan(strokes, { mode: "scurve", draw, travel: draw, fit: null }, DEFAULT_PEN);
        expect(worstOf(trajectory, strokes, draw, draw, 1).gap).toBeLessThanOrEqual(1e-9);
      }),
      RUNS,
    );
  });
});

describe("a junction plan", () => {
  const arbitraryMotion = motionIn("junction");

  it("continues from any place of the drawing and draws exactly the rest", () => {
    fc.assert(
      fc.property(
        arbitraryStroke,
        arbitraryMotion,
        fc.double({ min: 0, max: 1, noNaN: true }),
        (stroke, motion, share) => {
          const strokes = strokeSetOf([
            stroke,
            [
              [1, 1],
              [9, 9],
            ],
          ]);
          const whole = polylineLength(stroke);
          const left = plan(strokes, motion, DEFAULT_PEN, { from: { stroke: 0, alongMm: share * whole } });
          const drawn = trajectoryStats(left).drawMm;
          expect(Math.abs(drawn - Math.hypot(8, 8) - (1 - share) * whole)).toBeLessThanOrEqual(
            stroke.length * MAX_MOVED_MM + 1e-9 * whole,
          );
        },
      ),
      RUNS,
    );
  });
});

const polylineLength = (points: readonly Point[]): number =>
  points.slice(1).reduce((sum, [x, y], i) => sum + Math.hypot(x - points[i][0], y - points[i][1]), 0);

function drawTime(stroke: readonly Point[], motion: MotionSettings): number {
  const [x, y] = stroke[0];
  return plan(strokeSetOf([stroke]), motion, DEFAULT_PEN, { startX: x, startY: y, returnHome: false }).totalS;
}
