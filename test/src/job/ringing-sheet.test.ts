/** The ringing sheet, drawn by virtual machines that swing, and read as a person would read it off the paper. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importSvg,
  machineById,
  planJob,
  PlotwrightError,
  prepare,
} from "../../../src/index.js";
import { boxOfPoints, isAllowed, SPRINGS_TABLE, swingPen, type Springs } from "../../../src/internal.js";
import { ringingChecks } from "../../../src/job/ringing-checks.js";
import {
  crestsOf,
  DAMPINGS,
  frequenciesOf,
  RINGING_MOTION,
  RINGING_SHEET_MM,
  ringingLine,
  ringingSheet,
  STRAIGHT_MM,
  type Axis,
  type RingingPoint,
  type RippleReading,
} from "../../../src/job/ringing-sheet.js";
import { FastBoard } from "../../support/plots/virtual-plots.js";
import { cases } from "../../support/runs/full-run.js";
import { generator } from "../../support/import/mutate.js";

const machine = machineById("axidraw-v3");
const prepared = prepare(await importSvg(ringingSheet()), { ...DEFAULT_PREPARE, fit: false, order: "none" });
const { strokes } = prepared;
const { trajectory } = planJob(prepared, { motion: RINGING_MOTION, pen: DEFAULT_PEN }, machine);

/** The strokes: three lines for y, then three for x. */
const strokeOf = (axis: Axis, line: number): number => (axis === "y" ? 0 : 3) + line;

/** A place on the paper as a point of the straight part; null: it is elsewhere. */
function onStraight(axis: Axis, stroke: number, x: number, y: number): RingingPoint | null {
  const bend = 2 * (strokes.offsets[stroke] + 1);
  const [dx, dy] = [x - strokes.xy[bend], y - strokes.xy[bend + 1]];
  const [alongMm, besideMm] = axis === "x" ? [dy, dx] : [dx, -dy];
  return alongMm >= 0 && alongMm <= STRAIGHT_MM ? { alongMm, besideMm } : null;
}

/** The straight parts that a virtual board's pen draws. */
function drawnOn(springs: Springs): Record<Axis, RingingPoint[]> {
  const fast = new FastBoard("2.8.1", machine, DEFAULT_PEN, { springs });
  expect(fast.play(fast.compile(trajectory)).firstWrong).toBeNull();
  const lines = fast.board.drawn().filter(({ penDown, xy }) => penDown && xy.length > 2);
  expect(lines).toHaveLength(6);
  const line = (axis: Axis): RingingPoint[] => {
    const stroke = strokeOf(axis, 1);
    const { xy } = lines[stroke];
    return Array.from({ length: xy.length / 2 }, (_, i) =>
      onStraight(axis, stroke, xy[2 * i], xy[2 * i + 1]),
    ).filter((point) => point !== null);
  };
  return { x: line("x"), y: line("y") };
}

/** A person does not see lower crests beside a line 0.3 mm wide. */
const SEEN_MM = 0.06;
/** A person takes the middle of a crest this much too early or too late. */
const BESIDE_MIDDLE_MM = 0.1;

/** The highest point of each part of the line that is visibly on the outer side. */
function seenCrests(line: readonly RingingPoint[]): RingingPoint[] {
  const crests: RingingPoint[] = [];
  let top: RingingPoint | null = null;
  for (const point of line) {
    if (point.besideMm > (top?.besideMm ?? SEEN_MM)) top = point;
    if (point.besideMm < 0 && top !== null) {
      crests.push(top);
      top = null;
    }
  }
  return crests;
}

/** Counts whole ripples, and measures their length to half a mm. */
function readRipples(line: readonly RingingPoint[], random: () => number): RippleReading {
  const crests = seenCrests(line);
  const missMm = BESIDE_MIDDLE_MM * 2 * (random() - random());
  const lengthMm = crests[crests.length - 1].alongMm - crests[0].alongMm + missMm;
  return { ripples: crests.length - 1, lengthMm: Math.round(2 * lengthMm) / 2 };
}

/** Chooses the picture whose crests are as high as those on the paper, seen to a tenth of a mm. */
function readDamping(line: readonly RingingPoint[], axis: Axis, springs: Springs): number {
  const heights = seenCrests(line).map(({ besideMm }) => Math.round(10 * besideMm) / 10);
  const missOf = (damping: number): number => {
    const crests = crestsOf(ringingLine({ ...springs, damping }, axis));
    return heights.reduce((sum, mm, i) => sum + Math.abs(mm - (crests[i]?.besideMm ?? 0)), 0);
  };
  return DAMPINGS.reduce((best, damping) => (missOf(damping) < missOf(best) ? damping : best));
}

describe("the ringing sheet", () => {
  it("is a strip of 60 × 40 mm of six lines", () => {
    const { x0, y0, x1, y1 } = boxOfPoints(strokes.xy);
    expect([x0, y0].every((mm) => mm >= 0)).toBe(true);
    expect(x1).toBeLessThanOrEqual(RINGING_SHEET_MM.width + 1e-9);
    expect(y1).toBeLessThanOrEqual(RINGING_SHEET_MM.height + 1e-9);
    expect(strokes.offsets.length - 1).toBe(6);
  });

  it("draws every straight part at one speed, of 150 mm/s", () => {
    const { runs, vx, vy, ax, ay, durationS } = trajectory;
    let straightS = 0;
    for (let run = 0; run < runs.count; run++) {
      if (runs.stroke[run] < 0) continue;
      for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) {
        const isAlong = Math.abs(runs.stroke[run] < 3 ? vy[k] : vx[k]) < 1e-6;
        if (!isAlong || Math.hypot(ax[k], ay[k]) > 1e-6) continue;
        expect(Math.hypot(vx[k], vy[k])).toBeCloseTo(150, 6);
        straightS += durationS[k];
      }
    }
    expect(150 * straightS).toBeCloseTo(6 * STRAIGHT_MM, 3);
  });

  it("asks no motor to change its speed at once by more than a right angle at 75 mm/s does", () => {
    const { runs, vx, vy, ax, ay, durationS } = trajectory;
    for (let run = 0; run < runs.count; run++) {
      for (let k = runs.firstBlock[run]; k + 1 < runs.firstBlock[run + 1]; k++) {
        const jumpX = vx[k + 1] - vx[k] - ax[k] * durationS[k];
        const jumpY = vy[k + 1] - vy[k] - ay[k] * durationS[k];
        expect(Math.abs(jumpX) + Math.abs(jumpY)).toBeLessThan(150);
      }
    }
  });

  it("looks like the picture that is calculated for these springs", () => {
    const springs = { xHz: 14, yHz: 23, damping: 0.05 };
    for (const axis of ["x", "y"] as const) {
      // The first line, because the machine still swings a little from the travel to the next one.
      const stroke = strokeOf(axis, 0);
      const drawn: RingingPoint[] = [];
      swingPen(trajectory, springs, 5e-4, (pen) => {
        const point = pen.stroke === stroke ? onStraight(axis, stroke, pen.x, pen.y) : null;
        if (point) drawn.push(point);
      });
      const [is, calculated] = [drawn, ringingLine(springs, axis)].map(crestsOf);
      expect(is.length).toBe(calculated.length);
      is.forEach(({ alongMm, besideMm }, i) => {
        expect(Math.abs(alongMm - calculated[i].alongMm)).toBeLessThan(0.15);
        expect(Math.abs(besideMm - calculated[i].besideMm)).toBeLessThan(0.05);
      });
    }
  });

  it("tells both frequencies within 5 % on 95 of 100 machines, and a damping near the true one", () => {
    const below = generator(44);
    const random = (): number => below(1_000_000) / 1_000_000;
    const count = cases(100, 20);
    let [rightHz, rightDamping] = [0, 0];
    for (let i = 0; i < count; i++) {
      const springs = { xHz: 12 + 33 * random(), yHz: 12 + 33 * random(), damping: 0.02 + 0.1 * random() };
      const { x, y } = drawnOn(springs);
      const readings = { x: readRipples(x, random), y: readRipples(y, random) };
      const plain = frequenciesOf(readings, 0.05);
      const isNear = (hz: number | null, trueHz: number): boolean =>
        hz !== null && Math.abs(hz / trueHz - 1) <= 0.05;
      if (isNear(plain.x, springs.xHz) && isNear(plain.y, springs.yHz)) rightHz++;
      const damping = readDamping(y, "y", { ...springs, xHz: plain.x!, yHz: plain.y! });
      if (Math.abs(damping - springs.damping) <= 0.03) rightDamping++;
    }
    expect(rightHz).toBeGreaterThanOrEqual(0.95 * count);
    expect(rightDamping).toBeGreaterThanOrEqual(0.9 * count);
  }, 300_000);
});

describe("a reading", () => {
  it("of one axis alone gives its frequency", () => {
    const { x, y } = frequenciesOf({ x: { ripples: 2, lengthMm: 20 }, y: null }, 0.05);
    expect(x).toBeGreaterThan(14);
    expect(x).toBeLessThan(16);
    expect(y).toBeNull();
  });

  it("that no machine can draw is refused, with its axis", () => {
    const read = (ripples: number, lengthMm: number) =>
      frequenciesOf({ x: null, y: { ripples, lengthMm } }, 0.05);
    expect(() => read(50, 10)).toThrow(/^y: 50 ripples in 10 mm would be 750 Hz.*2 to 200 Hz/);
    expect(() => read(2, 50)).toThrow(/longer than the straight part, 32 mm/);
    // Within the range only as long as the swing along the line is left out.
    expect(() =>
      frequenciesOf({ x: { ripples: 2, lengthMm: 20 }, y: { ripples: 1, lengthMm: 0.75 } }, 0.05),
    ).toThrow(/^y: 1 ripples in 0.75 mm would be 211\.\d Hz/);
  });

  it("that is no count and length is refused, whatever it is, and any other gives a frequency that can be stored", () => {
    const value = fc.oneof(
      fc.integer({ min: -3, max: 50 }),
      fc.double({ min: -1, max: 40 }),
      fc.constantFrom(0, -2, 2.5, NaN, Infinity, -Infinity, 1e300),
    );
    const reading = fc.record({ ripples: value, lengthMm: value });
    fc.assert(
      fc.property(reading, reading, fc.double({ min: 0, max: 0.5, noNaN: true }), (x, y, damping) => {
        try {
          const hz = frequenciesOf({ x, y }, damping);
          for (const { ripples, lengthMm } of [x, y]) {
            expect(Number.isInteger(ripples) && ripples > 0 && lengthMm > 0 && lengthMm <= STRAIGHT_MM).toBe(
              true,
            );
          }
          expect(isAllowed(SPRINGS_TABLE.xHz, hz.x!) && isAllowed(SPRINGS_TABLE.yHz, hz.y!)).toBe(true);
        } catch (error) {
          if (!(error instanceof PlotwrightError)) throw error;
          expect(error.code).toBe("bad-setting");
        }
      }),
      { numRuns: cases(2_000, 200) },
    );
  });
});

describe("the second sheet", () => {
  it("has a figure without shaping and one for each of five factors", async () => {
    const checks = ringingChecks({ xHz: 14, yHz: 23, damping: 0.05 });
    expect(checks.map(({ factor }) => factor)).toEqual([null, 0.8, 0.9, 1, 1.1, 1.25]);
    expect(checks[1].springs?.xHz).toBeCloseTo(11.2, 9);
    expect((await importSvg(checks[0].svg)).warnings).toEqual([]);
  });
});
