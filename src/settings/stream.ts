/** How commands are sent to the machine. */
import type { SettingsTable } from "./setting.js";

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
