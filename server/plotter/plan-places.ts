/** Questions that a driver asks of a plan: where the pen is up, which stroke comes next, how far a place is. */
import {
  machineById,
  xFromMotors,
  yFromMotors,
  type BoardState,
  type CommandStream,
  type MachineProfile,
  type Place,
  type Trajectory,
} from "../../src/index.js";
import type { PlannedPlot } from "./types.js";

/** Rounding between a command's plan time and the trajectory's. */
const SAME_TIME_S = 1e-7;

/** What the board holds after the commands before `index`. */
export function boardStateBefore(stream: CommandStream, index: number, start: BoardState): BoardState {
  if (index === 0) return start;
  return {
    steps1: stream.steps1[index - 1]!,
    steps2: stream.steps2[index - 1]!,
    acc1: stream.acc1[index - 1]!,
    acc2: stream.acc2[index - 1]!,
  };
}

export function placeOfSteps(
  machine: MachineProfile,
  steps1: number,
  steps2: number,
): { x: number; y: number } {
  return { x: xFromMotors(machine, steps1, steps2), y: yFromMotors(machine, steps1, steps2) };
}

/** True when every pen move begun before `planS` leaves the pen up. */
export function isPenUpBefore(trajectory: Trajectory, planS: number): boolean {
  let up = true;
  for (const move of trajectory.penMoves) {
    if (move.startS >= planS - SAME_TIME_S) break;
    up = move.up;
  }
  return up;
}

/** The first command from `index` on before which the carriage rests with the pen up; `count` at the latest. */
export function nextRestIndex(plot: PlannedPlot, index: number): number {
  const { commands, trajectory } = plot;
  for (let i = Math.max(index, 1); i < commands.count; i++) {
    const rests = commands.run[i]! < 0 || commands.run[i] !== commands.run[i - 1];
    if (rests && isPenUpBefore(trajectory, commands.planS[i]!)) return i;
  }
  return commands.count;
}

/** The first place that is still to be drawn at `planS`, when the carriage rests there; null when none is. */
export function nextPlace(trajectory: Trajectory, planS: number): Place | null {
  const { runs } = trajectory;
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run]! < 0 || runs.startS[run]! < planS - SAME_TIME_S) continue;
    const block = runs.firstBlock[run]!;
    const isDot = runs.firstBlock[run + 1] === block;
    return { stroke: runs.stroke[run]!, alongMm: isDot ? 0 : trajectory.alongMm[block]! };
  }
  return null;
}

/** Finds a place's time in a trajectory quickly, as often as progress is told. */
export class PlaceTimes {
  private readonly runOfStroke = new Map<number, number>();

  constructor(private readonly trajectory: Trajectory) {
    const { runs } = trajectory;
    for (let run = 0; run < runs.count; run++) {
      if (runs.stroke[run]! >= 0) this.runOfStroke.set(runs.stroke[run]!, run);
    }
  }

  /** Seconds at which the pen is at a place; null for a stroke that this trajectory does not draw. */
  timeOf(place: Place): number | null {
    const run = this.runOfStroke.get(place.stroke);
    if (run === undefined) return null;
    const { alongMm, startS, durationS, runs } = this.trajectory;
    let low = runs.firstBlock[run]!;
    let high = runs.firstBlock[run + 1]!;
    if (low === high) return runs.startS[run]!;
    const lastBlock = high - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (alongMm[middle]! <= place.alongMm) low = middle;
      else high = middle;
    }
    const spanMm = low < lastBlock ? alongMm[low + 1]! - alongMm[low]! : 0;
    const share = spanMm > 0 ? Math.min(1, Math.max(0, (place.alongMm - alongMm[low]!) / spanMm)) : 0;
    return startS[low]! + share * durationS[low]!;
  }
}

export const machineOf = (settings: { readonly machine: string }): MachineProfile =>
  machineById(settings.machine);
