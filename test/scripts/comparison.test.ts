/** docs/comparison.md: its tables are what the code makes, for a sample (in the full run, for all), and the planner of the NextDraw software. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  COMPARED_LIMITS,
  plannersTable,
  SAMPLE_NAMES,
  sampleDrawing,
  WHOLE_TABLES,
  wholePlotRows,
} from "../../scripts/comparison-tables.js";
import { readPart } from "../../scripts/doc-parts.js";
import { DEFAULT_MOTION, DEFAULT_PEN, machineById, plan } from "../../src/index.js";
import { strokeSetOf } from "../support/drawings/arbitraries.js";
import { referenceRuns } from "../support/reference-planners/motion.js";
import { NEXTDRAW } from "../support/reference-planners/nextdraw.js";
import { cases, IS_FULL } from "../support/runs/full-run.js";
import { distance, type Limits, type Point } from "../support/reference-planners/polyline.js";

const withoutPadding = (text: string): string => text.replace(/ {2,}/g, " ").replace(/-{3,}/g, "---");

describe("docs/comparison.md", () => {
  it.each(IS_FULL ? SAMPLE_NAMES : ["hello-paper"])(
    "has the figures that the code makes for %s; `npm run compare` writes them",
    async (name) => {
      const planners = plannersTable(name, await sampleDrawing(name), COMPARED_LIMITS);
      expect(withoutPadding(readPart("comparison.md", "planners").part)).toContain(withoutPadding(planners));
      const rows = await wholePlotRows(name);
      for (const part of Object.keys(WHOLE_TABLES) as (keyof typeof WHOLE_TABLES)[]) {
        const table = withoutPadding(readPart("comparison.md", part).part);
        expect(table).toContain(`| ${WHOLE_TABLES[part].join(" | ")} |`);
        expect(table).toContain(`| ${rows[part].join(" | ")} |`);
      }
    },
  );
});

describe("the planner of the NextDraw software", () => {
  const LIMITS: Limits = { speed: 55, accel: 500, deviation: 0.05, jerk: 214_000 };

  it("starts from rest along a line with S-curves of its jerk, at most at its speed", () => {
    const { timeS, pieces } = NEXTDRAW.plan(
      [
        [0, 0],
        [100, 0],
      ],
      LIMITS,
    );
    const rampS = 2 * Math.sqrt(55 / 214_000);
    expect(timeS).toBeCloseTo(100 / 55 + rampS, 9);
    expect(pieces).toBe(3);
  });

  it.each([
    [0, 44],
    [30, 55 * Math.cos(Math.PI / 6) ** 4],
    [60, 55 * Math.cos(Math.PI / 3) ** 4],
    [90, 0],
    [150, 0],
  ])("passes a turn of %s° after full speed at %s mm/s", (degrees, speed) => {
    const turn = (degrees * Math.PI) / 180;
    const points: Point[] = [
      [0, 0],
      [50, 0],
      [50 + 50 * Math.cos(turn), 50 * Math.sin(turn)],
    ];
    expect(NEXTDRAW.plan(points, LIMITS).speeds[1]).toBeCloseTo(speed, 6);
  });

  it("passes a turn at less than a quarter of its speed without slowing down", () => {
    const { speeds } = NEXTDRAW.plan(
      [
        [0, 0],
        [0.05, 0],
        [0.05, 20],
      ],
      LIMITS,
    );
    // 8.1 mm/s, after 12 ms.
    expect(speeds[1]).toBeCloseTo((0.05 * Math.sqrt(214_000)) ** (2 / 3), 6);
  });

  it("takes at least 7 ms for a segment between two others", () => {
    const points = Array.from({ length: 200 }, (_, i): Point => [i * 0.1, 0]);
    const { speeds } = NEXTDRAW.plan(points, LIMITS);
    for (let i = 1; i < speeds.length; i++)
      expect((speeds[i - 1] + speeds[i]) / 2).toBeLessThan(0.1 / 0.007 + 1e-6);
  });

  const point = fc.tuple(fc.integer({ min: 0, max: 400 }), fc.integer({ min: 0, max: 400 }));
  it("moves without a gap from point to point, within speed and time of its plan", () => {
    fc.assert(
      fc.property(fc.uniqueArray(point, { minLength: 2, maxLength: 12, selector: String }), (corners) => {
        const points = corners.map(([x, y]): Point => [x / 4, y / 4]);
        const strokes = strokeSetOf([points]);
        const draw = { ...DEFAULT_MOTION.draw, speedMmPerS: 55, jerkMmPerS3: 214_000 };
        const t = plan(strokes, { ...DEFAULT_MOTION, mode: "scurve", draw }, DEFAULT_PEN, {
          machine: machineById("axidraw-v3"),
          runs: referenceRuns(NEXTDRAW),
        });
        const run = t.runs.stroke.indexOf(0);
        const [first, end] = [t.runs.firstBlock[run], t.runs.firstBlock[run + 1]];
        let drawnS = 0;
        for (let k = first; k < end; k++) {
          const d = t.durationS[k];
          const [jx, jy] = [t.jx?.[k] ?? 0, t.jy?.[k] ?? 0];
          const x = t.x[k] + d * (t.vx[k] + d * (t.ax[k] / 2 + (d * jx) / 6));
          const y = t.y[k] + d * (t.vy[k] + d * (t.ay[k] / 2 + (d * jy) / 6));
          const next = k + 1 < end ? [t.x[k + 1], t.y[k + 1]] : points[points.length - 1];
          expect(distance([x, y], [next[0], next[1]])).toBeLessThan(1e-6);
          expect(Math.hypot(t.vx[k], t.vy[k])).toBeLessThan(55 + 1e-6);
          drawnS += d;
        }
        expect(drawnS).toBeCloseTo(NEXTDRAW.plan(points, LIMITS).timeS, 6);
      }),
      { numRuns: cases(500, 50) },
    );
  });
});
