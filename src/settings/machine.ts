/** Settings of the connection to a machine, and of the machine itself. */
import type { SettingsTable } from "./setting.js";

/** How commands are sent. */
export const STREAM_TABLE = {
  sendAheadMs: {
    kind: "number",
    label: "Motion sent ahead",
    words: "buffer, latency",
    about:
      "motion sent ahead of the pen; with less, stops are faster, but the pen may pause when the computer is busy",
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
    about: "frequency at which the machine swings along x, from the ringing sheet",
    flag: "--spring-x",
  },
  yHz: {
    ...frequency,
    label: "Swings along y",
    about: "frequency at which the machine swings along y, from the ringing sheet",
    flag: "--spring-y",
  },
  damping: {
    kind: "number",
    label: "Damping",
    about: "damping ratio of the swing; 0: it never ends",
    flag: "--damping",
    default: 0.05,
    min: 0,
    max: 0.5,
    unit: "",
    step: 0.01,
  },
} as const satisfies SettingsTable;
