import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PEN, machineById, MACHINES, type MachineProfile } from "../../../src/index.js";
import { dropTime, liftTime, timedPen } from "../../../src/internal.js";
import { BRUSHLESS_LIFT, penServoOf, servoTime } from "../../../src/machines/pen-servo.js";

/** Times of a lift and a drop between two heights, ms. */
const timesOf = (machine: MachineProfile, pen: object): number[] => {
  const timed = timedPen({ ...DEFAULT_PEN, ...pen }, machine);
  return [liftTime(timed, timed.upPct), dropTime(timed, timed.upPct)].map((s) => Math.round(1_000 * s));
};

/** A machine whose servo has another range. */
function withRange(id: string, servoPosAt0Pct: number, servoPosAt100Pct: number): MachineProfile {
  const machine = machineById(id);
  return { ...machine, controller: { ...machine.controller, servoPosAt0Pct, servoPosAt100Pct } };
}

describe("the time of a pen's servo", () => {
  it("is that of the makers' software for AxiDraw and NextDraw, whose range of an AxiDraw's servo is narrower", () => {
    expect(timesOf(withRange("axidraw-v3", 9_855, 27_831), { upPct: 60, downPct: 30 })).toEqual([131, 146]);
    expect(timesOf(machineById("axidraw-v3"), { upPct: 60, downPct: 30 })).toEqual([141, 154]);
    expect(timesOf(machineById("nextdraw-8511"), { upPct: 50, downPct: 30 })).toEqual([46, 47]);
    expect(timesOf(machineById("axidraw-v3-brushless"), { upPct: 50, downPct: 30 })).toEqual([46, 47]);
  });

  it("depends on the servo's angle and the signal's rate, whatever range a profile has", () => {
    const pos = fc.integer({ min: 1, max: 65_535 });
    const pct = fc.double({ min: 1, max: 100, noNaN: true });
    fc.assert(
      fc.property(pos, pos, pct, fc.constantFrom("axidraw-v3", "nextdraw-8511"), (from, to, distance, id) => {
        fc.pre(from !== to);
        const units = (distance / 100) * Math.abs(to - from);
        // The makers' figures: a least time, and a time for each of their percents.
        const servoMs = id === "axidraw-v3" ? 45 + 2.69 * (units / 179.76) : 20 + 1.28 * (units / 72);
        const signalMs = (1_000 * distance) / 300;
        const ms = 1_000 * servoTime(penServoOf(withRange(id, from, to)), distance, 300);
        expect(ms).toBeCloseTo(Math.hypot(servoMs ** 2, signalMs ** 2) ** 0.5, 6);
      }),
    );
  });

  it("of hobby servos is what their machines always waited", () => {
    for (const machine of ["eggbot", "watercolorbot"]) {
      const [liftMs, dropMs] = timesOf(machineById(machine), { upPct: 60, downPct: 30 });
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
    expect(penServoOf(nextdraw)).toEqual(BRUSHLESS_LIFT);
    const own = { ...BRUSHLESS_LIFT, minMs: 90 };
    expect(penServoOf({ ...nextdraw, penServo: own })).toBe(own);
    expect(penServoOf(null).frameMs).toBe(24);
  });
});
