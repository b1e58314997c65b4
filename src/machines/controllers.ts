/**
 * What a machine profile says about its controller: one type for each kind of driver. Where all fields are plain
 * numbers, a table describes them, and the type, the checks and the schema come from it.
 */
import type { SettingsTable, ValuesOf } from "../settings/setting.js";

/** EiBotBoard, used by AxiDraw, NextDraw, EggBot and others. */
export interface EbbController {
  readonly kind: "ebb";
  /** 1 = 1/16 steps, 2 = 1/8, 3 = 1/4, 4 = 1/2, 5 = whole steps. */
  readonly microstepMode: 1 | 2 | 3 | 4 | 5;
  /** Servo positions at 0 % and 100 % height, units of 1/12 µs (83.3 ns). */
  readonly servoPosAt0Pct: number;
  readonly servoPosAt100Pct: number;
  /** Servo output: 4 = RB1 (standard), 5 = RB2 (brushless upgrade). */
  readonly servoPin: 4 | 5;
  /** Switches at x = 0 and y = 0. Null or left out: home is where the user places the carriage. */
  readonly homing?: HomingSwitches | null | undefined;
}

export interface HomingSwitches {
  readonly x: SwitchInput;
  readonly y: SwitchInput;
}

/** One input pin of the board. */
export interface SwitchInput {
  readonly port: (typeof INPUT_PORTS)[number];
  /** 0 … 7. */
  readonly pin: number;
  /** The pin's level while the switch is pressed. */
  readonly pressed: 0 | 1;
}

export const INPUT_PORTS = ["A", "B", "C", "D", "E"] as const;

const speed = { kind: "number", min: 0, minExcluded: true, max: 1_000, unit: "mm/s", step: 1 } as const;
const accel = { kind: "number", min: 0, minExcluded: true, max: 50_000, unit: "mm/s²", step: 10 } as const;
const height = { kind: "number", min: -200, max: 200, unit: "mm", step: 0.5 } as const;

/** A Grbl that lifts the pen with its Z axis. X and Y have the same limits. `$…`: the setting of the firmware. */
export const GRBL_TABLE = {
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

export interface GrblController extends ValuesOf<typeof GRBL_TABLE> {
  readonly kind: "grbl";
}

/** What drives the motors and the pen. `kind` selects the driver in src/drivers. */
export type Controller = EbbController | GrblController;

/** The controllers that a table describes completely. */
export const CONTROLLER_TABLES: Readonly<Record<Exclude<Controller["kind"], "ebb">, SettingsTable>> = {
  grbl: GRBL_TABLE,
};
