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

const endOf = (strokes: ReturnType<typeof strokesOf>, stroke: number) =>
  pointOfPlace(strokes, { stroke, alongMm: strokeLengthMm(strokes, stroke) });

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

  it("is never beyond a pen that is up, in the middle of a stroke or on the way to one", () => {
    // On a grid, so that travels often pass along strokes or cross them.
    const onGrid = fc.array(fc.tuple(fc.nat(4), fc.nat(4)), { minLength: 2, maxLength: 4 });
    const inParts = fc.nat(4).map((parts) => parts / 4);
    const gridLines = fc.array(
      onGrid.map((points) => points.flat().map((one) => 10 + 10 * one)),
      { minLength: 2, maxLength: 6 },
    );
    fc.assert(
      fc.property(gridLines, fc.nat(5), inParts, inParts, fc.nat(3), fc.boolean(), (...drawn) => {
        const [xys, at, journalShare, penShare, ahead, isTravelling] = drawn;
        const strokes = strokesOf(...xys);
        const first = at % xys.length;
        const stroke = Math.min(xys.length - 1, first + ahead);
        const journal = { stroke: first, alongMm: journalShare * strokeLengthMm(strokes, first) };
        const fromMm = stroke === first ? journal.alongMm : 0;
        // A pen that is up at the end of a stroke has drawn it.
        const endMm = 0.99 * strokeLengthMm(strokes, stroke);
        const alongMm = isTravelling ? fromMm : Math.max(fromMm, penShare * endMm);
        const place: Place = { stroke, alongMm };
        const to = pointOfPlace(strokes, place);
        const from = stroke === first ? { x: 0, y: 0 } : endOf(strokes, stroke - 1);
        // At home itself, the driver does not tell where the carriage is.
        const share = isTravelling ? Math.max(0.1, penShare) : 1;
        const pen = {
          x: from.x + share * (to.x - from.x),
          y: from.y + share * (to.y - from.y),
          up: true,
        };
        const found = stoppedPlace(strokes, journal, pen, { aheadMm: 1e6 });
        expect(drawnMm(strokes, journal, found)).toBeGreaterThan(-0.1);
        expect(drawnMm(strokes, found, place)).toBeGreaterThan(-0.1);
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
    ] as const) {
      expect(stoppedPlace(two, late, { x, y, up: true }, { aheadMm: 500 })).toEqual(end);
    }
    expect(stoppedPlace(two, journal, { x: 0, y: 0, up: true }, { aheadMm: 100 })).toEqual(journal);
  });

  it("is the stroke after a change of pens if the pen is up on the way home to it", () => {
    const nearlyDrawn = { stroke: 1, alongMm: 90 };
    const goingHome = { x: 0, y: 25, up: true };
    const since = { aheadMm: 500, stops: [2] };
    expect(stoppedPlace(two, nearlyDrawn, goingHome, since)).toEqual({ stroke: 2, alongMm: 0 });
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

  it("is the journal's place if a stop lifted the pen in the middle of a stroke that a later travel crosses", () => {
    const crossed = strokesOf([10, 10, 10, 60], [5, 20, 2, 20], [18, 52, 25, 52]);
    const lifted = { x: 10, y: 36, up: true };
    // Exact; a quarter of a second old; where a swinging pen came to rest.
    for (const alongMm of [26, 16, 26.9]) {
      const stopped = { stroke: 0, alongMm };
      expect(stoppedPlace(crossed, stopped, lifted, { aheadMm: 500 })).toEqual(stopped);
    }
    const drawn = { stroke: 1, alongMm: 1 };
    expect(stoppedPlace(crossed, drawn, lifted, { aheadMm: 500 })).toEqual({ stroke: 2, alongMm: 0 });
  });

  it("is the journal's place if the pen is up on the way to it", () => {
    const strokes = strokesOf([5, 0, 10, 0], [40, 0, 50, 0, 50, 5, 40, 0], [35, 5, 36, 5], [15, -5, 10, -5]);
    const begun = { stroke: 1, alongMm: 0 };
    // The travel to the last stroke passes there too; the closed stroke ends where it begins.
    for (const x of [25, 40]) {
      expect(stoppedPlace(strokes, begun, { x, y: 0, up: true }, { aheadMm: 500 })).toEqual(begun);
    }
    const ended = { x: 40, y: 0, up: true };
    expect(stoppedPlace(strokes, { stroke: 1, alongMm: 12 }, ended, { aheadMm: 500 })).toEqual({
      stroke: 2,
      alongMm: 0,
    });
  });

  it("is the journal's place if the carriage was brought home, or is on its way from there", () => {
    for (const share of [0, 0.3]) {
      const pen = { x: 20 * share, y: 0, up: true };
      expect(stoppedPlace(two, journal, pen, { aheadMm: 500 })).toEqual(journal);
    }
  });

  it("is the journal's place if the way home is longer than the carriage can have come", () => {
    const late = { stroke: 2, alongMm: 1 };
    const goingHome = { x: 5, y: 40, up: true };
    expect(stoppedPlace(two, late, goingHome, { aheadMm: 45 })).toEqual(late);
    expect(stoppedPlace(two, late, goingHome, { aheadMm: 55 })).toEqual({ stroke: 2, alongMm: 10 });
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
