/**
 * Where home is, for a later process that finds the same Grbl. It still counts from the same place if it was not reset since, and
 * its tool number shows that: each reset sets that back to 0. A plotter has no tools, so the number is free to say where home
 * is: at the machine's zero, or where the search for the switches ends. It also says which run of an unfinished plot moved the
 * carriage last.
 */
import type { MachineProfile } from "../../../machines/profile.js";
import { positionFromMotors } from "../../../machines/motors.js";
import type { FoundMidPlot } from "../../driver.js";
import { difference, type Axes } from "../model/planner.js";
import type { BoardSettings } from "./board-settings.js";

/** What one connection tells the next one. */
export interface GrblMemory {
  readonly home: Axes | null;
  readonly penZeroMm: number | null;
  readonly isHeightUnsure: boolean;
  /** What the next connection would find if it was lost in motion; undefined: it was not lost at rest. */
  readonly foundMidPlot: FoundMidPlot | null | undefined;
  /** `keptRun` of the unfinished plot that moved the carriage last; null if something else did. */
  readonly run: number | null;
}

const AT_ZERO = 73;
const AT_SWITCHES = 74;
/** The first number of each while an unfinished plot moved the carriage last. A Grbl takes at most 255. */
const IN_PLOT_FROM_ZERO = 80;
const IN_PLOT_FROM_SWITCHES = 160;
const RUN_COUNT = 80;
/** A carriage that is farther out than this has not come there by plotting from that home, mm. */
const OUTSIDE_MM = 1;
const SAME_MM = 0.001;

const isSame = (a: Axes, b: Axes): boolean =>
  Math.abs(a[0] - b[0]) <= SAME_MM && Math.abs(a[1] - b[1]) <= SAME_MM;

/** What a Grbl can keep of a run's number. */
export const keptRun = (run: number): number => run % RUN_COUNT;

export const foundMidPlot = (penUp: boolean, run: number, isCutShort: boolean): FoundMidPlot => ({
  penUp,
  isCutShort,
  isOfRun: (other) => other !== undefined && keptRun(other) === run,
});

/**
 * The line that tells a later process where home is; that it is unknown, if it is null or somewhere else. `run`: a `keptRun`.
 */
export function homeMark(home: Axes | null, run: number | null, settings: BoardSettings): string {
  if (home && isSame(home, [0, 0, 0])) return `T${run === null ? AT_ZERO : IN_PLOT_FROM_ZERO + run}`;
  const atSwitches = settings.afterHoming;
  if (!home || !atSwitches || !isSame(home, atSwitches)) return "T0";
  return `T${run === null ? AT_SWITCHES : IN_PLOT_FROM_SWITCHES + run}`;
}

interface Mark {
  readonly homeIs: "zero" | "switches" | null;
  readonly run: number | null;
}

function markIn(modes: string): Mark {
  const tool = Number(/\bT(\d+)\b/.exec(modes)?.[1] ?? 0);
  const isFrom = (first: number): boolean => tool >= first && tool < first + RUN_COUNT;
  if (tool === AT_ZERO) return { homeIs: "zero", run: null };
  if (tool === AT_SWITCHES) return { homeIs: "switches", run: null };
  if (isFrom(IN_PLOT_FROM_ZERO)) return { homeIs: "zero", run: tool - IN_PLOT_FROM_ZERO };
  if (isFrom(IN_PLOT_FROM_SWITCHES)) return { homeIs: "switches", run: tool - IN_PLOT_FROM_SWITCHES };
  return { homeIs: null, run: null };
}

/** `keptRun` of the unfinished plot that moved the carriage last, by the mark in a report of the modes; null: none did. */
export const runByMark = (modes: string): number | null => markIn(modes).run;

/**
 * Home by the mark in a report of the modes, in machine coordinates; null: unknown, also if the carriage would be outside the
 * machine.
 */
export function homeByMark(
  modes: string,
  machineAt: Axes,
  profile: MachineProfile,
  settings: BoardSettings,
): Axes | null {
  const { homeIs } = markIn(modes);
  const home: Axes | null =
    homeIs === "zero" ? [0, 0, 0] : homeIs === "switches" ? settings.afterHoming : null;
  if (!home) return null;
  const [x, y] = difference(machineAt, home);
  const { stepsPerMm, widthMm, heightMm } = profile;
  const at = positionFromMotors(profile, x * stepsPerMm, y * stepsPerMm);
  const isInside = (mm: number, sizeMm: number): boolean => mm > -OUTSIDE_MM && mm < sizeMm + OUTSIDE_MM;
  return isInside(at.x, widthMm) && isInside(at.y, heightMm) ? home : null;
}
