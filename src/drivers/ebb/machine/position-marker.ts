/**
 * What the board itself keeps about its position, for the next connection. Its layer variable is the mark that shows
 * whether its step counters mean anything. Its node counter is the number of the unfinished run of a plot that moved the
 * carriage last. Both are 0 after each start of the board.
 */
import { MIN_RUN } from "../../driver.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import type { BoardSession } from "../stream/session.js";

/** The variable in which the maker's software notes that the counters count from the corner that its switch has found. */
const HOMED_VARIABLE = 12;
/** The mark while the counters count from home is this plus the microstep mode. */
const POSITION_KNOWN = 112;
/** The mark while they do not count from home. */
const SWITCHED_ON = 1;
const COARSEST_MODE = 5;
/** Time for the motion that may block the board's parser, s. */
const MOTION_S = 2;

export class PositionMarker {
  /** The query that returns the mark. */
  readonly query: string;

  constructor(
    private readonly session: BoardSession,
    private readonly features: FirmwareFeatures,
  ) {
    this.query = features.hasFutureSyntax ? "QL,0" : "QL";
  }

  /**
   * The microstep mode, if the counters still count from home; otherwise 0. Before firmware 2.7, a stop has to zero the
   * counters, so they do not always count from home. `isHomed`: the home that a switch has found.
   */
  async markedMode(): Promise<{ readonly mode: number; readonly isHomed: boolean }> {
    const { session, features } = this;
    const none = { mode: 0, isHomed: false };
    if (!features.hasClear) return none;
    // A board that has restarted has its motors off (QE: from 2.8.0).
    const [divisor1 = 0, divisor2 = 0] = features.enableIsQueued
      ? (await session.query("QE")).split(",").map(Number)
      : [];
    if (features.enableIsQueued && divisor1 === 0 && divisor2 === 0) return none;
    if (features.hasFutureSyntax && Number(await session.query(`QL,${HOMED_VARIABLE}`)) === 1) {
      // With one motor off, the carriage may have been moved.
      return divisor1 === divisor2 ? { mode: COARSEST_MODE - Math.log2(divisor1), isHomed: true } : none;
    }
    const mode = Number(await session.query(this.query)) - POSITION_KNOWN;
    return mode >= 1 && mode <= COARSEST_MODE ? { mode, isHomed: false } : none;
  }

  /**
   * Call when the motors are on, or before they are switched on to find home. Only if the counters count from home can the
   * next connection find the position. `isHomed`: a switch has found that home, which other programs can then use too.
   * From here on, the counters say nothing about a plot before.
   */
  async set(microstepMode: number, isFromHome: boolean, isHomed: boolean): Promise<void> {
    this.noteRun(null);
    await this.write(isFromHome ? POSITION_KNOWN + microstepMode : SWITCHED_ON);
    await this.writeHomed(isFromHome && isHomed);
  }

  /** Call when the position is lost, and with it the place of an unfinished plot. */
  async clear(): Promise<void> {
    this.noteRun(null);
    await this.write(0);
    await this.writeHomed(false);
  }

  /** Call when another program has used the board since: it may have zeroed the counters. What it found itself remains. */
  async forgetOwn(): Promise<void> {
    await this.write(0);
  }

  /**
   * Call with its number before a run of a plot moves the carriage. Call with null when its place is stored, and before
   * anything else moves the carriage. Does not wait for the reply, so that motion begins at once. Without this note, more is
   * drawn twice after an interruption.
   */
  noteRun(run: number | null): void {
    if (this.features.hasStepQuery) this.session.write([{ line: `SN,${run ?? 0}` }]);
  }

  /** The number of the unfinished run of a plot that moved the carriage last; null if something else did. */
  async unfinishedRun(): Promise<number | null> {
    const run = this.features.hasStepQuery ? Number(await this.session.query("QN")) : 0;
    return run >= MIN_RUN ? run : null;
  }

  /** Whether the board has restarted since `set`. Asks twice: a single unexpected reply may belong to another query. */
  async isGone(): Promise<boolean> {
    const { session, features, query } = this;
    const isZero = async (): Promise<boolean> => Number(await session.query(query, MOTION_S)) === 0;
    return features.hasStepQuery && (await isZero()) && (await isZero());
  }

  private async writeHomed(isHomed: boolean): Promise<void> {
    if (this.features.hasFutureSyntax) await this.session.send(`SL,${isHomed ? 1 : 0},${HOMED_VARIABLE}`);
  }

  private async write(value: number): Promise<void> {
    const { session, features } = this;
    if (features.hasStepQuery) await session.send(features.hasFutureSyntax ? `SL,${value},0` : `SL,${value}`);
  }
}
