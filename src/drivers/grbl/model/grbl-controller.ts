/** The fields of a machine profile for its Grbl. */
import { PlotwrightError } from "../../../errors.js";
import type { Controller, MachineProfile } from "../../../machines/profile.js";
import type { SettingsTable, ValuesOf } from "../../../settings/setting.js";
import type { GrblAxisLimits } from "./planner.js";

const speed = { kind: "number", min: 0, minExcluded: true, max: 1_000, unit: "mm/s", step: 1 } as const;
const accel = { kind: "number", min: 0, minExcluded: true, max: 50_000, unit: "mm/s²", step: 10 } as const;
const height = { kind: "number", min: -200, max: 200, unit: "mm", step: 0.5 } as const;

/** A Grbl that lifts the pen with its Z axis. X and Y have the same limits. `$110` and so on are Grbl's own settings. */
export const GRBL_FIELDS = {
  maxSpeedMmPerS: { ...speed, label: "Highest speed", about: "$110 and $111, divided by 60", default: 100 },
  accelMmPerS2: { ...accel, label: "Acceleration", about: "$120 and $121", default: 1_000 },
  junctionMm: {
    kind: "number",
    label: "Junction deviation",
    about: "$11",
    default: 0.01,
    min: 0,
    max: 10,
    unit: "mm",
    step: 0.01,
    digits: 3,
  },
  penUpZMm: { ...height, label: "Z with the pen up", about: "the pen's height for travel", default: 5 },
  penDownZMm: { ...height, label: "Z with the pen down", about: "the pen's height for drawing", default: 0 },
  penSpeedMmPerS: {
    ...speed,
    label: "Pen speed",
    about: "speed of Z, up to $112 divided by 60",
    default: 10,
  },
  penAccelMmPerS2: { ...accel, label: "Pen acceleration", about: "$122", default: 200 },
  penWaitMs: {
    kind: "number",
    label: "Wait for the pen",
    about: "after each pen move, in steps of 50 ms",
    default: 0,
    min: 0,
    max: 10_000,
    isWhole: true,
    unit: "ms",
    step: 50,
    digits: 0,
  },
} as const satisfies SettingsTable;

export interface GrblController extends Controller, ValuesOf<typeof GRBL_FIELDS> {
  readonly kind: "grbl";
}

/** The machine's controller as this driver's type. Throws `bad-setting` for a machine that it cannot drive. */
export function grblOf({ name, motors, controller }: MachineProfile): GrblController {
  if (controller.kind !== "grbl") {
    throw new PlotwrightError(
      "bad-setting",
      `${name} is not driven by a Grbl: its profile says "${controller.kind}". Choose another machine.`,
    );
  }
  if (motors === "direct") return controller as GrblController;
  throw new PlotwrightError(
    "bad-setting",
    `The profile of ${name} says that its motors are "mixed", but a Grbl mixes them by itself: set them to "direct".`,
  );
}

export function axisLimits(grbl: GrblController): GrblAxisLimits {
  const { maxSpeedMmPerS: speed, accelMmPerS2: accel, penSpeedMmPerS, penAccelMmPerS2, junctionMm } = grbl;
  return { speed: [speed, speed, penSpeedMmPerS], accel: [accel, accel, penAccelMmPerS2], junctionMm };
}

/** Grbl waits in units of 50 ms, rounded up. */
export const dwellS = (seconds: number): number => Math.ceil(seconds / 0.05 - 1e-9) * 0.05;
