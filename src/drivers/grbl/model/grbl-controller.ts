import { PlotwrightError } from "../../../errors.js";
import type { GrblController } from "../../../machines/controllers.js";
import type { MachineProfile } from "../../../machines/profile.js";
import type { AxisLimits } from "./planner.js";

/** The machine's controller as this driver's type. Throws `bad-setting` for a machine that it cannot drive. */
export function grblOf({ name, motors, controller }: MachineProfile): GrblController {
  if (controller.kind !== "grbl") {
    throw new PlotwrightError(
      "bad-setting",
      `${name} is not driven by a Grbl: its profile says "${controller.kind}". Choose another machine.`,
    );
  }
  if (motors === "direct") return controller;
  throw new PlotwrightError(
    "bad-setting",
    `The profile of ${name} says that its motors are "mixed", but a Grbl mixes them by itself: set them to "direct".`,
  );
}

export function axisLimits(grbl: GrblController): AxisLimits {
  const { maxSpeedMmPerS: speed, accelMmPerS2: accel, penSpeedMmPerS, penAccelMmPerS2, junctionMm } = grbl;
  return { speed: [speed, speed, penSpeedMmPerS], accel: [accel, accel, penAccelMmPerS2], junctionMm };
}

/** Grbl waits in units of 50 ms, rounded up. */
export const dwellS = (seconds: number): number => Math.ceil(seconds / 0.05 - 1e-9) * 0.05;
