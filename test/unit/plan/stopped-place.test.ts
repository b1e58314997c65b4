import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { pointOfPlace, strokeLengthMm } from "../../../src/plan/place-on-drawing.js";
import { placeBehindSent, stoppedPlace } from "../../../src/plan/stopped-place.js";
import type { Place } from "../../../src/index.js";
import { cases } from "../../support/full-run.js";
import { strokesOf } from "../../support/local-planner.js";

const coordinate = fc.double({ min: 0, max: 200, noNaN: true });
const line = fc
  .array(fc.tuple(coordinate, coordinate), { minLength: 2, maxLength: 8 })
  .map((points) => points.flat());
const lines = fc.array(line, { minLength: 1, maxLength: 6 });
const share = fc.double({ min: 0, max: 1, noNaN: true });

/** Everything that is drawn from one place to another, mm. */
function drawnMm(strokes: ReturnType<typeof strokesOf>, from: Place, to: Place): number {
  let mm = to.alongMm - from.alongMm;
  for (let stroke = from.stroke; stroke < to.stroke; stroke++) mm += strokeLengthMm(strokes, stroke);
  return mm;
}

describe("the place where a plot was interrupted", () => {
  it("is after the journal's place and never beyond the pen, so that nothing is left out", () => {
    fc.assert(
      fc.property(lines, fc.nat(5), share, share, fc.nat(3), (xys, at, journalShare, penShare, ahead) => {
        const strokes = strokesOf(...xys);
        const first = at % xys.length;
        const stroke = Math.min(xys.length - 1, first + ahead);
        const journal = { stroke: first, alongMm: journalShare * strokeLengthMm(strokes, first) };
        const alongMm = penShare * strokeLengthMm(strokes, stroke);
        const pen: Place = {
          stroke,
          alongMm: stroke === first ? Math.max(alongMm, journal.alongMm) : alongMm,
        };
        const found = stoppedPlace(
          strokes,
          journal,
          { ...pointOfPlace(strokes, pen), up: false },
          { aheadMm: 1e6 },
        );
        expect(drawnMm(strokes, journal, found)).toBeGreaterThan(-0.1);
        expect(drawnMm(strokes, found, pen)).toBeGreaterThan(-0.1);
        const [a, b] = [pointOfPlace(strokes, found), pointOfPlace(strokes, pen)];
        expect(Math.hypot(a.x - b.x, a.y - b.y)).toBeLessThan(0.17);
      }),
      { numRuns: cases() },
    );
  });

  const two = strokesOf([0, 0, 100, 0], [100, 50, 0, 50], [0, 80, 10, 80]);
  const journal = { stroke: 0, alongMm: 20 };

  it("is the point of the stroke if the pen is down", () => {
    expect(stoppedPlace(two, journal, { x: 60, y: 0.03, up: false }, { aheadMm: 500 })).toEqual({
      stroke: 0,
      alongMm: 60,
    });
    expect(stoppedPlace(two, journal, { x: 30, y: 50, up: false }, { aheadMm: 500 })).toEqual({
      stroke: 1,
      alongMm: 70,
    });
  });

  it("is the next stroke if the pen is up on the way to it", () => {
    expect(stoppedPlace(two, journal, { x: 100, y: 20, up: true }, { aheadMm: 500 })).toEqual({
      stroke: 1,
      alongMm: 0,
    });
  });

  it("is the next stroke where the pen has begun to come down just before it", () => {
    const landing = { x: 100, y: 49.9, up: false };
    expect(stoppedPlace(two, journal, landing, { aheadMm: 500 })).toEqual({ stroke: 1, alongMm: 0 });
    // On the stroke already: from there on.
    const begun = stoppedPlace(two, journal, { x: 99.9, y: 50, up: false }, { aheadMm: 500 });
    expect(begun.stroke).toBe(1);
    expect(begun.alongMm).toBeCloseTo(0.1, 6);
  });

  it("is the start of a stroke that leads back if the carriage is still on its way to it", () => {
    // The travel from (78, 30) and the stroke enclose 18 degrees.
    const back = strokesOf([60, 12, 78, 12, 78, 30], [60, 36, 63, 36]);
    const since = { aheadMm: 500, landingMm: 1 };
    const before = { stroke: 0, alongMm: 30 };
    const onTravel = { x: 60.094, y: 35.969, up: false };
    expect(stoppedPlace(back, before, onTravel, since)).toEqual({ stroke: 1, alongMm: 0 });
    const onStroke = stoppedPlace(back, before, { x: 60.094, y: 36, up: false }, since);
    expect(onStroke.stroke).toBe(1);
    expect(onStroke.alongMm).toBeCloseTo(0.094, 6);
    // On both: drawn again.
    const exactlyBack = strokesOf([0, 0, 100, 0], [50, 0, 60, 0]);
    expect(stoppedPlace(exactlyBack, { stroke: 1, alongMm: 0 }, { x: 50.1, y: 0, up: false }, since)).toEqual(
      {
        stroke: 1,
        alongMm: 0,
      },
    );
  });

  it("is the next stroke where the pen comes down fast, further before it but on the way to it", () => {
    const landing = { x: 100, y: 47, up: false };
    const since = { aheadMm: 500, landingMm: 3.5 };
    expect(stoppedPlace(two, journal, landing, since)).toEqual({ stroke: 1, alongMm: 0 });
    expect(stoppedPlace(two, journal, { ...landing, y: 46 }, since)).toEqual(journal);
    expect(stoppedPlace(two, journal, { ...landing, x: 99 }, since)).toEqual(journal);
    expect(stoppedPlace(two, journal, landing, { aheadMm: 500 })).toEqual(journal);
    expect(placeBehindSent(two, { stroke: 1, alongMm: 0 }, landing, since)).toEqual({
      stroke: 1,
      alongMm: 0,
    });
    // A stroke that goes back along the way is drawn again: better than leaving it out.
    const back = strokesOf([0, 0, 100, 0], [100, 50, 100, 10, 90, 10]);
    expect(stoppedPlace(back, journal, landing, since)).toEqual({ stroke: 1, alongMm: 0 });
  });

  it("is the end if the pen is up on the way home from the last stroke", () => {
    const end = { stroke: 2, alongMm: 10 };
    const late = { stroke: 2, alongMm: 1 };
    for (const [x, y] of [
      [10, 80],
      [5, 40],
      [0, 0],
    ] as const) {
      expect(stoppedPlace(two, late, { x, y, up: true }, { aheadMm: 500 })).toEqual(end);
    }
    expect(stoppedPlace(two, journal, { x: 0, y: 0, up: true }, { aheadMm: 100 })).toEqual(journal);
  });

  it("is the stroke after a change of pens if the pen is up on the way home to it", () => {
    const home = { x: 0, y: 0, up: true };
    expect(stoppedPlace(two, journal, home, { aheadMm: 500, stops: [1] })).toEqual({ stroke: 1, alongMm: 0 });
  });

  it("is the journal's place if the carriage is at home and nothing was drawn since it left home", () => {
    const line = strokesOf([10, 0, 20, 0]);
    const begun = { stroke: 0, alongMm: 0 };
    expect(stoppedPlace(line, begun, { x: 0, y: 0, up: true }, { aheadMm: 500 })).toEqual(begun);
    const other = { stroke: 1, alongMm: 0 };
    expect(stoppedPlace(two, other, { x: 0, y: 0, up: true }, { aheadMm: 500, stops: [1, 2] })).toEqual(
      other,
    );
  });

  it("is the journal's place if the pen is somewhere else, or further than possible", () => {
    expect(stoppedPlace(two, journal, { x: 60, y: 5, up: false }, { aheadMm: 500 })).toEqual(journal);
    expect(stoppedPlace(two, journal, { x: 5, y: 80, up: false }, { aheadMm: 100 })).toEqual(journal);
  });

  describe("by a kill, after which the board plays everything that was sent", () => {
    /** A loop of 7 mm: out, round and over itself. */
    const loop = strokesOf([0, 0, 20, 0, 20, 2, 18.5, 2, 18.5, -10]);
    const crossing = { x: 18.5, y: 0, up: false };

    it("is where the line passes a crossing again if its first passage was sent before the last entry", () => {
      expect(stoppedPlace(loop, { stroke: 0, alongMm: 10 }, crossing, { aheadMm: 60 })).toEqual({
        stroke: 0,
        alongMm: 18.5,
      });
      expect(placeBehindSent(loop, { stroke: 0, alongMm: 19 }, crossing, { aheadMm: 18 })).toEqual({
        stroke: 0,
        alongMm: 25.5,
      });
      expect(placeBehindSent(loop, { stroke: 0, alongMm: 18.4 }, crossing, { aheadMm: 18 })).toEqual({
        stroke: 0,
        alongMm: 18.5,
      });
    });

    it("is unknown if nothing matches, or the pen is up", () => {
      expect(placeBehindSent(loop, { stroke: 0, alongMm: 26 }, crossing, { aheadMm: 18 })).toBeNull();
      expect(
        placeBehindSent(loop, { stroke: 0, alongMm: 19 }, { ...crossing, up: true }, { aheadMm: 18 }),
      ).toBeNull();
    });
  });
});
