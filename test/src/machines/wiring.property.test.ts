import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  MACHINES,
  plan,
  type MachineProfile,
} from "../../../src/index.js";
import { xFromMotors, yFromMotors } from "../../../src/internal.js";
import { strokesOf } from "../../support/plots/local-planner.js";
import { cases } from "../../support/runs/full-run.js";

const EBB_MACHINES = MACHINES.filter(({ controller }) => controller.kind === "ebb");
const flips = fc.record({ flipX: fc.boolean(), flipY: fc.boolean(), swapAxes: fc.boolean() });
const coordinate = fc.double({ min: 0, max: 80, noNaN: true });
const line = fc
  .array(fc.tuple(coordinate, coordinate), { minLength: 2, maxLength: 5 })
  .map((points) => points.flat());

describe("commands for a machine with different wiring", () => {
  it("move the carriage along the same path: its motors map back to the same positions", () => {
    fc.assert(
      fc.property(fc.constantFrom(...EBB_MACHINES), flips, line, (model, wiring, points) => {
        const machine: MachineProfile = { ...model, ...wiring };
        const trajectory = plan(strokesOf(points), DEFAULT_MOTION, DEFAULT_PEN, { machine });
        const options = { firmware: "3.0.3", pen: DEFAULT_PEN };
        const plain = compile(trajectory, { ...options, machine: model });
        const wired = compile(trajectory, { ...options, machine });
        const places = (of: MachineProfile, { count, steps1, steps2 }: typeof plain): number[][] =>
          Array.from({ length: count }, (_, i) => [
            xFromMotors(of, steps1[i], steps2[i]),
            yFromMotors(of, steps1[i], steps2[i]),
          ]);
        expect(wired.count).toBe(plain.count);
        const stepMm = 1.5 / model.stepsPerMm;
        const [here, there] = [places(machine, wired), places(model, plain)];
        here.forEach(([x, y], i) => {
          expect(Math.abs(x - there[i][0])).toBeLessThanOrEqual(stepMm);
          expect(Math.abs(y - there[i][1])).toBeLessThanOrEqual(stepMm);
        });
      }),
      { numRuns: cases() },
    );
  });
});
