import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { paperBoxOf } from "../../web/preview/frame.js";
import { draggedFrame, FRAME_PARTS, framePartAt, type FrameMm } from "../../web/preview/placing.js";

const frame: FrameMm = { xMm: 20, yMm: 30, widthMm: 120, heightMm: 80 };
const frames = fc.record({
  xMm: fc.double({ min: -100, max: 300, noNaN: true }),
  yMm: fc.double({ min: -100, max: 300, noNaN: true }),
  widthMm: fc.double({ min: 1, max: 400, noNaN: true }),
  heightMm: fc.double({ min: 1, max: 400, noNaN: true }),
});
const way = fc.double({ min: -600, max: 600, noNaN: true });

describe("taking hold of the drawing", () => {
  it("finds corners before the inside, and nothing outside", () => {
    expect(framePartAt(frame, 20, 30, 4)).toBe("nw");
    expect(framePartAt(frame, 139, 111, 4)).toBe("se");
    expect(framePartAt(frame, 80, 70, 4)).toBe("move");
    expect(framePartAt(frame, 10, 70, 4)).toBeNull();
  });
});

describe("dragging", () => {
  it("keeps the proportions, the opposite corner, and a size that can be held", () => {
    fc.assert(
      fc.property(frames, fc.constantFrom(...FRAME_PARTS.slice(0, 4)), way, way, (start, part, dx, dy) => {
        const end = draggedFrame(start, part, dx, dy);
        expect(end.widthMm / end.heightMm).toBeCloseTo(start.widthMm / start.heightMm, 6);
        expect(Math.max(end.widthMm, end.heightMm)).toBeGreaterThan(1.99);
        const right = (f: FrameMm): number => f.xMm + f.widthMm;
        const bottom = (f: FrameMm): number => f.yMm + f.heightMm;
        if (part.includes("e")) expect(end.xMm).toBe(start.xMm);
        else expect(right(end)).toBeCloseTo(right(start), 6);
        if (part.includes("s")) expect(end.yMm).toBe(start.yMm);
        else expect(bottom(end)).toBeCloseTo(bottom(start), 6);
      }),
    );
  });

  it("follows the pointer when a corner is drawn along the diagonal", () => {
    const end = draggedFrame(frame, "se", 60, 40);
    expect(end).toEqual({ xMm: 20, yMm: 30, widthMm: 180, heightMm: 120 });
  });
});

describe("places of the report", () => {
  it("lie around what the page's box becomes on the paper", () => {
    const quarterTurn = { a: 0, b: 2, c: -2, d: 0, e: 100, f: 5 };
    expect(paperBoxOf([0, 0, 10, 20], quarterTurn)).toEqual({ xMm: 60, yMm: 5, widthMm: 40, heightMm: 20 });
  });
});
