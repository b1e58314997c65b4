import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { machineById, type StrokePosition, type StrokeSet } from "../../../src/index.js";
import { pointAt, strokeLengthMm } from "../../../src/position/on-drawing.js";
import { maxOffDrawingMm, maxOffLineMm, reportedPosition } from "../../../src/position/reported.js";
import { DEFAULT_MOTION } from "../../../src/settings/motion.js";
import { cases } from "../../support/runs/full-run.js";
import { strokesOf } from "../../support/plots/local-planner.js";
import { mmOf } from "../../support/drawings/stop-truth.js";

const NEAR_MM = 0.09;
const FAR = { aheadMm: 1e6, nearMm: NEAR_MM, offLineMm: 0.009 };
/** How far a position may be off, along x and y. */
const JITTER_MM = 0.012;
const INEXACT = { ...FAR, offLineMm: 1.42 * JITTER_MM };

type Points = readonly (readonly [x: number, y: number])[];

const coordinate = fc.oneof(fc.integer({ min: 1, max: 9 }), fc.double({ min: 1, max: 9, noNaN: true }));
const points = fc
  .array(fc.tuple(coordinate, coordinate), { minLength: 2, maxLength: 5 })
  .map((all): Points => all);
const back = (all: Points): Points => [...all].reverse();
/** Nearly the same points. */
const shifted = (all: Points, mm: number): Points => all.map(([x, y]) => [x + mm, y - mm]);
const times = <T>(count: number, part: readonly T[]): T[] => Array.from({ length: count }, () => part).flat();

/** A stroke that passes the same points several times: exactly, nearly, in closed loops or on crossings. */
const manyPasses = fc
  .tuple(points, fc.integer({ min: 1, max: 5 }), fc.nat(4))
  .map(([all, count, kind]): Points => {
    if (kind === 0) return times(count, [...all, ...back(all).slice(1)]);
    if (kind === 1) return [...times(count, all), all[0]];
    if (kind === 2) return Array.from({ length: count }, (_, i) => shifted(all, 0.01 * i)).flat();
    if (kind === 3) return [...all, ...shifted(back(all), 0.02)];
    return all;
  });
/** Also strokes that retrace the one before. */
const strokeSets = fc.array(fc.tuple(manyPasses, fc.boolean()), { minLength: 1, maxLength: 4 }).map((all) => {
  const lines = all.flatMap(([one, isRetraced]) => (isRetraced ? [one, back(one)] : [one]));
  return strokesOf(...lines.map((line) => line.flat()));
});
const share = fc.double({ min: 0, max: 1, noNaN: true });
const jitter = fc.double({ min: -JITTER_MM, max: JITTER_MM, noNaN: true });

/** The place that many mm from the drawing's beginning. */
function placeAtMm(strokes: StrokeSet, mm: number): StrokePosition {
  let stroke = 0;
  let leftMm = mm;
  while (stroke + 2 < strokes.offsets.length && leftMm >= strokeLengthMm(strokes, stroke)) {
    leftMm -= strokeLengthMm(strokes, stroke++);
  }
  return { stroke, alongMm: Math.min(leftMm, strokeLengthMm(strokes, stroke)) };
}

const lengthMmOf = (strokes: StrokeSet): number =>
  mmOf(strokes, { stroke: strokes.offsets.length - 1, alongMm: 0 });

describe("the place where a plot was interrupted", () => {
  it.each([
    ["down", false],
    ["lifted by a stop", true],
  ] as const)(
    "is between what was received and a pen that is %s, at any instant, whatever the line passes twice",
    (_, up) => {
      fc.assert(
        fc.property(strokeSets, share, share, jitter, jitter, (strokes, from, to, dx, dy) => {
          const wholeMm = lengthMmOf(strokes);
          const received = placeAtMm(strokes, from * wholeMm);
          const receivedMm = mmOf(strokes, received);
          const pen = placeAtMm(strokes, receivedMm + to * (wholeMm - receivedMm));
          const { x, y } = pointAt(strokes, pen);
          const found = reportedPosition(strokes, received, { x: x + dx, y: y + dy, up }, INEXACT);
          expect(found).not.toBeNull();
          const foundMm = mmOf(strokes, found!);
          expect(foundMm).toBeLessThan(mmOf(strokes, pen) + 0.1);
          // Two passes as near to each other as the carriage may leave the line count as one.
          expect(foundMm).toBeGreaterThan(receivedMm - 2.5 * NEAR_MM);
        }),
        { numRuns: cases(10_000, 500) },
      );
    },
  );

  it("is never beyond a pen that is up on its way to a stroke, and not before what was received", () => {
    fc.assert(
      fc.property(strokeSets, share, share, share, (strokes, from, to, way) => {
        const wholeMm = lengthMmOf(strokes);
        const received = placeAtMm(strokes, from * wholeMm);
        const last = strokes.offsets.length - 2;
        const next = Math.min(last, received.stroke + 1 + Math.floor(3 * to));
        fc.pre(next > received.stroke);
        const start = pointAt(strokes, { stroke: next - 1, alongMm: Infinity });
        const end = pointAt(strokes, { stroke: next, alongMm: 0 });
        const pen = {
          x: start.x + way * (end.x - start.x),
          y: start.y + way * (end.y - start.y),
          up: true,
        };
        const found = reportedPosition(strokes, received, pen, FAR);
        expect(found).not.toBeNull();
        expect(mmOf(strokes, found!)).toBeLessThan(mmOf(strokes, { stroke: next, alongMm: 0 }) + 1e-6);
        expect(mmOf(strokes, found!)).toBeGreaterThan(mmOf(strokes, received) - 2.5 * NEAR_MM);
      }),
      { numRuns: cases(10_000, 500) },
    );
  });

  const two = strokesOf([0, 0, 100, 0], [100, 50, 0, 50], [0, 80, 10, 80]);
  const received = { stroke: 0, alongMm: 20 };
  const since = { ...FAR, aheadMm: 500 };

  it("is the point of the stroke if the pen is down", () => {
    expect(reportedPosition(two, received, { x: 60, y: 0.03, up: false }, since)).toEqual({
      stroke: 0,
      alongMm: 60,
    });
    expect(reportedPosition(two, received, { x: 30, y: 50, up: false }, since)).toEqual({
      stroke: 1,
      alongMm: 70,
    });
  });

  it("is on the side of a sharp corner where the carriage is, also within the rounding of a corner", () => {
    // The sides enclose 47 degrees.
    const corner = strokesOf([20, 28, 24, 20, 27, 28]);
    const sideMm = Math.hypot(4, 8);
    const at = (alongMm: number, dx = 0): StrokePosition | null => {
      const { x, y } = pointAt(corner, { stroke: 0, alongMm });
      return reportedPosition(corner, { stroke: 0, alongMm: 1 }, { x: x + dx, y, up: false }, since);
    };
    expect(at(sideMm + 0.058)?.alongMm).toBeCloseTo(sideMm + 0.058, 6);
    expect(at(sideMm - 0.058)?.alongMm).toBeCloseTo(sideMm - 0.058, 6);
    expect(at(sideMm + 0.058, 0.006)?.alongMm).toBeGreaterThan(sideMm);
    // On both sides, within the rounding to steps: on the first one.
    expect(at(sideMm + 0.01)?.alongMm).toBeLessThanOrEqual(sideMm);
  });

  it("is on the travel to a stroke, or on the stroke, where only one of them leads", () => {
    const strokes = strokesOf([0, 20, 20, 20], [20, 40, 20, 30, 30, 30]);
    const begun = { stroke: 1, alongMm: 0 };
    // The travel to the stroke passes here with the pen up, and the stroke ends its first side here.
    expect(reportedPosition(strokes, begun, { x: 20, y: 30, up: true }, since)).toEqual(begun);
    expect(reportedPosition(strokes, begun, { x: 20, y: 30, up: false }, since)?.alongMm).toBeCloseTo(10, 6);
  });

  it("is on the travel that leaves a stroke in nearly its direction", () => {
    const strokes = strokesOf([10, 20, 20, 20], [10, 22, 20, 22]);
    const leaving = { x: 19.6, y: 20.08, up: true };
    expect(reportedPosition(strokes, { stroke: 0, alongMm: 5 }, leaving, since)).toEqual({
      stroke: 1,
      alongMm: 0,
    });
    const lifted = { x: 19.6, y: 20, up: true };
    expect(reportedPosition(strokes, { stroke: 0, alongMm: 5 }, lifted, since)?.alongMm).toBeCloseTo(9.6, 6);
  });

  it("is on the way out of a line there and back, unless the board had received the way back", () => {
    const thereAndBack = strokesOf([3, 5, 53, 5, 3, 5]);
    const pen = { x: 40, y: 5, up: false };
    expect(reportedPosition(thereAndBack, { stroke: 0, alongMm: 30 }, pen, since)?.alongMm).toBeCloseTo(
      37,
      6,
    );
    expect(reportedPosition(thereAndBack, { stroke: 0, alongMm: 50 }, pen, since)?.alongMm).toBeCloseTo(
      63,
      6,
    );
  });

  it("is on the earliest pass that was not received, of a circle drawn many times", () => {
    const circles = strokesOf(
      Array.from({ length: 541 }, (_, i) => [
        30 + 4 * Math.cos((i / 30) * Math.PI),
        30 + 4 * Math.sin((i / 30) * Math.PI),
      ]).flat(),
    );
    const onceMm = strokeLengthMm(circles, 0) / 9;
    for (let pass = 0; pass < 8; pass++) {
      const from = { stroke: 0, alongMm: (pass + 0.3) * onceMm };
      const place = { stroke: 0, alongMm: (pass + 1.2) * onceMm };
      const found = reportedPosition(circles, from, { ...pointAt(circles, place), up: false }, since);
      expect(found?.alongMm).toBeCloseTo(place.alongMm, 6);
    }
  });

  it("is the next stroke if the pen is up on the way to it", () => {
    expect(reportedPosition(two, received, { x: 100, y: 20, up: true }, since)).toEqual({
      stroke: 1,
      alongMm: 0,
    });
  });

  it("is where the pen is up in the middle of a stroke: a pause has lifted it there", () => {
    expect(reportedPosition(two, received, { x: 36, y: 0, up: true }, since)).toEqual({
      stroke: 0,
      alongMm: 36,
    });
    // A later travel crosses the stroke there.
    const crossed = strokesOf([10, 10, 10, 60], [5, 20, 2, 20], [18, 52, 25, 52]);
    const lifted = { x: 10, y: 36, up: true };
    expect(reportedPosition(crossed, { stroke: 0, alongMm: 16 }, lifted, since)).toEqual({
      stroke: 0,
      alongMm: 26,
    });
    expect(reportedPosition(crossed, { stroke: 1, alongMm: 1 }, lifted, since)).toEqual({
      stroke: 2,
      alongMm: 0,
    });
  });

  it("is the next stroke where the pen has begun to come down just before it", () => {
    const landing = { x: 100, y: 49.9, up: false };
    expect(reportedPosition(two, received, landing, since)).toEqual({ stroke: 1, alongMm: 0 });
    // On the stroke already: from there on.
    const begun = reportedPosition(two, received, { x: 99.9, y: 50, up: false }, since);
    expect(begun?.stroke).toBe(1);
    expect(begun?.alongMm).toBeCloseTo(0.1, 6);
  });

  it("is the start of a stroke that leads back if the carriage is still on its way to it", () => {
    // The travel from (78, 30) and the stroke enclose 18 degrees.
    const leadsBack = strokesOf([60, 12, 78, 12, 78, 30], [60, 36, 63, 36]);
    const landing = { ...since, lowerAheadMm: 1 };
    const before = { stroke: 0, alongMm: 30 };
    const onTravel = { x: 60.094, y: 35.969, up: false };
    expect(reportedPosition(leadsBack, before, onTravel, landing)).toEqual({ stroke: 1, alongMm: 0 });
    const onStroke = reportedPosition(leadsBack, before, { x: 60.094, y: 36, up: false }, landing);
    expect(onStroke?.stroke).toBe(1);
    expect(onStroke?.alongMm).toBeCloseTo(0.094, 6);
    // On both: drawn again.
    const exactlyBack = strokesOf([0, 0, 100, 0], [50, 0, 60, 0]);
    const onBoth = { x: 50.1, y: 0, up: false };
    expect(reportedPosition(exactlyBack, { stroke: 1, alongMm: 0 }, onBoth, landing)).toEqual({
      stroke: 1,
      alongMm: 0,
    });
  });

  it("is the next stroke where the pen comes down fast, further before it but on the way to it", () => {
    const landing = { x: 100, y: 47, up: false };
    const fast = { ...since, lowerAheadMm: 3.5 };
    expect(reportedPosition(two, received, landing, fast)).toEqual({ stroke: 1, alongMm: 0 });
    // The point where the drop begins is rounded to steps.
    expect(reportedPosition(two, received, { ...landing, y: 46.49 }, fast)).toEqual({
      stroke: 1,
      alongMm: 0,
    });
    expect(reportedPosition(two, received, { ...landing, y: 46 }, fast)).toBeNull();
    expect(reportedPosition(two, received, { ...landing, x: 99 }, fast)).toBeNull();
    expect(reportedPosition(two, received, landing, since)).toBeNull();
    expect(reportedPosition(two, { stroke: 1, alongMm: 0 }, landing, fast)).toEqual({
      stroke: 1,
      alongMm: 0,
    });
    // A stroke that goes back along the way is drawn again: better than leaving it out.
    const leadsBack = strokesOf([0, 0, 100, 0], [100, 50, 100, 10, 90, 10]);
    expect(reportedPosition(leadsBack, received, landing, fast)).toEqual({ stroke: 1, alongMm: 0 });
  });

  it("is the end if the pen is up on the way home from the last stroke", () => {
    const late = { stroke: 2, alongMm: 1 };
    for (const [x, y] of [
      [10, 80],
      [5, 40],
    ] as const) {
      expect(reportedPosition(two, late, { x, y, up: true }, since)).toEqual({ stroke: 2, alongMm: 10 });
    }
  });

  it("is the stroke after a change of pens if the pen is up on the way home to it", () => {
    const goingHome = { x: 0, y: 25, up: true };
    const nearlyDrawn = { stroke: 1, alongMm: 90 };
    expect(reportedPosition(two, nearlyDrawn, goingHome, { ...since, stops: [2] })).toEqual({
      stroke: 2,
      alongMm: 0,
    });
  });

  it("is the received stroke after a change of pens if the pen is still on the way home before it", () => {
    const strokes = strokesOf([10, 20, 20, 20], [50, 10, 40, 40], [60, 10, 60, 20]);
    const withStops = { ...since, stops: [1, 2] };
    const begun = { stroke: 1, alongMm: 0 };
    // The way home before the last stroke, from (40, 40), passes there too.
    for (const mm of [0, 5, 10, 20])
      expect(reportedPosition(strokes, begun, { x: mm, y: mm, up: true }, withStops)).toEqual(begun);
  });

  it("is the received stroke if the pen is still on its way to it, or at the end of the one before", () => {
    const strokes = strokesOf([5, 0, 10, 0], [40, 0, 50, 0, 50, 5, 40, 0], [35, 5, 36, 5], [15, -5, 10, -5]);
    const begun = { stroke: 1, alongMm: 0 };
    // The travel to the last stroke passes there too; the closed stroke ends where it begins.
    for (const x of [25, 40])
      expect(reportedPosition(strokes, begun, { x, y: 0, up: true }, since)).toEqual(begun);
    expect(reportedPosition(strokes, begun, { x: 10, y: 0, up: false }, since)).toEqual(begun);
    const ended = { x: 40, y: 0, up: true };
    expect(reportedPosition(strokes, { stroke: 1, alongMm: 12 }, ended, since)).toEqual({
      stroke: 2,
      alongMm: 0,
    });
  });

  it("is the received stroke on the way to it along its own line, also if its start was computed a rounding error late", () => {
    const strokes = strokesOf([10, 5, 45, 5], [10, 5, 40, 5]);
    for (const alongMm of [0, 5e-29, 1e-9]) {
      const received = { stroke: 1, alongMm };
      for (const x of [44, 30, 19])
        expect(reportedPosition(strokes, received, { x, y: 5, up: true }, FAR)).toEqual(received);
      expect(reportedPosition(strokes, received, { x: 9.95, y: 5, up: false }, FAR)).toEqual({
        stroke: 1,
        alongMm: 0,
      });
    }
  });

  it("is unknown if the pen is somewhere else, or further than it can have come", () => {
    expect(reportedPosition(two, received, { x: 60, y: 5, up: false }, since)).toBeNull();
    expect(reportedPosition(two, received, { x: 60, y: 0, up: false }, { ...since, aheadMm: 30 })).toBeNull();
    expect(
      reportedPosition(two, received, { x: 5, y: 80, up: false }, { ...since, aheadMm: 100 }),
    ).toBeNull();
    const goingHome = { x: 5, y: 40, up: true };
    expect(reportedPosition(two, { stroke: 2, alongMm: 1 }, goingHome, { ...since, aheadMm: 45 })).toBeNull();
  });

  it("counts as near what corners, merged commands, steps and shaping move the carriage away", () => {
    const machine = machineById("axidraw-v3");
    const nearMm = maxOffDrawingMm(DEFAULT_MOTION, machine);
    expect(nearMm).toBeCloseTo(0.025 + 0.02 + 2 / machine.stepsPerMm + 0.02, 9);
    const rounded = { ...DEFAULT_MOTION, layers: { a: { cornerMm: 1 } } };
    expect(maxOffDrawingMm(rounded, machine) - nearMm).toBeCloseTo(0.975, 9);
    const springs = { xHz: 15, yHz: 25, damping: 0.05 };
    const shaped = { ...DEFAULT_MOTION, shaper: "zv" } as const;
    expect(maxOffDrawingMm(shaped, { ...machine, springs })).toBeGreaterThan(nearMm + 0.05);
    const offLineMm = maxOffLineMm(rounded, machine);
    expect(offLineMm).toBeCloseTo(0.71 / machine.stepsPerMm, 9);
    expect(maxOffLineMm(shaped, { ...machine, springs })).toBeGreaterThan(offLineMm + 0.05);
  });
});
