/**
 * Quality is not stored as a setting: choosing one sets several other settings (src/plan/quality.ts), and each of
 * those can still be changed.
 */
import type { SettingsTable } from "./setting.js";

export const QUALITIES = ["fine", "normal", "fast"] as const;
export type Quality = (typeof QUALITIES)[number];

export const QUALITY_TABLE = {
  quality: {
    kind: "choice",
    label: "Quality",
    about: "sets speed, acceleration and corner rounding together, from the machine's measured swing",
    flag: "--quality",
    default: "normal",
    choices: QUALITIES,
  },
} as const satisfies SettingsTable;
