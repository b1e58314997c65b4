import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { paperBoxOf } from "../../../web/preview/frame.js";
import {
  boxAround,
  CORNER_PARTS,
  cornerOf,
  draggedFrame,
  framePartAt,
  knobOf,
  middleOf,
  snapFrame,
  snapLinesOf,
  wholeTurn,
  type CornerPart,
  type FrameMm,
} from "../../../web/scene/placing.js";
import { cases } from "../../support/runs/full-run.js";

const frame: FrameMm = { xMm: 20, yMm: 30, widthMm: 120, heightMm: 80, turnDeg: 0 };
const frames = fc.record({
  xMm: fc.double({ min: -100, max: 300, noNaN: true }),
  yMm: fc.double({ min: -100, max: 300, noNaN: true }),
  widthMm: fc.double({ min: 1, max: 400, noNaN: true }),
  heightMm: fc.double({ min: 1, max: 400, noNaN: true }),
  turnDeg: fc.oneof(fc.constantFrom(0, 90, -45), fc.double({ min: -180, max: 180, noNaN: true })),
});
const offsetMm = fc.double({ min: -600, max: 600, noNaN: true });
const ORIGIN = { x: 0, y: 0 };
const OPPOSITE: Record<CornerPart, CornerPart> = { nw: "se", ne: "sw", sw: "ne", se: "nw" };

describe("grabbing the drawing", () => {
  it("finds knob and corners before the inside, and nothing outside", () => {
    expect(framePartAt(frame, 20, 30, 4, 10)).toBe("nw");
    expect(framePartAt(frame, 139, 111, 4, 10)).toBe("se");
    expect(framePartAt(frame, 80, 70, 4, 10)).toBe("move");
    expect(framePartAt(frame, 80, 21, 4, 10)).toBe("turn");
    expect(framePartAt(frame, 10, 70, 4, 10)).toBeNull();
  });

  it("finds them where they are once the frame is turned", () => {
    fc.assert(
      fc.property(frames, (given) => {
        const knob = knobOf(given, 30);
        expect(framePartAt(given, knob.x, knob.y, 0.01, 30)).toBe("turn");
        for (const part of CORNER_PARTS) {
          const corner = cornerOf(given, part);
          expect(framePartAt(given, corner.x, corner.y, 0.001, 30)).toBe(part);
        }
        const middle = middleOf(given);
        expect(framePartAt(given, middle.x, middle.y, 0.001, 30)).toBe("move");
      }),
    );
  });
});

describe("dragging", () => {
  it("dragging a corner keeps the proportions, the opposite corner, and a minimum size", () => {
    fc.assert(
      fc.property(frames, fc.constantFrom(...CORNER_PARTS), offsetMm, offsetMm, (start, part, dx, dy) => {
        const end = draggedFrame(start, part, ORIGIN, dx, dy);
        expect(end.widthMm / end.heightMm).toBeCloseTo(start.widthMm / start.heightMm, 6);
        expect(Math.max(end.widthMm, end.heightMm)).toBeGreaterThan(1.99);
        const before = cornerOf(start, OPPOSITE[part]);
        const after = cornerOf(end, OPPOSITE[part]);
        expect(after.x).toBeCloseTo(before.x, 6);
        expect(after.y).toBeCloseTo(before.y, 6);
      }),
      { numRuns: cases() },
    );
  });

  it("follows the pointer when a corner is dragged along the diagonal", () => {
    const end = draggedFrame(frame, "se", ORIGIN, 60, 40);
    expect(end).toEqual({ xMm: 20, yMm: 30, widthMm: 180, heightMm: 120, turnDeg: 0 });
  });

  it("dragging the knob turns the drawing about its middle by the angle of the pointer", () => {
    const end = draggedFrame(frame, "turn", { x: 80, y: 20 }, 50, 50);
    expect(end).toEqual({ ...frame, turnDeg: 90 });
    fc.assert(
      fc.property(frames, fc.double({ min: -179, max: 179, noNaN: true }), (start, deg) => {
        const { x, y } = middleOf(start);
        const angle = (deg * Math.PI) / 180;
        const turned = draggedFrame(
          start,
          "turn",
          { x: x + 50, y },
          50 * Math.cos(angle) - 50,
          50 * Math.sin(angle),
        );
        expect(wholeTurn(turned.turnDeg - start.turnDeg - deg)).toBeCloseTo(0, 6);
        expect({ ...turned, turnDeg: 0 }).toEqual({ ...start, turnDeg: 0 });
      }),
    );
  });
});

describe("snapping a dragged frame to lines", () => {
  const margins = { topMm: 10, rightMm: 10, bottomMm: 10, leftMm: 10 };
  const lines = snapLinesOf({ width: 297, height: 210 }, margins);

  it("snaps the nearest edge or middle to a margin or the paper's middle, and reports which", () => {
    const near = { ...frame, xMm: 11.5, yMm: 64.2 };
    const { frame: snapped, lines: on } = snapFrame(near, "move", lines, 3);
    expect([snapped.xMm, snapped.widthMm, snapped.heightMm]).toEqual([10, 120, 80]);
    expect(snapped.yMm).toBeCloseTo(65, 9);
    expect(on).toEqual({ xs: [10], ys: [105] });
    expect(snapFrame(near, "move", lines, 0.5)).toEqual({ frame: near, lines: { xs: [], ys: [] } });
  });

  it("snaps a dragged corner to a line and keeps the proportions", () => {
    const { frame: snapped } = snapFrame({ ...frame, widthMm: 123, heightMm: 82 }, "se", lines, 4);
    // 147 across lies 1.5 from the paper's middle; 112 down lies 7 from it.
    const wide = snapFrame({ ...frame, widthMm: 127, heightMm: (127 * 2) / 3 }, "se", lines, 4).frame;
    expect(snapped).toEqual({ ...frame, widthMm: 123, heightMm: 82 });
    expect(cornerOf(wide, "se").x).toBeCloseTo(148.5, 9);
    expect(wide.widthMm / wide.heightMm).toBeCloseTo(1.5, 9);
    expect([wide.xMm, wide.yMm].map((mm) => Number(mm.toFixed(9)))).toEqual([20, 30]);
  });

  it("takes the box around a turned frame", () => {
    const turned = { ...frame, turnDeg: 90, xMm: 1 };
    const { frame: snapped } = snapFrame({ ...turned, xMm: turned.xMm - 10.5 }, "move", lines, 3);
    expect(boxAround(snapped).x0).toBeCloseTo(10, 9);
  });

  it("turns in steps of 15° when near one, and otherwise by any angle", () => {
    const degAt = (turnDeg: number): number =>
      snapFrame({ ...frame, turnDeg }, "turn", lines, 3).frame.turnDeg;
    expect([degAt(44), degAt(-2.5), degAt(179), degAt(52), degAt(20)]).toEqual([45, 0, 180, 52, 20]);
  });
});

describe("places of the report", () => {
  it("lie around the page's box on the paper", () => {
    const quarterTurn = { a: 0, b: 2, c: -2, d: 0, e: 100, f: 5 };
    expect(paperBoxOf([0, 0, 10, 20], quarterTurn)).toEqual({ xMm: 60, yMm: 5, widthMm: 40, heightMm: 20 });
  });
});
