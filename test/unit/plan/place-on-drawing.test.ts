import { describe, expect, it } from "vitest";
import { nearestPlace, snappedPlace } from "../../../src/plan/place-on-drawing.js";
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

/** A right angle at (10, 0). */
const CORNER = strokesOf([0, 0, 10, 0, 10, 10]);
const nearest = (alongMm: number, x: number, y: number, withinMm = 0.5) =>
  nearestPlace(CORNER, { stroke: 0, alongMm }, { x, y }, withinMm);

describe("the nearest place of a stroke", () => {
  it("may be on the next side of a corner, and on the side before", () => {
    const { place, awayMm } = nearest(9.9, 9.95, 0.08);
    expect(place.alongMm).toBeCloseTo(10.08, 9);
    expect(awayMm).toBeCloseTo(0.05, 9);
    expect(nearest(10.1, 9.9, 0.04).place.alongMm).toBeCloseTo(9.9, 9);
  });

  it("is searched no farther along the stroke than asked for", () => {
    expect(nearest(9.9, 9.95, 0.08, 0.1).place.alongMm).toBeCloseTo(9.95, 9);
    expect(nearest(3, 9.95, 0.08)).toEqual({ place: { stroke: 0, alongMm: 3 }, awayMm: Infinity });
  });

  it("ends with the stroke", () => {
    const { place, awayMm } = nearest(19.9, 10, 10.2);
    expect(place.alongMm).toBeCloseTo(20, 9);
    expect(awayMm).toBeCloseTo(0.2, 9);
  });
});
