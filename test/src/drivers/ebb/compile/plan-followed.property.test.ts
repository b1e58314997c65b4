import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  commandLine,
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  plan,
  stateAt,
  type CommandStream,
  type Trajectory,
} from "../../../../../src/index.js";
import { firmwareFeatures } from "../../../../../src/drivers/ebb/protocol/firmware.js";
import { MOTION_MODES, PEN_OVERLAPS } from "../../../../../src/internal.js";
import { motor1FromXy, motor2FromXy } from "../../../../../src/machines/motors.js";
import { RAD_PER_DEG } from "../../../../../src/units.js";
import { strokeSetOf, type Point } from "../../../../support/drawings/arbitraries.js";
import { execute } from "../../../../support/plots/virtual-plots.js";
import { swinging } from "../../../../support/machines/swinging.js";
import { cases } from "../../../../support/runs/full-run.js";

const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });
const machine = swinging({ xHz: 15, yHz: 25, damping: 0.1 });

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
  motion: fc.constantFrom(...MOTION_MODES.map((mode) => ({ mode })), {
    mode: "blend",
    shaper: "zv",
  } as const),
  draw: limits,
  travel: limits,
  pen: fc.constantFrom(...PEN_OVERLAPS).map((overlap) => ({ ...DEFAULT_PEN, overlap })),
});

/** Where the motors are farthest from the plan, in steps, and the command there. The commands' steps are checked too. */
function farthest(
  trajectory: Trajectory,
  stream: CommandStream,
  firmware: string,
): { off: number; line: string } {
  const features = firmwareFeatures(firmware);
  let most = { off: 0, line: "" };
  let [steps1, steps2, acc1, acc2] = [0, 0, 0, 0];
  for (let i = 0; i < stream.count; i++) {
    const line = commandLine(stream, i);
    if (!/^(SM|LM|LT|T3)/.test(line)) continue;
    const move = execute(line, features, acc1, acc2);
    const made = (share: number): readonly [number, number] => {
      if (move === null) return [0, 0];
      const tick = Math.round(share * move.ticks);
      return [move.motion1.stateAfterTicks(tick).net, move.motion2.stateAfterTicks(tick).net];
    };
    for (const share of [0.25, 0.5, 0.75, 1]) {
      const [made1, made2] = made(share);
      const { x, y } = stateAt(trajectory, stream.planS[i] + share * (stream.planS[i + 1] - stream.planS[i]));
      const off = Math.hypot(
        steps1 + made1 - motor1FromXy(machine, x, y),
        steps2 + made2 - motor2FromXy(machine, x, y),
      );
      if (off > most.off) most = { off, line };
    }
    const [made1, made2] = made(1);
    [steps1, steps2] = [steps1 + made1, steps2 + made2];
    if (steps1 !== stream.steps1[i] || steps2 !== stream.steps2[i]) return { off: Infinity, line };
    [acc1, acc2] = [stream.acc1[i], stream.acc2[i]];
  }
  return most;
}

/** How far the motors may be from the plan at any moment, steps. Slices have one speed each, and LM makes whole steps. */
describe.each([
  { firmware: "2.4.4", maxSteps: 12 },
  { firmware: "2.5.3", maxSteps: 12 },
  { firmware: "2.8.1", maxSteps: 2.5 },
  { firmware: "3.0.3", maxSteps: 2.5 },
])("the commands for any plan on firmware $firmware", ({ firmware, maxSteps }) => {
  it("stay close to it at any moment, and end on its last step when it does", () => {
    fc.assert(
      fc.property(drawing, ({ strokes, motion, draw, travel, pen }) => {
        const settings = { ...motion, draw, travel, fit: null };
        const trajectory = plan(strokeSetOf(strokes), settings, pen, { machine });
        const stream = compile(trajectory, { machine, firmware, pen });
        expect(Math.abs(stream.boardS[stream.count] - trajectory.totalS)).toBeLessThan(0.01);
        const { off, line } = farthest(trajectory, stream, firmware);
        expect(off, line).toBeLessThan(maxSteps);
        expect([stream.steps1.at(-1), stream.steps2.at(-1)]).toEqual([0, 0]);
      }),
      { numRuns: cases(500, 40), endOnFailure: true },
    );
  });
});

it("the commands of a shaped plot follow a long straight to its end if a motor reverses right after it", () => {
  const draw = { ...DEFAULT_MOTION.draw, speedMmPerS: 20, accelMmPerS2: 3_500 };
  const motion = { ...DEFAULT_MOTION, mode: "blend", shaper: "zv", draw } as const;
  for (let deg = 20; deg < 75; deg++) {
    const x = 60 * Math.cos(deg * RAD_PER_DEG);
    const y = 60 * Math.sin(deg * RAD_PER_DEG);
    const corner: Point[] = [
      [20 + x, 20],
      [20, 20 + y],
      [20, 30 + y],
    ];
    const trajectory = plan(strokeSetOf([corner]), motion, DEFAULT_PEN, { machine });
    const stream = compile(trajectory, { machine, firmware: "2.8.1", pen: DEFAULT_PEN });
    const { off, line } = farthest(trajectory, stream, "2.8.1");
    expect([deg, line, off < 2.5]).toEqual([deg, line, true]);
  }
});
