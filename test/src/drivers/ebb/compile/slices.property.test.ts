import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { commandLine, compile, DEFAULT_PEN, machineById, plan, stateAt } from "../../../../../src/index.js";
import { MOTION_MODES, PEN_OVERLAPS } from "../../../../../src/internal.js";
import { motor1FromXy, motor2FromXy } from "../../../../../src/machines/motors.js";
import { strokeSetOf, type Point } from "../../../../support/drawings/arbitraries.js";
import { cases } from "../../../../support/runs/full-run.js";

const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });
const machine = machineById("axidraw-v3");

const stroke: fc.Arbitrary<Point[]> = fc
  .array(fc.oneof(fc.tuple(real(0, 60), real(0, 60)), fc.tuple(real(20, 20.5), real(20, 20.5))), {
    minLength: 1,
    maxLength: 8,
  })
  .chain((points) => fc.boolean().map((back) => (back ? [...points, ...[...points].reverse()] : points)));

/** Slow enough for the motors: at most 200 mm/s in any direction. */
const limits = fc.record({
  speedMmPerS: real(10, 200),
  accelMmPerS2: real(100, 3_000),
  cornerMm: real(0.001, 0.5),
  jerkMmPerS3: real(5_000, 100_000),
});

const drawing = fc.record({
  strokes: fc.array(stroke, { minLength: 1, maxLength: 3 }),
  mode: fc.constantFrom(...MOTION_MODES),
  draw: limits,
  travel: limits,
  pen: fc.constantFrom(...PEN_OVERLAPS).map((overlap) => ({ ...DEFAULT_PEN, overlap })),
});

describe("slices of any plan", () => {
  it("stay close to it in place and time, and end on its last step", () => {
    fc.assert(
      fc.property(drawing, ({ strokes, mode, draw, travel, pen }) => {
        const trajectory = plan(strokeSetOf(strokes), { mode, draw, travel, fit: null }, pen);
        const stream = compile(trajectory, { machine, firmware: "2.4.4", pen });
        expect(Math.abs(stream.boardS[stream.count] - trajectory.totalS)).toBeLessThan(0.01);
        let steps1 = 0;
        let steps2 = 0;
        for (let i = 0; i < stream.count; i++) {
          const [name, , n1, n2] = commandLine(stream, i).split(",");
          if (name !== "SM") continue;
          steps1 += Number(n1);
          steps2 += Number(n2);
          expect([stream.steps1[i], stream.steps2[i]]).toEqual([steps1, steps2]);
          const { x, y } = stateAt(trajectory, stream.planS[i + 1]);
          const off = Math.hypot(steps1 - motor1FromXy(machine, x, y), steps2 - motor2FromXy(machine, x, y));
          // A slice may end half of a millisecond early or late, and on the nearest step: at 200 mm/s 0.14 mm.
          expect(off).toBeLessThan(12);
        }
        expect([steps1, steps2]).toEqual([0, 0]);
      }),
      { numRuns: cases(100) },
    );
  });
});
