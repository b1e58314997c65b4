/**
 * Whole plots, compiled for every generation of firmware and played on the virtual board: the result equals
 * the prediction, and the drawn line equals the drawing.
 */
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, machineById, plan, type Trajectory } from "../../../../../src/index.js";
import { motionForFirmware, type MotionMode } from "../../../../../src/internal.js";
import { SegmentGrid } from "../../../../support/drawings/segment-grid.js";
import { strokeSetOf, type Point } from "../../../../support/drawings/arbitraries.js";
import { FastBoard } from "../../../../support/plots/virtual-plots.js";
import { penMoveColumns } from "../../../../../src/plan/pen/pen-moves.js";

const MACHINE = machineById("axidraw-v3");
const FIRMWARE = ["2.4.4", "2.5.3", "2.6.5", "2.7.0", "2.8.1", "3.0.3"] as const;
const MODES: readonly MotionMode[] = ["junction", "blend", "scurve"];
/** The planner's tolerance for merging blocks, plus one microstep. */
const FIT_MM = 0.02;
const MICROSTEP_MM = 0.0125;

const circle = (x: number, y: number, r: number, n: number): Point[] =>
  Array.from({ length: n + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / n;
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  });

const spiral = Array.from({ length: 600 }, (_, i): Point => {
  const t = i / 20;
  return [120 + 0.6 * t * Math.cos(t), 80 + 0.6 * t * Math.sin(t)];
});

/** Jagged with steps of about `size`, by a fixed sequence of numbers. */
function jagged(x: number, y: number, size: number, count: number): Point[] {
  let seed = 7;
  const next = (): number => (seed = (seed * 16_807) % 2_147_483_647) / 2_147_483_647;
  const points: Point[] = [[x, y]];
  for (let i = 0; i < count; i++) {
    const [px, py] = points[i];
    points.push([px + (next() - 0.45) * size, py + (next() - 0.45) * size]);
  }
  return points;
}

const DRAWING = strokeSetOf([
  circle(50, 50, 20, 300),
  circle(60, 60, 1, 40),
  spiral,
  jagged(20, 100, 8, 60),
  jagged(80, 120, 0.8, 60),
  jagged(150, 120, 0.1, 60),
  [
    [10, 10],
    [60, 10],
  ],
  [
    [10, 20],
    [10.005, 20],
  ],
  [[150, 20]],
  [
    [10, 10],
    [60, 60],
    [10, 60],
    [10, 10],
  ],
  [
    [5, 5],
    [150, 40],
    [5, 5],
  ],
]);

const sourceGrid = new SegmentGrid(0.5);
for (let i = 0; i + 1 < DRAWING.offsets.length; i++) {
  sourceGrid.addPolyline(DRAWING.xy, 2 * DRAWING.offsets[i], 2 * DRAWING.offsets[i + 1]);
}

for (const mode of MODES) {
  const trajectory = plan(DRAWING, { ...DEFAULT_MOTION, mode }, DEFAULT_PEN);

  describe(`a plot in ${mode} mode`, () => {
    it.each(FIRMWARE)("ends where predicted, three times in a row, on firmware %s", (firmware) => {
      const fast = new FastBoard(firmware, MACHINE, DEFAULT_PEN);
      for (let plot = 0; plot < 3; plot++) {
        const stream = fast.compile(trajectory);
        const { boardS, firstWrong } = fast.play(stream);
        expect(firstWrong).toBeNull();
        expect(boardS).toBeCloseTo(stream.boardS[stream.count], 6);
        expect(Math.abs(boardS / trajectory.totalS - 1)).toBeLessThan(0.002);
        expect(fast.board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
      }
      expect(fast.errors).toEqual([]);
      expect(fast.board.statistics().underrunCount).toBe(0);
    });

    it.each(FIRMWARE)("draws the whole drawing and nothing else on firmware %s", (firmware) => {
      const fast = new FastBoard(firmware, MACHINE, DEFAULT_PEN);
      fast.play(fast.compile(trajectory));
      const lines = fast.board.drawn().filter((line) => line.penDown);
      const drawnGrid = new SegmentGrid(0.5);
      const allowed = DEFAULT_MOTION.draw.cornerMm + FIT_MM + MICROSTEP_MM;
      let farthest = 0;
      for (const { xy } of lines) {
        drawnGrid.addPolyline(xy);
        for (let i = 0; i < xy.length; i += 2) {
          farthest = Math.max(farthest, sourceGrid.distance(xy[i], xy[i + 1], farthest));
        }
      }
      expect(lines.length).toBe(DRAWING.offsets.length - 1);
      expect(farthest).toBeLessThan(allowed);
      let missed = 0;
      for (let i = 0; i < DRAWING.xy.length; i += 2) {
        missed = Math.max(missed, drawnGrid.distance(DRAWING.xy[i], DRAWING.xy[i + 1], missed));
      }
      expect(missed).toBeLessThan(allowed);
    });

    it.each(["2.5.3", "2.6.5", "2.7.0", "2.8.1", "3.0.3"])(
      "never lets a motor wait for the other within a command on firmware %s",
      (firmware) => {
        const fast = new FastBoard(firmware, MACHINE, DEFAULT_PEN);
        fast.play(fast.compile(trajectory));
        // One tick: the end of a step-limited move is rounded to one.
        expect(fast.board.statistics().longestMotorWaitS).toBeLessThanOrEqual(1.0001 / 25_000);
      },
    );

    if (mode === "junction") return;

    it.each([
      // Slices of constant speed: not guaranteed, but within reason.
      ["2.4.4", 10],
      ["2.5.3", 5],
      ["2.6.5", 5],
      ["2.7.0", 1],
      ["2.8.1", 1],
      ["3.0.3", 1],
    ] as const)("joins its commands on firmware %s within %f mm/s", (firmware, limit) => {
      const fast = new FastBoard(firmware, MACHINE, DEFAULT_PEN);
      const motion = motionForFirmware({ ...DEFAULT_MOTION, mode }, firmware);
      fast.play(fast.compile(plan(DRAWING, motion, DEFAULT_PEN)));
      expect(fast.board.statistics().largestJumpMmPerS).toBeLessThanOrEqual(limit);
    });
  });
}

/** A run from rest to rest in pieces of constant acceleration. Velocities at their joints, mm/s. */
function runOf(pieceS: number, joints: readonly Point[]): Trajectory {
  const count = joints.length + 1;
  const v: readonly Point[] = [[0, 0], ...joints, [0, 0]];
  const column = (of: (k: number) => number): Float64Array =>
    Float64Array.from({ length: count }, (_, k) => of(k));
  const ends = [0, 1].map((axis) => {
    const places = [0];
    for (let k = 0; k < count; k++) places.push(places[k] + (pieceS * (v[k][axis] + v[k + 1][axis])) / 2);
    return places;
  });
  return {
    ...{ blockCount: count, jx: null, jy: null, penMoves: penMoveColumns([]), totalS: count * pieceS },
    ...{ x: column((k) => ends[0][k]), y: column((k) => ends[1][k]) },
    ...{ vx: column((k) => v[k][0]), vy: column((k) => v[k][1]) },
    ax: column((k) => (v[k + 1][0] - v[k][0]) / pieceS),
    ay: column((k) => (v[k + 1][1] - v[k][1]) / pieceS),
    durationS: column(() => pieceS),
    startS: column((k) => k * pieceS),
    alongMm: column(() => 0),
    runs: {
      ...{ count: 1, firstBlock: Uint32Array.of(0, count) },
      ...{ stroke: Int32Array.of(0), startS: Float64Array.of(0) },
    },
    ...{ endX: ends[0][count], endY: ends[1][count] },
  };
}

describe("a motor that reverses where two pieces of the plan meet", () => {
  it.each(["2.5.3", "2.8.1", "3.0.3"])("stops at the reversal without a jump, on firmware %s", (firmware) => {
    // Motor speeds x + y and x − y: one reverses 3 ms before the second joint, the other exactly at it.
    const trajectory = runOf(0.078, [
      [-30.9, 23.1],
      [0.16, 0.15],
      [37.6, -9.5],
    ]);
    const fast = new FastBoard(firmware, MACHINE, DEFAULT_PEN);
    expect(fast.play(fast.compile(trajectory)).firstWrong).toBeNull();
    expect(fast.board.statistics().largestJumpMmPerS).toBeLessThan(0.5);
  });
});

describe("a plot that asks for more than the motors can step", () => {
  it("is slowed with a warning, and still ends where it should", () => {
    const fastMotion = {
      ...DEFAULT_MOTION,
      mode: "blend" as const,
      travel: { ...DEFAULT_MOTION.travel, speedMmPerS: 900, accelMmPerS2: 9_000 },
    };
    const diagonal = strokeSetOf([
      [
        [200, 200],
        [201, 200],
      ],
    ]);
    const trajectory = plan(diagonal, fastMotion, DEFAULT_PEN);
    for (const firmware of FIRMWARE) {
      const fast = new FastBoard(firmware, MACHINE, DEFAULT_PEN);
      const stream = fast.compile(trajectory);
      const { firstWrong } = fast.play(stream);
      expect(stream.warnings.filter((text) => text.includes("faster than the motors"))).toHaveLength(1);
      expect(firstWrong).toBeNull();
      expect(fast.errors).toEqual([]);
      expect(stream.boardS[stream.count]).toBeGreaterThan(trajectory.totalS);
      expect(fast.board.state()).toMatchObject({ steps1: 0, steps2: 0 });
    }
  });

  it("is delayed only once by a command that is too fast and is then cut where a motor reverses", () => {
    const draw = { ...DEFAULT_MOTION.draw, speedMmPerS: 400, accelMmPerS2: 8_000 };
    const bend: Point[] = [
      [52.7, 97],
      [60.3, 87.6],
      [77.1, 72.8],
    ];
    const trajectory = plan(strokeSetOf([bend]), { ...DEFAULT_MOTION, mode: "blend", draw }, DEFAULT_PEN);
    const stream = new FastBoard("2.6.5", MACHINE, DEFAULT_PEN).compile(trajectory);
    expect(stream.boardS[stream.count]).toBeCloseTo(2.255, 2);
  });
});

describe("a plot on other machines", () => {
  it.each(["eggbot", "watercolorbot", "nextdraw-8511"])("draws on %s", (id) => {
    const machine = machineById(id);
    const square: Point[] = [
      [2, 2],
      [12, 2],
      [12, 12],
      [2, 12],
      [2, 2],
    ];
    const trajectory = plan(strokeSetOf([square]), DEFAULT_MOTION, DEFAULT_PEN);
    const fast = new FastBoard("2.8.1", machine, DEFAULT_PEN);
    const { firstWrong } = fast.play(fast.compile(trajectory));
    expect(firstWrong).toBeNull();
    expect(fast.errors).toEqual([]);
    const [line] = fast.board.drawn().filter((drawn) => drawn.penDown);
    const grid = new SegmentGrid(0.5);
    grid.addPolyline(square.flat());
    for (let i = 0; i < line.xy.length; i += 2) {
      const allowed = DEFAULT_MOTION.draw.cornerMm + 1 / machine.stepsPerMm;
      expect(grid.distance(line.xy[i], line.xy[i + 1])).toBeLessThanOrEqual(allowed);
    }
  });
});
