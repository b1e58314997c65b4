import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, machineById, MACHINES } from "../../../src/index.js";
import { dropTime, liftTime, timedPen } from "../../../src/internal.js";
import { BRUSHLESS_LIFT, penServoOf, servoTime } from "../../../src/machines/pen-servo.js";

/** Times of a lift and a drop between two heights, ms. */
const timesOf = (machine: string, pen: object): number[] => {
  const timed = timedPen({ ...DEFAULT_PEN, ...pen }, machineById(machine));
  return [liftTime(timed, timed.upPct), dropTime(timed, timed.upPct)].map((s) => Math.round(1_000 * s));
};

describe("the time of a pen's servo", () => {
  it("is that of the makers' software for AxiDraw and NextDraw", () => {
    expect(timesOf("axidraw-v3", { upPct: 60, downPct: 30 })).toEqual([131, 146]);
    expect(timesOf("nextdraw-8511", { upPct: 50, downPct: 30 })).toEqual([46, 47]);
    expect(timesOf("axidraw-v3-brushless", { upPct: 50, downPct: 30 })).toEqual([46, 47]);
  });

  it("of hobby servos is what their machines always waited", () => {
    for (const machine of ["eggbot", "watercolorbot"]) {
      const [liftMs, dropMs] = timesOf(machine, { upPct: 60, downPct: 30 });
      expect(Math.abs(liftMs - 250)).toBeLessThanOrEqual(3);
      expect(Math.abs(dropMs - 300)).toBeLessThanOrEqual(3);
    }
  });

  it("grows with the distance, and is the signal's at a low rate", () => {
    for (const machine of MACHINES) {
      const servo = penServoOf(machine);
      expect(servoTime(servo, 0, servo.liftPctPerS)).toBe(0);
      for (let pct = 1; pct < 100; pct++) {
        expect(servoTime(servo, pct + 1, 300)).toBeGreaterThan(servoTime(servo, pct, 300));
      }
      expect(servoTime(servo, 40, 10)).toBeCloseTo(4, 2);
    }
  });

  it("is taken from the profile if it describes its servo, and else from its servo output", () => {
    const nextdraw = machineById("nextdraw-8511");
    expect(penServoOf(nextdraw)).toBe(BRUSHLESS_LIFT);
    const own = { ...BRUSHLESS_LIFT, minMs: 90 };
    expect(penServoOf({ ...nextdraw, penServo: own })).toBe(own);
    expect(penServoOf(null).frameMs).toBe(24);
  });
});
