/** The fields of a machine's springs (src/machines/profile.ts), which are measured with the ringing sheet. */
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
    about: "how fast the machine swings along x, from the ringing sheet",
    flag: "--spring-x",
  },
  yHz: {
    ...frequency,
    label: "Swings along y",
    about: "how fast the machine swings along y, from the ringing sheet",
    flag: "--spring-y",
  },
  damping: {
    kind: "number",
    label: "Damping",
    about: "how quickly the swinging dies away: 0 never",
    flag: "--damping",
    default: 0.05,
    min: 0,
    max: 0.5,
    unit: "",
    step: 0.01,
  },
} as const satisfies SettingsTable;
