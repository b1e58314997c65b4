/** Settings of the connection to a machine, and of the machine itself. */
import type { SettingsTable } from "./setting.js";

/** How commands are sent. */
export const STREAM_TABLE = {
  sendAheadMs: {
    kind: "number",
    label: "Motion sent ahead",
    flag: "--send-ahead-ms",
    default: 300,
    min: 100,
    max: 1_000,
    isWhole: true,
    unit: "ms",
    step: 50,
    digits: 0,
  },
} as const satisfies SettingsTable;

const pctPerS = { kind: "number", min: 1, max: 100_000, unit: "%/s", step: 5 } as const;

/** The servo of a pen lift (src/machines/pen-servo.ts). Distances are percent of its range. */
export const PEN_SERVO_TABLE = {
  minMs: {
    kind: "number",
    label: "Shortest pen move",
    default: 45,
    min: 0,
    max: 10_000,
    unit: "ms",
    step: 5,
  },
  slopeMsPerPct: {
    kind: "number",
    label: "Pen time per percent",
    default: 3.07,
    min: 0,
    max: 1_000,
    unit: "ms/%",
    step: 0.1,
  },
  liftPctPerS: {
    ...pctPerS,
    label: "Servo's lifting speed",
    default: 375,
  },
  dropPctPerS: {
    ...pctPerS,
    label: "Servo's lowering speed",
    default: 250,
  },
  frameMs: {
    kind: "number",
    label: "Servo frame",
    default: 24,
    min: 3,
    max: 24,
    isWhole: true,
    unit: "ms",
    step: 3,
  },
} as const satisfies SettingsTable;

const frequency = {
  kind: "number",
  default: 20,
  min: 2,
  max: 200,
  unit: "Hz",
  step: 0.1,
  digits: 1,
  slider: [5, 60],
} as const;

/** The swing of a machine (`Springs` in src/machines/profile.ts), measured with the ringing sheet. */
export const SPRINGS_TABLE = {
  xHz: {
    ...frequency,
    label: "Swings along x",
    flag: "--spring-x",
  },
  yHz: {
    ...frequency,
    label: "Swings along y",
    flag: "--spring-y",
  },
  damping: {
    kind: "number",
    label: "Damping",
    flag: "--damping",
    default: 0.05,
    min: 0,
    max: 0.5,
    unit: "",
    step: 0.01,
  },
} as const satisfies SettingsTable;
