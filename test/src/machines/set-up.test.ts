import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { machineNamed } from "../../../src/internal.js";
import { MACHINES, machineById, type MachineProfile } from "../../../src/index.js";
import {
  controllerOf,
  DIRECTIONS,
  findMachine,
  machineOf,
  machineTurned,
  motor1FromXy,
  motor2FromXy,
  scaleMeasured,
  stepsPerMmMeasured,
  xFromMotors,
  yFromMotors,
  type Direction,
} from "../../../src/internal.js";
import { cases } from "../../support/runs/full-run.js";

const machines = fc
  .tuple(fc.constantFrom(...MACHINES), fc.boolean(), fc.boolean(), fc.boolean())
  .map(([machine, flipX, flipY, swapAxes]): MachineProfile => ({ ...machine, flipX, flipY, swapAxes }));

const VECTORS: Readonly<Record<Direction, readonly [number, number]>> = {
  right: [1, 0],
  left: [-1, 0],
  down: [0, 1],
  up: [0, -1],
};
const directionOf = (x: number, y: number): Direction =>
  DIRECTIONS.find((one) => Math.abs(VECTORS[one][0] - x) + Math.abs(VECTORS[one][1] - y) < 1e-6)!;

describe("a machine corrected by its observed directions", () => {
  it("moves right and down for any wiring and profile", () => {
    fc.assert(
      fc.property(machines, machines, (wiring, told) => {
        // What the carriage does when the profile `like` drives motors that are wired as `wiring` says.
        const seen = (like: MachineProfile, x: number, y: number): Direction => {
          const real = { ...wiring, motors: like.motors, stepsPerMm: like.stepsPerMm };
          const steps = [motor1FromXy(like, x, y), motor2FromXy(like, x, y)] as const;
          return directionOf(xFromMotors(real, ...steps), yFromMotors(real, ...steps));
        };
        const turned = machineTurned(told, seen(told, 1, 0), seen(told, 0, 1));
        expect([seen(turned, 1, 0), seen(turned, 0, 1)]).toEqual(["right", "down"]);
      }),
      { numRuns: cases() },
    );
  });

  it.each([
    ["right", "left"],
    ["right", "right"],
    ["up", "down"],
    ["down", "down"],
  ] as const)("cannot be made from a move %s and one %s: a motor does not turn", (xWent, yWent) => {
    const turned = () => machineTurned(machineById("axidraw-v3"), xWent, yWent);
    expect(turned).toThrow(/one motor does not turn/);
  });
});

describe("the steps for one mm", () => {
  it("make the square the right size when it is drawn again", () => {
    fc.assert(
      fc.property(machines, fc.double({ min: 0.2, max: 5, noNaN: true }), (machine, share) => {
        const stepsPerMm = stepsPerMmMeasured(machine, 100, 100 * share);
        // The same motors, which really made `machine.stepsPerMm / share` steps per mm.
        const realStepsPerMm = machine.stepsPerMm / share;
        expect((100 * stepsPerMm) / realStepsPerMm).toBeCloseTo(100, 9);
      }),
      { numRuns: cases() },
    );
  });

  it("are the mean of both sides, and a misreading of the ruler is refused", () => {
    const machine = machineById("axidraw-v3");
    expect(stepsPerMmMeasured(machine, 50, 49, 51)).toBeCloseTo(80, 9);
    for (const [x, y] of [
      [0, 50],
      [-50, 50],
      [-50, -50],
      [2, 2],
      [NaN, 50],
      [50, 5],
      [50_000, 50_000],
    ] as const) {
      expect(() => stepsPerMmMeasured(machine, 50, x, y)).toThrow(/measure it again/);
    }
  });
});

describe("the scale of a machine whose controller counts the steps", () => {
  it("is that of its own axes, which may be exchanged", () => {
    expect(scaleMeasured(machineById("grbl-servo"), 100, 90, 100)).toEqual([100 / 90, 1]);
    expect(scaleMeasured(machineById("idraw-h-a4"), 100, 90, 100)).toEqual([1, 100 / 90]);
    expect(() => scaleMeasured(machineById("grbl-servo"), 100, 20, 100)).toThrow(/measure it again/);
  });

  it("is a setting of a Grbl for each axis, and none of a board that is told steps", () => {
    expect(controllerOf(machineById("grbl-servo")).scaleSettings).toEqual(["$100", "$101"]);
    expect(controllerOf(machineById("axidraw-v3")).scaleSettings).toBeUndefined();
  });
});

describe("the machine of a job's settings", () => {
  const own: MachineProfile = { ...machineById("axidraw-v3"), id: "mine", widthMm: 500 };

  it("is the profile stored in them if it is the named one, otherwise the known one", () => {
    expect(machineOf({ machine: "mine", customMachine: own })).toBe(own);
    expect(machineOf({ machine: "axidraw-v3", customMachine: own }).widthMm).toBe(300);
    expect(machineOf({ machine: "axidraw-v3" }).id).toBe("axidraw-v3");
  });

  it("is reported by name if it is unknown", () => {
    expect(() => machineOf({ machine: "mine" })).toThrow(/no machine "mine"/);
    expect(findMachine({ machine: "mine" })).toBeNull();
  });
});

describe("the name of a board", () => {
  it.each([
    ["NextDraw 8511", "nextdraw-8511"],
    ["my nextdraw-1117", "nextdraw-1117"],
    ["AxiDraw V3/A3", "axidraw-v3-a3"],
    ["axidraw v3", "axidraw-v3"],
    ["Studio WaterColorBot 2", "watercolorbot"],
    ["NextDraw", null],
    ["east wall", null],
    ["", null],
  ])("%j tells the model %s", (name, id) => {
    expect(machineNamed(name)?.id ?? null).toBe(id);
  });
});
