/** What the command for a leg does to the motors, by the model of the firmware. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  MAX_TICKS,
  type Leg,
  type LegWriter,
  type MotorLeg,
  type MotorState,
} from "../../../../../src/drivers/ebb/compile/leg.js";
import { SignedWriter } from "../../../../../src/drivers/ebb/compile/write-signed.js";
import { SteppedWriter } from "../../../../../src/drivers/ebb/compile/write-stepped.js";
import { TimedWriter } from "../../../../../src/drivers/ebb/compile/write-timed.js";
import { firmwareFeatures, type FirmwareFeatures } from "../../../../../src/drivers/ebb/protocol/firmware.js";
import {
  ACCUMULATOR_RANGE,
  rateFromStepsPerS,
  stepsPerSFromRate,
  TICKS_PER_S,
} from "../../../../../src/units.js";
import { execute } from "../../../../support/plots/virtual-plots.js";
import { cases } from "../../../../support/runs/full-run.js";

const RUNS = { numRuns: cases(500) };
const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });

interface Generation {
  readonly features: FirmwareFeatures;
  readonly writer: LegWriter;
  /** Whether the accumulator counts in the direction of travel, or always forwards. LM ends with almost nothing in it. */
  readonly counts: "nothing" | "travel" | "forwards";
}

const [stepped, timed, signed] = ["2.5.3", "2.8.1", "3.0.3"].map((version) => firmwareFeatures(version));
const GENERATIONS: readonly Generation[] = [
  { features: stepped, writer: new SteppedWriter(stepped), counts: "nothing" },
  { features: timed, writer: new TimedWriter(), counts: "travel" },
  { features: signed, writer: new SignedWriter(signed), counts: "forwards" },
];

/** The state of a motor at `p` that travels in `direction`. A step is due when the accumulator is full. */
function stateAt({ counts }: Generation, p: number, direction: number): MotorState {
  // No −0.
  const steps = 0 + Math.round(p);
  const sign = counts === "travel" ? direction : 1;
  const share = counts === "nothing" ? 0.001 : 0.5 + sign * (p - steps);
  return { steps, acc: Math.floor(share * (ACCUMULATOR_RANGE - 1)) };
}

/** The position of a motor that has travelled in `direction`. */
function positionOf({ counts }: Generation, { steps, acc }: MotorState, direction: number): number {
  if (counts === "nothing") return steps;
  return steps + (counts === "travel" ? direction : 1) * (acc / ACCUMULATOR_RANGE - 0.5);
}

const directionOf = ({ p0, p1 }: MotorLeg): number => (p1 < p0 ? -1 : 1);

/** A motor's part of a leg, speeds in steps/s. `bend`: steps beyond what a constant acceleration travels. */
interface Motor {
  readonly p0: number;
  readonly v0: number;
  readonly v1: number;
  readonly bend: number;
}

const motorLeg = ({ p0, v0, v1, bend }: Motor, ticks: number): MotorLeg => ({
  p0,
  p1: p0 + ((v0 + v1) / 2 / TICKS_PER_S) * ticks + bend,
  v0: rateFromStepsPerS(v0),
  v1: rateFromStepsPerS(v1),
});

/** Writes the command for a leg from a state `off` steps from its start, and executes it. */
function drive(
  generation: Generation,
  ticks: number,
  motors: readonly [Motor, Motor],
  off = 0,
  isLast = false,
) {
  const [m1, m2] = motors.map((motor) => motorLeg(motor, ticks));
  const [before1, before2] = [m1, m2].map((leg) => stateAt(generation, leg.p0 + off, directionOf(leg)));
  const [after1, after2] = [{ ...before1 }, { ...before2 }];
  const leg: Leg = { ticks, m1, m2, isParabola: motors.every(({ bend }) => bend === 0), isLast };
  const command = generation.writer.commandFor(leg, after1, after2);
  if (command === null) return null;
  const move = execute(command.line, generation.features, before1.acc, before2.acc)!;
  return {
    leg,
    command,
    move,
    motors: [
      { plan: m1, before: before1, after: after1, motion: move.motion1, bend: motors[0].bend },
      { plan: m2, before: before2, after: after2, motion: move.motion2, bend: motors[1].bend },
    ],
  };
}

const duration = fc.integer({ min: 250, max: MAX_TICKS });
const start = real(-20_000, 20_000);
const still: fc.Arbitrary<Motor> = fc.record({
  p0: start,
  v0: fc.constant(0),
  v1: fc.constant(0),
  bend: fc.constant(0),
});

/** Motors that keep their direction; `slowest` in steps/s. */
const moving = (slowest: number): fc.Arbitrary<Motor> =>
  fc
    .record({ p0: start, v0: real(slowest, 20_000), v1: real(slowest, 20_000), isBack: fc.boolean() })
    .map(({ p0, v0, v1, isBack }) => ({ p0, v0: isBack ? -v0 : v0, v1: isBack ? -v1 : v1, bend: 0 }));

/** Only firmware 3 can reverse a motor within a command, or bend its speed. */
const any: fc.Arbitrary<Motor> = fc.record({
  p0: start,
  v0: real(-15_000, 15_000),
  v1: real(-15_000, 15_000),
  bend: real(-10, 10),
});

describe.each(GENERATIONS)("the command for a leg on firmware $features.version", (generation) => {
  const { arithmetic } = generation.features;
  const motor = arithmetic === "signed" ? fc.oneof(any, still, moving(0)) : fc.oneof(still, moving(0));
  /** A motor whose speed LM and LT can follow exactly. */
  const steady = arithmetic === "signed" ? fc.oneof(any, moving(400)) : moving(400);

  it("takes as long and leaves the motors in the state that was predicted, near the leg's end", () => {
    fc.assert(
      fc.property(
        duration,
        fc.tuple(motor, motor),
        real(-0.3, 0.3),
        fc.boolean(),
        (ticks, motors, off, isLast) => {
          const driven = drive(generation, ticks, motors, off, isLast);
          if (driven === null) {
            for (const { v0, v1 } of motors) expect(Math.abs(v0 + v1) * ticks).toBeLessThan(2 * TICKS_PER_S);
            return;
          }
          expect(driven.move.ticks).toBe(driven.command.ticks);
          expect(driven.command.ticks).toBeLessThanOrEqual(ticks);
          for (const { plan, before, after, motion } of driven.motors) {
            expect([after.steps, after.acc]).toEqual([before.steps + motion.net, motion.acc]);
            expect(Math.abs(after.steps - plan.p1)).toBeLessThan(1.01);
          }
        },
      ),
      RUNS,
    );
  });

  it("begins and ends at the plan's speeds", () => {
    fc.assert(
      fc.property(duration, fc.tuple(steady, steady), real(-0.3, 0.3), (ticks, motors, off) => {
        const { leg, motors: driven } = drive(generation, ticks, motors, off)!;
        for (const { plan, motion, bend } of driven) {
          const last = motion.ticks;
          const stretch = arithmetic === "signed" ? leg.ticks / last : 1;
          const [v0, v1] = [plan.v0, plan.v1].map((rate) => stretch * stepsPerSFromRate(rate));
          // The change of speed within a tick; the correction of the start; a step more or less by LM.
          const perTick = Math.abs(v1 - v0) / last + (6 * Math.abs(bend) * TICKS_PER_S) / last ** 2;
          const tolerance = perTick + 13 + (arithmetic === "late" ? (1.6 * TICKS_PER_S) / last : 0);
          expect(Math.abs(stepsPerSFromRate(motion.rateDuring(1)) - v0)).toBeLessThan(tolerance);
          expect(Math.abs(stepsPerSFromRate(motion.rateDuring(last)) - v1)).toBeLessThan(tolerance);
        }
      }),
      RUNS,
    );
  });

  it("ends the plan at its exact end", () => {
    fc.assert(
      fc.property(duration, fc.tuple(steady, steady), real(-0.3, 0.3), (ticks, motors, off) => {
        for (const { plan, after } of drive(generation, ticks, motors, off, true)!.motors) {
          const end = positionOf(generation, after, directionOf(plan));
          expect(Math.abs(end - plan.p1)).toBeLessThan(generation.counts === "nothing" ? 0.51 : 0.02);
        }
      }),
      RUNS,
    );
  });

  it("corrects at most 12 steps/s of an error, so that the line shows no kink", () => {
    fc.assert(
      fc.property(duration, fc.tuple(steady, steady), fc.constantFrom(-0.3, 0.3), (ticks, motors, off) => {
        if (arithmetic === "late") return;
        const wrong = drive(generation, ticks, motors, off)!;
        const exact = drive(generation, ticks, motors, 0)!;
        wrong.motors.forEach(({ motion }, i) => {
          const change = stepsPerSFromRate(motion.rateDuring(1) - exact.motors[i].motion.rateDuring(1));
          expect(Math.abs(change)).toBeLessThan(12.1);
          // It leads back to the plan. LT may clear the accumulators instead, so that the motor is on the other side.
          if (generation.counts === "travel" && wrong.command.line.split(",").length > 6) return;
          expect(change * off).toBeLessThanOrEqual(0);
        });
      }),
      RUNS,
    );
  });
});
