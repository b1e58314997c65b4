/**
 * Quality: a choice of settings, not a setting. What is stored and planned are the numbers that it sets
 * (src/plan/quality.ts), and each of them can still be changed.
 */
import type { ChoiceSetting, SettingsTable } from "./setting.js";

export const QUALITIES = ["fine", "normal", "fast"] as const;
export type Quality = (typeof QUALITIES)[number];

export const QUALITY_TABLE = {
  quality: {
    kind: "choice",
    label: "Quality",
    about: "speed, acceleration and corner rounding together, from how the machine swings",
    flag: "--quality",
    default: "normal",
    choices: QUALITIES,
  } satisfies ChoiceSetting<Quality>,
} as const satisfies SettingsTable;
