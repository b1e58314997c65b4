/** What the virtual board counts while it plots, for tests and reports. */
import { sFromTicks } from "../../../units.js";
import type { RunningMove } from "../model/orders.js";

/** A gap after a slower move does not count as an underrun. */
const MOVING_MM_PER_S = 1;
/** Moves with a longer gap between them are not joined: the later one begins from rest. */
export const MAX_JOINED_TICKS = 0.5;

export interface BoardStatistics {
  readonly moveCount: number;
  /** Seconds spent in moves. */
  readonly movingS: number;
  /** Seconds in moves, pen waits and delays. */
  readonly busyS: number;
  readonly penMoveCount: number;
  /** Number of times that the queue ran empty while the pen was moving, and the total time. */
  readonly underrunCount: number;
  readonly underrunS: number;
  readonly longestUnderrunS: number;
  /** Max change of velocity between consecutive moves, starts from rest included. */
  readonly largestJumpMmPerS: number;
  /** Max time that one motor of a step-limited move waited for the other. */
  readonly longestMotorWaitS: number;
  /** mm moved with the pen down, by motor path. */
  readonly drawnMm: number;
  readonly travelMm: number;
  /** Number of moves that began while the pen's servo was still moving. */
  readonly movesBeforePenArrivedCount: number;
  /** Max speed of the servo's signal, percent of its range per second; moves "at once" are not counted. */
  readonly fastestPenPctPerS: number;
}

export class BoardTotals {
  movingTicks = 0;
  busyTicks = 0;
  penMoveCount = 0;
  drawnMm = 0;
  travelMm = 0;
  private moveCount = 0;
  private underrunCount = 0;
  private underrunTicks = 0;
  private longestUnderrunTicks = 0;
  private largestJumpMmPerS = 0;
  private longestMotorWaitTicks = 0;
  private movesBeforePenArrivedCount = 0;
  private fastestPenPctPerS = 0;

  addMove({ motion1, motion2 }: RunningMove, isPenMoving: boolean): void {
    this.moveCount++;
    if (isPenMoving) this.movesBeforePenArrivedCount++;
    if (motion1.ticks === 0 || motion2.ticks === 0) return;
    const waitTicks = Math.abs(motion1.ticks - motion2.ticks);
    this.longestMotorWaitTicks = Math.max(this.longestMotorWaitTicks, waitTicks);
  }

  addPenSpeed(pctPerS: number): void {
    if (Number.isFinite(pctPerS)) this.fastestPenPctPerS = Math.max(this.fastestPenPctPerS, pctPerS);
  }

  /** The time between two moves. `mmPerS`: speed at the end of the first. */
  addGap(ticks: number, mmPerS: number): void {
    if (ticks <= MAX_JOINED_TICKS || mmPerS <= MOVING_MM_PER_S) return;
    this.underrunCount++;
    this.underrunTicks += ticks;
    this.longestUnderrunTicks = Math.max(this.longestUnderrunTicks, ticks);
  }

  /** A change of velocity between two moves. */
  addJump(mmPerS: number): void {
    this.largestJumpMmPerS = Math.max(this.largestJumpMmPerS, mmPerS);
  }

  statistics(): BoardStatistics {
    return {
      moveCount: this.moveCount,
      movingS: sFromTicks(this.movingTicks),
      busyS: sFromTicks(this.busyTicks),
      penMoveCount: this.penMoveCount,
      underrunCount: this.underrunCount,
      underrunS: sFromTicks(this.underrunTicks),
      longestUnderrunS: sFromTicks(this.longestUnderrunTicks),
      largestJumpMmPerS: this.largestJumpMmPerS,
      longestMotorWaitS: sFromTicks(this.longestMotorWaitTicks),
      drawnMm: this.drawnMm,
      travelMm: this.travelMm,
      movesBeforePenArrivedCount: this.movesBeforePenArrivedCount,
      fastestPenPctPerS: this.fastestPenPctPerS,
    };
  }
}
