import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { AxisMotion, registersFor } from "../../../../../src/drivers/ebb/model/accumulator.js";
import type { TickArithmetic } from "../../../../../src/drivers/ebb/protocol/firmware.js";
import { cases } from "../../../../support/runs/full-run.js";

interface Counted {
  ticks: number;
  net: number;
  made: number;
  acc: number;
  history: { net: number; acc: number }[];
}

/** The interrupt as the firmware writes it, one tick at a time, in 32-bit integers. */
function countTicks(
  arithmetic: TickArithmetic,
  rate: number,
  accel: number,
  jerk: number,
  acc: number,
  stepLimit: number,
  tickLimit: number,
): Counted {
  const history = [{ net: 0, acc }];
  let r = 0;
  let a = accel;
  if (arithmetic === "signed") {
    r = (rate - Math.trunc(accel / 2) + Math.trunc(jerk / 6)) | 0;
    a = (accel - jerk) | 0;
  } else {
    r = Math.abs(rate) - (arithmetic === "late" ? accel : Math.trunc(accel / 2));
  }
  let net = 0;
  let made = 0;
  let ticks = 0;
  while (ticks < tickLimit && made < stepLimit) {
    ticks++;
    if (arithmetic === "signed") {
      a = (a + jerk) | 0;
      r = (r + a) | 0;
    } else {
      r = Number(BigInt.asUintN(31, BigInt(r) + BigInt(a)));
    }
    const sum = (acc + r) >>> 0;
    if (sum >= 2 ** 31) {
      acc = sum - 2 ** 31;
      made++;
      net += arithmetic === "signed" ? (r < 0 ? -1 : 1) : rate < 0 ? -1 : 1;
    } else acc = sum;
    history.push({ net, acc });
  }
  return { ticks, net, made, acc, history };
}

const int = (limit: number) => fc.integer({ min: -limit, max: limit });
const gentle = fc.record({
  rate: int(1.5e9),
  accel: int(200_000),
  jerk: int(60),
  acc: fc.nat(2 ** 31 - 1),
  ticks: fc.integer({ min: 1, max: 3_000 }),
});
const wild = fc.record({
  rate: int(2 ** 31 - 1),
  accel: int(2 ** 31 - 1),
  jerk: int(2 ** 31 - 1),
  acc: fc.nat(2 ** 31 - 1),
  ticks: fc.integer({ min: 1, max: 300 }),
});

describe("the closed form of the accumulator", () => {
  for (const arithmetic of ["late", "half", "signed"] as const) {
    it(`equals the interrupt counted tick by tick (${arithmetic})`, () => {
      fc.assert(
        fc.property(fc.oneof(gentle, wild), ({ rate, accel, jerk, acc, ticks }) => {
          const j = arithmetic === "signed" ? jerk : 0;
          const motion = new AxisMotion(
            arithmetic,
            registersFor(arithmetic, rate, accel, j),
            acc,
            Infinity,
            ticks,
          );
          const counted = countTicks(arithmetic, rate, accel, j, acc, Infinity, ticks);
          expect([motion.net, motion.stepsMadeAfter(ticks), motion.acc]).toEqual([
            counted.net,
            counted.made,
            counted.acc,
          ]);
          for (const tick of [0, 1, ticks >> 1, ticks]) {
            expect(motion.stateAfterTicks(tick)).toEqual(counted.history[tick]);
          }
        }),
        { numRuns: cases() },
      );
    });

    it(`stops a step-limited motor at the same tick as the interrupt (${arithmetic})`, () => {
      fc.assert(
        fc.property(fc.oneof(gentle, wild), fc.integer({ min: 1, max: 400 }), (command, limit) => {
          const j = arithmetic === "signed" ? command.jerk : 0;
          const counted = countTicks(arithmetic, command.rate, command.accel, j, command.acc, limit, 20_000);
          fc.pre(counted.made === limit);
          const registers = registersFor(arithmetic, command.rate, command.accel, j);
          const motion = new AxisMotion(arithmetic, registers, command.acc, limit, Infinity);
          expect([motion.ticks, motion.net, motion.acc]).toEqual([counted.ticks, counted.net, counted.acc]);
        }),
        { numRuns: cases() },
      );
    });
  }

  it("never ends for a motor with steps to make and no rate", () => {
    const motion = new AxisMotion("signed", registersFor("signed", 0, 0), 5, 10, Infinity);
    expect(motion.ticks).toBe(Infinity);
    expect(motion.stateAfterTicks(1e9)).toEqual({ net: 0, acc: 5 });
  });
});
