/** The fields of a machine profile for its Grbl. */
import { PlotwrightError } from "../../../errors.js";
import type {
  Controller,
  ControllerFields,
  ControllerSetting,
  MachineProfile,
} from "../../../machines/profile.js";
import type { ValuesOf } from "../../../settings/setting.js";
import type { GrblAxisLimits } from "./planner.js";

const speed = { kind: "number", min: 0, minExcluded: true, max: 1_000, unit: "mm/s", step: 1 } as const;
const accel = { kind: "number", min: 0, minExcluded: true, max: 50_000, unit: "mm/s²", step: 10 } as const;
const height = { kind: "number", min: -200, max: 200, unit: "mm", step: 0.5, isOptional: true } as const;
const signal = { kind: "number", min: 0, max: 65_535, unit: "", step: 10, isOptional: true } as const;

/** `$110` and so on are Grbl's own settings. Once it is connected, plans use those for speeds and accelerations. */
const LIMIT_FIELDS = {
  maxSpeedMmPerS: { ...speed, label: "Highest speed", about: "$110, divided by 60", default: 100 },
  accelMmPerS2: { ...accel, label: "Acceleration", about: "$120", default: 1_000 },
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
} as const satisfies ControllerFields;

type OptionalFields = Readonly<Record<string, ControllerSetting & { readonly isOptional: true }>>;

/** Of the Grbl's own axes. Left out: that of X. */
const Y_FIELDS = {
  maxSpeedYMmPerS: {
    ...speed,
    isOptional: true,
    label: "Highest speed of Y",
    about: "$111, divided by 60; left out: that of X",
    default: 100,
  },
  accelYMmPerS2: {
    ...accel,
    isOptional: true,
    label: "Acceleration of Y",
    about: "$121; left out: that of X",
    default: 1_000,
  },
} as const satisfies OptionalFields;

/**
 * Three kinds of pen lift: a Z axis, a servo on the spindle's output, or own lines. The two heights of a Z axis and a
 * servo are those at the default heights of pens, 60 % and 30 %; other heights follow in proportion.
 */
const PEN_FIELDS = {
  penUpZMm: { ...height, label: "Z with the pen up", about: "Z at a pen height of 60 %", default: 5 },
  penDownZMm: { ...height, label: "Z with the pen down", about: "Z at a pen height of 30 %", default: 0 },
  penMinZMm: { ...height, label: "Lowest Z", about: "Z never goes below this", default: 0 },
  penMaxZMm: { ...height, label: "Highest Z", about: "Z never goes above this", default: 10 },
  penSpeedMmPerS: {
    ...speed,
    isOptional: true,
    label: "Pen speed",
    about: "speed of Z, up to $112 divided by 60",
    default: 10,
  },
  penAccelMmPerS2: { ...accel, isOptional: true, label: "Pen acceleration", about: "$122", default: 200 },
  penUpS: {
    ...signal,
    label: "S with the pen up",
    about: "value of M3 S at a pen height of 60 %, for a servo on the spindle's output",
    default: 600,
  },
  penDownS: {
    ...signal,
    label: "S with the pen down",
    about: "value of M3 S at a pen height of 30 %",
    default: 300,
  },
  penWaitMs: {
    kind: "number",
    isOptional: true,
    label: "Wait for the pen",
    about: "after each pen move, in steps of 50 ms, besides the time of its servo",
    default: 0,
    min: 0,
    max: 10_000,
    isWhole: true,
    unit: "ms",
    step: 50,
    digits: 0,
  },
} as const satisfies OptionalFields;

/** G-code, with line ends between its lines. */
const OWN_LINES = { kind: "text", isOptional: true, maxLength: 1_000 } as const;

export const GRBL_FIELDS = {
  ...LIMIT_FIELDS,
  ...Y_FIELDS,
  ...PEN_FIELDS,
  homing: {
    kind: "switch",
    isOptional: true,
    label: "Finds home with its switches",
    about: "home is where $H brings the carriage, and is found when the position is unknown; needs $22=1",
    default: false,
  },
  arcs: {
    kind: "switch",
    isOptional: true,
    label: "Draws arcs",
    about: "curves are sent as arcs (G2, G3) where they are round; a DrawCore refuses them",
    default: false,
  },
  penUpLines: { ...OWN_LINES, label: "Lines that lift the pen" },
  penDownLines: { ...OWN_LINES, label: "Lines that lower the pen" },
} as const;

type Optional<Values> = { readonly [K in keyof Values]?: Values[K] | null | undefined };

export interface GrblController
  extends Controller, ValuesOf<typeof LIMIT_FIELDS>, Optional<ValuesOf<typeof Y_FIELDS & typeof PEN_FIELDS>> {
  readonly kind: "grbl";
  readonly homing?: boolean | null | undefined;
  /** It takes G2 and G3. */
  readonly arcs?: boolean | null | undefined;
  /** G-code that lifts the pen; lines are separated by line ends. */
  readonly penUpLines?: string | null | undefined;
  readonly penDownLines?: string | null | undefined;
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

export const findsHome = ({ controller }: MachineProfile): boolean => controller.homing === true;

/** By the profile. A Z axis that the pen does not use has no limits. */
export function axisLimits(grbl: GrblController): GrblAxisLimits {
  const { maxSpeedMmPerS: speed, accelMmPerS2: accel, penSpeedMmPerS, penAccelMmPerS2, junctionMm } = grbl;
  return {
    speed: [speed, grbl.maxSpeedYMmPerS ?? speed, penSpeedMmPerS ?? Infinity],
    accel: [accel, grbl.accelYMmPerS2 ?? accel, penAccelMmPerS2 ?? Infinity],
    junctionMm,
  };
}

/** Grbl waits in units of 50 ms, rounded up. */
export const dwellS = (seconds: number): number => Math.ceil(seconds / 0.05 - 1e-9) * 0.05;
