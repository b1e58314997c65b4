/** How the pen and speed settings of the page differ from those of a plot, in words. */
import {
  AXIS_TABLE,
  DRAW_TABLE,
  DROP_RATE,
  OVERLAP_TABLE,
  PEN_TABLE,
  TRAVEL_TABLE,
  type Setting,
  isSameJson,
} from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import { formatNumber } from "../ui/format.js";
import { watchText as words } from "./text.js";

type Settings = Pick<PlotSettings, "pen" | "motion">;
type Values = Readonly<Record<string, unknown>>;
type Rows = Readonly<Record<string, Setting>>;

const PEN_ROWS: Rows = { ...PEN_TABLE, ...OVERLAP_TABLE, dropPctPerS: DROP_RATE };

/** The settings of `now` that `before` does not have: "Height down 28 %". Each is named once. */
export const changedSettings = (before: Settings, now: Settings): readonly string[] => {
  const { draw: drawBefore, travel: travelBefore, ...motionBefore } = before.motion;
  const { draw, travel, ...motion } = now.motion;
  return [
    ...new Set([
      ...changed(before.pen, now.pen, PEN_ROWS),
      ...changed(drawBefore, draw, DRAW_TABLE).map(words.penDown),
      ...changed(travelBefore, travel, TRAVEL_TABLE).map(words.penUp),
      ...changed(motionBefore, motion, AXIS_TABLE),
    ]),
  ];
};

const changed = (before: Values, now: Values, rows: Rows): readonly string[] => {
  const keys = [...new Set([...Object.keys(before), ...Object.keys(now)])];
  // A setting that is left out is the same as null.
  return keys
    .filter((key) => !isSameJson(before[key] ?? null, now[key] ?? null))
    .map((key) => inWords(rows[key], now[key]));
};

const inWords = (row: Setting | undefined, value: unknown): string => {
  if (row === undefined) return words.otherChange;
  return row.kind === "number" && typeof value === "number"
    ? `${row.label} ${formatNumber(value, row.digits)} ${row.unit}`
    : row.label;
};
