/**
 * The coordinates of the virtual Grbl: those of the machine, which begin at 0 with each start, its work offset, and the real
 * place of the carriage, which no start changes.
 */
import { positionFromMotors } from "../../../machines/motors.js";
import type { MachineProfile } from "../../../machines/profile.js";
import { sum, type Axes } from "../model/planner.js";

const PULL_OFF_MM = 1;
/** Where it stands after it has found its switches, in machine coordinates. */
export const AT_SWITCHES: Axes = [-PULL_OFF_MM, -PULL_OFF_MM, -PULL_OFF_MM];

export class Coordinates {
  /** Origin of the work coordinates, mm. */
  offset: Axes = [0, 0, 0];
  /** Where the machine coordinates begin since the last start, mm from where they began at the first. */
  private origin: Axes = [0, 0, 0];

  constructor(private readonly machine: MachineProfile) {}

  /** It was started again where it stands: it counts from 0 there. */
  restarted(at: Axes): void {
    this.origin = sum(this.origin, at);
  }

  /** The carriage stands where it stood at the first start; the machine counts on. */
  pushedHome([x, y]: Axes): void {
    this.origin = [-x, -y, this.origin[2]];
  }

  /** The pen's axis was turned to a real height. */
  pushedPen([, , z]: Axes, zMm: number): void {
    const [x, y] = this.origin;
    this.origin = [x, y, zMm - z];
  }

  /** It stands at its switches, where the carriage stood at the first start. */
  foundSwitches(): void {
    this.origin = [PULL_OFF_MM, PULL_OFF_MM, 0];
  }

  /** G10: its current place has these work coordinates. */
  setOffset(words: ReadonlyMap<string, number>, at: Axes): void {
    const set = (i: 0 | 1 | 2, letter: string): number =>
      words.has(letter) ? at[i] - (words.get(letter) ?? 0) : this.offset[i];
    this.offset = [set(0, "X"), set(1, "Y"), set(2, "Z")];
  }

  /** The end of a move as written, in machine coordinates. `from`: where it begins. */
  target(words: ReadonlyMap<string, number>, from: Axes): Axes {
    const along = (letter: string, axis: 0 | 1 | 2): number => {
      const word = words.get(letter);
      return word === undefined ? from[axis] : word + this.offset[axis];
    };
    return [along("X", 0), along("Y", 1), along("Z", 2)];
  }

  /** X and Y are rounded to whole steps. */
  onSteps([x, y, z]: Axes): Axes {
    const { stepsPerMm } = this.machine;
    return [Math.round(x * stepsPerMm) / stepsPerMm, Math.round(y * stepsPerMm) / stepsPerMm, z];
  }

  /** The real place, mm from the first start. */
  onPage(at: Axes): { x: number; y: number; zMm: number } {
    const [x, y, zMm] = sum(this.origin, at);
    const { stepsPerMm } = this.machine;
    return { ...positionFromMotors(this.machine, x * stepsPerMm, y * stepsPerMm), zMm };
  }
}
