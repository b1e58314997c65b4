import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { insideRange } from "../../../../src/internal.js";
import { PaperEdge } from "../../../../web/watch/hand-drawing/paper-edge.js";
import { cases } from "../../../support/runs/full-run.js";

type Line = (readonly [x: number, y: number])[];
const BOX = { x0: 0, y0: 0, x1: 100, y1: 50 };

const split = (points: Line): { strokes: Line[]; hasLeft: boolean } => {
  const strokes: Line[] = [];
  let isDown = false;
  const edge = new PaperEdge(BOX, {
    lineTo: (x, y) => {
      if (!isDown) strokes.push([]);
      isDown = true;
      strokes[strokes.length - 1].push([x, y]);
    },
    penUp: () => {
      isDown = false;
    },
  });
  for (const [x, y] of points) edge.lineTo(x, y);
  edge.penUp();
  return { strokes, hasLeft: edge.hasLeft };
};

const lengthOf = (line: Line): number =>
  line.slice(1).reduce((mm, [x, y], k) => mm + Math.hypot(x - line[k][0], y - line[k][1]), 0);

describe("a stroke at the edge of the paper", () => {
  it("is unchanged inside", () => {
    const points: Line = [
      [10, 10],
      [90, 10],
      [90, 40],
    ];
    expect(split(points)).toEqual({ strokes: [points], hasLeft: false });
  });

  it("ends at the edge, and another one begins where it comes back", () => {
    expect(
      split([
        [90, 10],
        [110, 10],
        [110, 30],
        [90, 30],
      ]),
    ).toEqual({
      strokes: [
        [
          [90, 10],
          [100, 10],
        ],
        [
          [100, 30],
          [90, 30],
        ],
      ],
      hasLeft: true,
    });
  });

  it("crosses the paper between two points that both lie outside", () => {
    expect(
      split([
        [-10, 25],
        [110, 25],
      ]).strokes,
    ).toEqual([
      [
        [0, 25],
        [100, 25],
      ],
    ]);
  });

  it("leaves no dot where it only touches a corner, or where it goes on outside from a point on the edge", () => {
    expect(
      split([
        [-10, 10],
        [10, -10],
      ]).strokes,
    ).toEqual([]);
    expect(
      split([
        [50, 20],
        [100, 20],
        [120, 20],
      ]).strokes,
    ).toEqual([
      [
        [50, 20],
        [100, 20],
      ],
    ]);
  });

  it("is a dot for a tap on the paper, and nothing for one beside it", () => {
    expect(split([[30, 30]])).toEqual({ strokes: [[[30, 30]]], hasLeft: false });
    expect(split([[130, 30]])).toEqual({ strokes: [], hasLeft: true });
  });

  it("keeps exactly what lies inside, for any way of the pointer", () => {
    const at = fc.tuple(
      fc.oneof(fc.double({ min: -60, max: 160, noNaN: true }), fc.constantFrom(0, 100)),
      fc.oneof(fc.double({ min: -60, max: 110, noNaN: true }), fc.constantFrom(0, 50)),
    );
    fc.assert(
      fc.property(fc.array(at, { minLength: 2, maxLength: 30 }), (points) => {
        const { strokes } = split(points);
        const insideMm = points.slice(1).reduce((mm, [x, y], k) => {
          const [fromX, fromY] = points[k];
          const [enters, leaves] = insideRange(fromX, fromY, x, y, BOX) ?? [0, 0];
          return mm + (leaves - enters) * Math.hypot(x - fromX, y - fromY);
        }, 0);
        for (const [x, y] of strokes.flat()) {
          expect(x).toBeGreaterThanOrEqual(0);
          expect(x).toBeLessThanOrEqual(100);
          expect(y).toBeGreaterThanOrEqual(0);
          expect(y).toBeLessThanOrEqual(50);
        }
        expect(strokes.reduce((mm, line) => mm + lengthOf(line), 0)).toBeCloseTo(insideMm, 6);
      }),
      { numRuns: cases() },
    );
  });
});
