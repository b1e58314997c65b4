/** Which runs of a polyline become arcs, the lines that say so, and how Grbl cuts them. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, planJob, type MachineProfile } from "../../../../../src/index.js";
import { grblCommandsOf } from "../../../../../src/drivers/grbl/grbl-job.js";
import { cutArc, sweepOf } from "../../../../../src/drivers/grbl/model/arc-cut.js";
import { arcsOf, type FoundArc } from "../../../../../src/drivers/grbl/model/arcs.js";
import { circle, roundedRectangle } from "../../../../support/drawings/round-drawing.js";
import { farthest, SegmentGrid } from "../../../../support/drawings/segment-grid.js";
import { GRBL, withoutArcs } from "../../../../support/machines/machine.js";
import { strokesOf } from "../../../../support/plots/local-planner.js";
import { cases } from "../../../../support/runs/full-run.js";

type Point = readonly [x: number, y: number];

/** The lines of a stroke, without those of the pen and of travels. */
function linesOf(points: readonly Point[], machine: MachineProfile = GRBL, speedMmPerS = 60): string[] {
  const motion = { ...DEFAULT_MOTION, draw: { ...DEFAULT_MOTION.draw, speedMmPerS } };
  const job = planJob({ strokes: strokesOf(points.flat()) }, { motion, pen: DEFAULT_PEN }, machine);
  const { lines } = grblCommandsOf(job.commands());
  const down = lines.indexOf("G1Z0F3000");
  const up = lines.indexOf("G1Z5F3000", down);
  return lines.slice(down + 1, up).filter((line) => !line.startsWith("G4"));
}

describe("the lines of", () => {
  const QUARTER = circle(0, 0, 10, 0, 0.25, 18);

  it("a quarter circle is one arc to the left", () => {
    expect(linesOf(QUARTER)).toEqual(["G3X0Y10I-10J0F3600"]);
  });

  it("a quarter circle the other way is one arc to the right", () => {
    expect(linesOf([...QUARTER].reverse())).toEqual(["G2X10Y0I0J-10F3600"]);
  });

  it("a quarter circle turns the other way on a machine with one axis reversed or both exchanged", () => {
    expect(linesOf(QUARTER, { ...GRBL, flipX: true })).toEqual(["G2X0Y10I10J0F3600"]);
    expect(linesOf(QUARTER, { ...GRBL, swapAxes: true })).toEqual(["G2X10Y0I0J-10F3600"]);
    expect(linesOf(QUARTER, { ...GRBL, flipX: true, flipY: true })).toEqual(["G3X0Y-10I10J0F3600"]);
  });

  it("a machine that takes no arcs are straight", () => {
    const lines = linesOf(QUARTER, withoutArcs(GRBL));
    expect(lines).toHaveLength(18);
    expect(lines.every((line) => line.startsWith("G1"))).toBe(true);
  });

  it("a rectangle with round corners are its sides and an arc at each corner", () => {
    const lines = linesOf(roundedRectangle(20, 20, 40, 30, 4));
    const near = (mm: number): unknown => expect.closeTo(mm, 0);
    // Where a side and a corner meet smoothly, the resampler has moved the point along the line by a few hundredths.
    const wordsOf = (line: string): unknown[] => [
      line.slice(0, 2),
      ...[...line.replace(/F.*/, "").matchAll(/[XYIJ](-?[\d.]+)/g)].map(([, value]) => Number(value)),
    ];
    expect(lines.map(wordsOf)).toEqual([
      ["G3", near(24), near(20), near(4), near(0)],
      ["G1", near(56), near(20)],
      ["G3", near(60), near(24), near(0), near(4)],
      ["G1", near(60), near(46)],
      ["G3", near(56), near(50), near(-4), near(0)],
      ["G1", near(24), near(50)],
      ["G3", near(20), near(46), near(0), near(-4)],
      ["G1", 20, 24],
    ]);
  });

  it("shapes without round parts have no arcs", () => {
    const square: Point[] = [
      [20, 20],
      [30, 20],
      [30, 30],
      [20, 30],
      [20, 20],
    ];
    const zigzag = Array.from({ length: 30 }, (_, i): Point => [20 + i / 3, 20 + (i % 2)]);
    const straight = Array.from({ length: 30 }, (_, i): Point => [20 + i, 20 + i / 7]);
    const octagon = circle(40, 40, 5, 0, 1, 8);
    const huge = circle(20, 3_020, 3_000, 0.75, 0.003, 30);
    const tiny = circle(20, 20, 0.2, 0, 1, 16);
    for (const shape of [square, zigzag, straight, octagon, huge, tiny]) {
      expect(linesOf(shape).filter((line) => !line.startsWith("G1"))).toEqual([]);
    }
  });

  it("a circle that touches the edge of the machine do not lead beyond it", () => {
    const touching = circle(30, 30, 30, 0, 1, 150);
    expect(linesOf(touching).some((line) => line.startsWith("G3"))).toBe(true);
    const motion = { ...DEFAULT_MOTION };
    const { trajectory } = planJob(
      { strokes: strokesOf(touching.flat()) },
      { motion, pen: DEFAULT_PEN },
      GRBL,
    );
    expect(Math.min(...trajectory.x, ...trajectory.y)).toBe(0);
  });

  it("a circle are several arcs, each far from a full one", () => {
    const lines = linesOf(circle(40, 40, 10, 0, 1, 72));
    expect(lines.length).toBeGreaterThanOrEqual(3);
    expect(lines.every((line) => line.startsWith("G3"))).toBe(true);
    expect(lines.at(-1)).toMatch(/^G3X50Y40I/);
  });
});

describe("Grbl cuts", () => {
  it.each([
    [1, 49],
    [5, 111],
    [10, 157],
    [50, 351],
    [100, 496],
  ])("a circle of radius %f into %i moves", (r, count) => {
    const ends = cutArc({ i: -r, j: 0, clockwise: false }, [r, 0, 0], [r, 0, 0], 0.002);
    expect(ends).toHaveLength(count);
    expect(ends[count - 1]).toEqual([r, 0, 0]);
    for (const [x, y] of ends) expect(Math.hypot(x, y)).toBeCloseTo(r, 9);
  });

  it("an arc with a tolerance of 0 into one move, and one of a larger tolerance into fewer", () => {
    const quarter = (tolerance: number) =>
      cutArc({ i: -10, j: 0, clockwise: false }, [10, 0, 0], [0, 10, 0], tolerance);
    expect(quarter(0)).toEqual([[0, 10, 0]]);
    expect(quarter(0.002)).toHaveLength(39);
    expect(quarter(0.1)).toHaveLength(5);
  });

  it("an arc so that Z moves evenly", () => {
    const ends = cutArc({ i: -10, j: 0, clockwise: true }, [10, 0, 0], [0, 10, 3], 0.1);
    expect(ends.map(([, , z]) => z)).toEqual(
      ends.map((_, k) => expect.closeTo((3 * (k + 1)) / ends.length, 9)),
    );
    expect(ends[0][1]).toBeLessThan(0);
  });
});

/** Straight and round pieces, some with corners between them. */
const arbitraryLine = fc
  .array(
    fc.record({
      length: fc.double({ min: 0.2, max: 25, noNaN: true }),
      /** 1/mm; 0: straight. */
      bend: fc.oneof(fc.constant(0), fc.double({ min: -1.5, max: 1.5, noNaN: true })),
      corner: fc.oneof(fc.constant(0), fc.double({ min: -2.5, max: 2.5, noNaN: true })),
      stepMm: fc.double({ min: 0.05, max: 0.8, noNaN: true }),
    }),
    { minLength: 1, maxLength: 6 },
  )
  .map((pieces) => {
    let [x, y, heading] = [100, 100, 0];
    const points: Point[] = [[x, y]];
    for (const { length, bend, corner, stepMm } of pieces) {
      heading += corner;
      const count = Math.ceil(length / stepMm);
      for (let i = 0; i < count; i++) {
        heading += (bend * length) / count / 2;
        x += (length / count) * Math.cos(heading);
        y += (length / count) * Math.sin(heading);
        heading += (bend * length) / count / 2;
        points.push([x, y]);
      }
    }
    return points;
  });

/** As `GrblRuns` has them. */
function pathOf(points: readonly Point[], stepsPerMm: number) {
  const x = Float64Array.from(points, (point) => point[0]);
  const y = Float64Array.from(points, (point) => point[1]);
  const onSteps = (mm: number): number => Math.round(mm * stepsPerMm) / stepsPerMm;
  const segmentCount = points.length - 1;
  const cap2 = new Float64Array(segmentCount).fill(50 ** 2);
  return { segmentCount, cap2, x, y, stepX: x.map(onSteps), stepY: y.map(onSteps) };
}

describe("the arcs of any line", () => {
  const STEPS = [80, 100, 250];
  const EPSILON_MM = 0.021;

  function forAnyLine(check: (points: readonly Point[], arc: FoundArc, stepsPerMm: number) => void): void {
    let count = 0;
    fc.assert(
      fc.property(arbitraryLine, fc.constantFrom(...STEPS), (points, stepsPerMm) => {
        const arcs = arcsOf(pathOf(points, stepsPerMm), Math.SQRT1_2 / stepsPerMm);
        for (const arc of arcs) check(points, arc, stepsPerMm);
        arcs.forEach((arc, i) => expect(arc.first).toBeGreaterThanOrEqual(arcs[i - 1]?.last ?? 0));
        count += arcs.length;
      }),
      { numRuns: cases(2_000, 300) },
    );
    expect(count).toBeGreaterThan(100);
  }

  it("stay near it, and it near them", () => {
    forAnyLine((points, arc, stepsPerMm) => {
      const { stepX, stepY } = pathOf(points, stepsPerMm);
      const [from, to] = [arc.first, arc.last].map((k) => [stepX[k], stepY[k], 0] as const);
      const fine = [from, ...cutArc(arc, from, to, 1e-5)].map(([x, y]): Point => [x, y]);
      const own = points.slice(arc.first, arc.last + 1);
      const most = EPSILON_MM + Math.SQRT1_2 / stepsPerMm;
      expect(farthest(fine, gridOf(own))).toBeLessThan(most);
      expect(farthest(between(own), gridOf(fine))).toBeLessThan(most);
    });
  });

  it("have equal radii at both ends as they are written, and turn by less than half a circle", () => {
    forAnyLine((points, arc, stepsPerMm) => {
      const { stepX, stepY } = pathOf(points, stepsPerMm);
      const written = (mm: number): number => Number(mm.toFixed(3));
      const [from, to] = [arc.first, arc.last].map((k) => [written(stepX[k]), written(stepY[k]), 0] as const);
      const [i, j] = [written(arc.i), written(arc.j)];
      const radius = Math.hypot(i, j);
      expect(Math.abs(Math.hypot(to[0] - from[0] - i, to[1] - from[1] - j) - radius)).toBeLessThan(0.005);
      expect(radius).toBeGreaterThan(0.2);
      expect(Math.abs(sweepOf({ i, j, clockwise: arc.clockwise }, from, to))).toBeLessThan(2.5);
    });
  });

  it("turn at no corner", () => {
    forAnyLine((points, { first, last, i, j }) => {
      const radius = Math.hypot(i, j);
      for (let k = first + 1; k < last; k++) {
        const [a, b, c] = points.slice(k - 1, k + 2);
        const before = Math.atan2(b[1] - a[1], b[0] - a[0]);
        const turn = Math.atan2(c[1] - b[1], c[0] - b[0]) - before;
        const size = Math.abs(Math.atan2(Math.sin(turn), Math.cos(turn)));
        const along = Math.hypot(b[0] - a[0], b[1] - a[1]) + Math.hypot(c[0] - b[0], c[1] - b[1]);
        expect(size).toBeLessThan((1.3 * along) / radius + 0.15);
      }
    });
  });
});

function gridOf(points: readonly Point[]): SegmentGrid {
  const grid = new SegmentGrid(1);
  grid.addPolyline(points.flat());
  return grid;
}

/** Points on the line, ends of its pieces and some between. */
function* between(points: readonly Point[]): Iterable<Point> {
  for (let k = 0; k + 1 < points.length; k++) {
    const [[x0, y0], [x1, y1]] = [points[k], points[k + 1]];
    for (let n = 0; n <= 4; n++) yield [x0 + ((x1 - x0) * n) / 4, y0 + ((y1 - y0) * n) / 4];
  }
}
