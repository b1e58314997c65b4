import { describe, expect, it } from "vitest";
import { snappedPlace } from "../../../src/plan/place-on-drawing.js";
import { strokesOf } from "../../support/local-planner.js";

/** Out to a tip and back, a hundredth of a millimetre beside. */
const TIP = strokesOf([0, 0, 10, 0, 0, 0.01]);
const snapped = (alongMm: number, x: number, vx: number) =>
  snappedPlace(TIP, { stroke: 0, alongMm }, { x, y: 0.005, vx, vy: 0 }, 0.5).alongMm;

describe("the place on the drawing for a pen position", () => {
  it("is the point beside it", () => {
    expect(snapped(4.03, 4, 20)).toBeCloseTo(4, 6);
    expect(snapped(15.97, 4, -20)).toBeCloseTo(16, 2);
  });

  it("is the planned place if stroke and pen run in opposite directions near a tip", () => {
    expect(snapped(10.01, 9.94, 6)).toBe(10.01);
    expect(snapped(9.99, 9.94, -6)).toBe(9.99);
    expect(snapped(10.01, 9.94, -6)).toBeCloseTo(10.06, 3);
  });
});
