/**
 * Where home is, for a later process that finds the same Grbl. It still counts from the same place if it was not reset since, and
 * its tool number shows that: each reset sets that back to 0. A plotter has no tools, so the number is free to say where home
 * is: at the machine's zero, or where the search for the switches ends. It also says whether an unfinished plot moved the
 * carriage last.
 */
import type { MachineProfile } from "../../../machines/profile.js";
import { positionFromMotors } from "../../../machines/motors.js";
import { difference, type Axes } from "../model/planner.js";
import type { BoardSettings } from "./board-settings.js";

/** What one connection tells the next one. */
export interface GrblMemory {
  readonly home: Axes | null;
  readonly penZeroMm: number | null;
  /** What the next connection would find if it was lost in motion; undefined: it was not lost at rest. */
  readonly foundMidPlot: { readonly penUp: boolean } | null | undefined;
  /** An unfinished plot moved the carriage last. */
  readonly isInPlot: boolean;
}

const AT_ZERO = 73;
const AT_SWITCHES = 74;
/** Added to either of them while an unfinished plot moved the carriage last. */
const IN_PLOT = 2;
/** A carriage that is farther out than this has not come there by plotting from that home, mm. */
const OUTSIDE_MM = 1;
const SAME_MM = 0.001;

const isSame = (a: Axes, b: Axes): boolean =>
  Math.abs(a[0] - b[0]) <= SAME_MM && Math.abs(a[1] - b[1]) <= SAME_MM;

/** The line that tells a later process where home is; that it is unknown, if it is null or somewhere else. */
export function homeMark(home: Axes | null, isInPlot: boolean, settings: BoardSettings): string {
  const more = isInPlot ? IN_PLOT : 0;
  if (home && isSame(home, [0, 0, 0])) return `T${AT_ZERO + more}`;
  const atSwitches = settings.afterHoming;
  return home && atSwitches && isSame(home, atSwitches) ? `T${AT_SWITCHES + more}` : "T0";
}

const markIn = (modes: string): number => Number(/\bT(\d+)\b/.exec(modes)?.[1] ?? 0);

/** Whether an unfinished plot moved the carriage last, by the mark in a report of the modes. */
export const inPlotByMark = (modes: string): boolean =>
  [AT_ZERO, AT_SWITCHES].includes(markIn(modes) - IN_PLOT);

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
  const mark = markIn(modes) - (inPlotByMark(modes) ? IN_PLOT : 0);
  const home: Axes | null = mark === AT_ZERO ? [0, 0, 0] : mark === AT_SWITCHES ? settings.afterHoming : null;
  if (!home) return null;
  const [x, y] = difference(machineAt, home);
  const { stepsPerMm, widthMm, heightMm } = profile;
  const at = positionFromMotors(profile, x * stepsPerMm, y * stepsPerMm);
  const isInside = (mm: number, sizeMm: number): boolean => mm > -OUTSIDE_MM && mm < sizeMm + OUTSIDE_MM;
  return isInside(at.x, widthMm) && isInside(at.y, heightMm) ? home : null;
}
