import { describe, expect, it } from "vitest";
import { nearestOnStroke } from "../../../src/position/on-drawing.js";
import { strokesOf } from "../../support/plots/local-planner.js";

/** Out to a tip and back, a hundredth of a millimetre beside. */
const TIP = strokesOf([0, 0, 10, 0, 0, 0.01]);
const atTip = (alongMm: number, x: number, headingX: number) =>
  nearestOnStroke(TIP, { stroke: 0, alongMm }, { x, y: 0.005 }, 0.5, { x: headingX, y: 0 })?.place.alongMm;

describe("the nearest position of a stroke to a pen that heads in a direction", () => {
  it("is beside the pen", () => {
    expect(atTip(4.03, 4, 20)).toBeCloseTo(4, 6);
    expect(atTip(15.97, 4, -20)).toBeCloseTo(16, 2);
  });

  it("is on the side of a tip that runs in the pen's direction", () => {
    expect(atTip(10.01, 9.94, 6)).toBeCloseTo(9.94, 6);
    expect(atTip(9.99, 9.94, -6)).toBeCloseTo(10.06, 3);
    expect(atTip(10.01, 9.94, -6)).toBeCloseTo(10.06, 3);
  });

  it("is at the tip for a pen just beyond it, before and after it turns", () => {
    expect(atTip(9.99, 10.004, 6)).toBeCloseTo(10, 6);
    expect(atTip(10.01, 10.004, -6)).toBeCloseTo(10, 6);
  });

  it("is unknown where the stroke only runs against the pen", () => {
    expect(atTip(4, 4, -20)).toBeUndefined();
  });
});

/** A right angle at (10, 0). */
const CORNER = strokesOf([0, 0, 10, 0, 10, 10]);
const nearest = (alongMm: number, x: number, y: number, withinMm = 0.5) =>
  nearestOnStroke(CORNER, { stroke: 0, alongMm }, { x, y }, withinMm);

describe("the nearest position of a stroke", () => {
  it("may be on the next side of a corner, and on the side before", () => {
    const next = nearest(9.9, 9.95, 0.08);
    expect(next?.place.alongMm).toBeCloseTo(10.08, 9);
    expect(next?.awayMm).toBeCloseTo(0.05, 9);
    expect(nearest(10.1, 9.9, 0.04)?.place.alongMm).toBeCloseTo(9.9, 9);
  });

  it("is on the side where it is expected if both sides are equally near", () => {
    expect(nearest(9.9, 9.95, 0.05)?.place.alongMm).toBeCloseTo(9.95, 9);
    expect(nearest(10.1, 9.95, 0.05)?.place.alongMm).toBeCloseTo(10.05, 9);
  });

  it("is searched no farther along the stroke than asked for", () => {
    expect(nearest(9.9, 9.95, 0.08, 0.1)?.place.alongMm).toBeCloseTo(9.95, 9);
    expect(nearest(3, 9.95, 0.08)).toBeNull();
  });

  it("ends with the stroke", () => {
    const end = nearest(19.9, 10, 10.2);
    expect(end?.place.alongMm).toBeCloseTo(20, 9);
    expect(end?.awayMm).toBeCloseTo(0.2, 9);
  });
});
