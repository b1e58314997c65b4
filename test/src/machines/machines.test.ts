import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { MACHINES, machineById, type MachineProfile } from "../../../src/index.js";
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
const NOT_WIRED = { flipX: false, flipY: false, swapAxes: false };
const mm = fc.double({ min: -1_000, max: 1_000, noNaN: true });

describe("machine profiles", () => {
  it("have unique ids, and fields and servo ranges that the board supports", () => {
    expect(new Set(MACHINES.map((machine) => machine.id)).size).toBe(MACHINES.length);
    for (const machine of MACHINES) {
      checkMachine(machine);
      if (machine.controller.kind !== "ebb") continue;
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

  /** Steps of both motors for 10 mm along x, then along y; + 0 turns -0 into 0. */
  const moves = (machine: MachineProfile): number[][] =>
    [[10, 0], [0, 10]].map(([x, y]) => [motor1FromXy(machine, x, y) + 0, motor2FromXy(machine, x, y) + 0]); // prettier-ignore

  it.each(MACHINES)("turn in these directions on $id", (machine) => {
    // As its maker's software counts.
    if (machine.id.startsWith("idraw")) return expect(moves(machine)).toEqual([[0, -1_000], [-1_000, 0]]); // prettier-ignore
    if (machine.controller.kind === "grbl") return expect(moves(machine)).toEqual([[800, 0], [0, 800]]); // prettier-ignore
    const direct = ["eggbot", "watercolorbot"].includes(machine.id);
    const steps = machine.id === "eggbot" ? 10 * (3_200 / (40 * Math.PI)) : 800;
    expect(moves(machine)).toEqual(direct ? [[steps, 0], [0, steps]] : [[steps, steps], [steps, -steps]]); // prettier-ignore
  });

  // prettier-ignore
  const WIRINGS: readonly (readonly [keyof typeof NOT_WIRED | "all", "mixed" | "direct", number[], number[]])[] = [
    ["flipX",    "mixed",  [-800, -800], [800, -800]],
    ["flipY",    "mixed",  [800, 800],   [-800, 800]],
    ["swapAxes", "mixed",  [800, -800],  [800, 800]],
    ["all",      "mixed",  [-800, 800],  [-800, -800]],
    ["flipX",    "direct", [-800, 0],    [0, 800]],
    ["flipY",    "direct", [800, 0],     [0, -800]],
    ["swapAxes", "direct", [0, 800],     [800, 0]],
    ["all",      "direct", [0, -800],    [-800, 0]],
  ];
  it.each(WIRINGS)("turn in these directions with %s on a %s machine", (wired, motors, alongX, alongY) => {
    const flags = wired === "all" ? { flipX: true, flipY: true, swapAxes: true } : { [wired]: true };
    const machine = { ...machineById("axidraw-v3"), motors, ...NOT_WIRED, ...flags };
    expect(moves(machine)).toEqual([alongX, alongY]);
  });

  it("flip x before they are swapped", () => {
    const machine = { ...machineById("axidraw-v3"), flipX: true, swapAxes: true };
    expect(moves(machine)).toEqual([[-800, 800], [800, 800]]); // prettier-ignore
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
