import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { MACHINES, machineById } from "../../../src/index.js";
import { ebbOf } from "../../../src/drivers/ebb/protocol/ebb-controller.js";
import { checkMachine } from "../../../src/drivers/registry.js";
import {
  motor1FromXy,
  motor2FromXy,
  pctFromServoPos,
  servoPosFromPct,
  xFromMotors,
  yFromMotors,
} from "../../../src/internal.js";

const flips = fc.record({ flipX: fc.boolean(), flipY: fc.boolean(), swapAxes: fc.boolean() });
const mm = fc.double({ min: -1_000, max: 1_000, noNaN: true });

describe("machine profiles", () => {
  it("have unique ids, and fields and servo ranges that the board supports", () => {
    expect(new Set(MACHINES.map((machine) => machine.id)).size).toBe(MACHINES.length);
    for (const machine of MACHINES) {
      checkMachine(machine);
      const { servoPosAt0Pct, servoPosAt100Pct } = ebbOf(machine);
      expect(servoPosAt100Pct).toBeGreaterThan(servoPosAt0Pct);
    }
  });

  it("are found by id; an unknown id is answered with the known ones", () => {
    expect(machineById("axidraw-v3").stepsPerMm).toBe(80);
    expect(() => machineById("axidraw-v9")).toThrow(/axidraw-v3, /);
  });
});

describe("motor axes", () => {
  it("map back to the same position on every machine, however it is wired", () => {
    fc.assert(
      fc.property(fc.constantFrom(...MACHINES), flips, mm, mm, (model, wiring, x, y) => {
        const machine = { ...model, ...wiring };
        const m1 = motor1FromXy(machine, x, y);
        const m2 = motor2FromXy(machine, x, y);
        expect(xFromMotors(machine, m1, m2)).toBeCloseTo(x, 9);
        expect(yFromMotors(machine, m1, m2)).toBeCloseTo(y, 9);
      }),
    );
  });

  it("both turn for a move along x or y on a mixed machine, one for a diagonal", () => {
    const machine = machineById("axidraw-v3");
    expect([motor1FromXy(machine, 1, 0), motor2FromXy(machine, 1, 0)]).toEqual([80, 80]);
    expect([motor1FromXy(machine, 0, 1), motor2FromXy(machine, 0, 1)]).toEqual([80, -80]);
    expect([motor1FromXy(machine, 1, 1), motor2FromXy(machine, 1, 1)]).toEqual([160, 0]);
  });
});

describe("pen heights", () => {
  it("map to the machine's servo range and back, and stay within it", () => {
    const machine = machineById("axidraw-v3");
    expect(servoPosFromPct(machine, 0)).toBe(7_500);
    expect(servoPosFromPct(machine, 100)).toBe(28_000);
    expect(servoPosFromPct(machine, 140)).toBe(28_000);
    expect(pctFromServoPos(machine, servoPosFromPct(machine, 42))).toBeCloseTo(42, 2);
    expect(() => servoPosFromPct(machine, NaN)).toThrow(RangeError);
  });
});
