/** The swing of a machine (`Springs` in src/machines/profile.ts), measured with the ringing sheet. */
import type { SettingsTable } from "./setting.js";

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
