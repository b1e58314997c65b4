/**
 * The mark that shows whether the board's step counters mean anything, and whether an unfinished plot moved the carriage
 * last. It is in the board's layer variable, which is 0 after each start of the board.
 */
import type { FirmwareFeatures } from "../protocol/firmware.js";
import type { BoardSession } from "../stream/session.js";

/** The variable in which the maker's software notes that the counters count from the corner that its switch has found. */
const HOMED_VARIABLE = 12;
/** The mark while the counters count from home is this plus the microstep mode. */
const POSITION_KNOWN = 112;
/** The same from the beginning of a plot until it ends at home, or something else moves the carriage. */
const IN_PLOT = 120;
/** The mark while they do not count from home. */
const SWITCHED_ON = 1;
const COARSEST_MODE = 5;
/** Time for the motion that may block the board's parser, s. */
const MOTION_S = 2;

/** What the mark says: the microstep mode if the counters count from home, otherwise 0. */
interface Marked {
  readonly mode: number;
  /** The home that a switch has found. */
  readonly isHomed: boolean;
  readonly isInPlot: boolean;
}

export class PositionMarker {
  /** The query that returns the mark. */
  readonly query: string;
  /** As the board has it. */
  private value = 0;

  constructor(
    private readonly session: BoardSession,
    private readonly features: FirmwareFeatures,
  ) {
    this.query = features.hasFutureSyntax ? "QL,0" : "QL";
  }

  /**
   * Reads the mark. Before firmware 2.7, a stop has to zero the counters, so they do not always count from home.
   */
  async read(): Promise<Marked> {
    const { session, features } = this;
    const none = { mode: 0, isHomed: false, isInPlot: false };
    if (!features.hasClear) return none;
    // A board that has restarted has its motors off (QE: from 2.8.0).
    const [divisor1 = 0, divisor2 = 0] = features.enableIsQueued
      ? (await session.query("QE")).split(",").map(Number)
      : [];
    if (features.enableIsQueued && divisor1 === 0 && divisor2 === 0) return none;
    this.value = Number(await session.query(this.query));
    const isInPlot = this.value > IN_PLOT;
    if (features.hasFutureSyntax && Number(await session.query(`QL,${HOMED_VARIABLE}`)) === 1) {
      // With one motor off, the carriage may have been moved.
      const mode = COARSEST_MODE - Math.log2(divisor1);
      return divisor1 === divisor2 ? { mode, isHomed: true, isInPlot } : none;
    }
    const mode = this.value - (isInPlot ? IN_PLOT : POSITION_KNOWN);
    return mode >= 1 && mode <= COARSEST_MODE ? { mode, isHomed: false, isInPlot } : none;
  }

  /**
   * Call when the motors are on, or before they are switched on to find home. Only if the counters count from home can the next connection find the position.
   * `isHomed`: a switch has found that home, which other programs can then use too.
   */
  async set(microstepMode: number, isFromHome: boolean, isHomed: boolean): Promise<void> {
    await this.write(isFromHome ? POSITION_KNOWN + microstepMode : SWITCHED_ON);
    await this.writeHomed(isFromHome && isHomed);
  }

  /**
   * Call before a plot moves the carriage, when it has ended, and before anything else moves it. Does not wait for the
   * reply, so that motion begins at once. Without this mark, more is drawn twice after an interruption.
   */
  noteInPlot(isInPlot: boolean): void {
    const { value } = this;
    if (value <= SWITCHED_ON || isInPlot === value > IN_PLOT) return;
    this.value = isInPlot ? value + IN_PLOT - POSITION_KNOWN : value - IN_PLOT + POSITION_KNOWN;
    this.session.write([{ line: this.lineOf(this.value) }]);
  }

  /** Call when the position is lost. */
  async clear(): Promise<void> {
    await this.write(0);
    await this.writeHomed(false);
  }

  /** Call when another program has used the board since: it may have zeroed the counters. What it found itself remains. */
  async forgetOwn(): Promise<void> {
    await this.write(0);
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
    if (!this.features.hasStepQuery) return;
    this.value = value;
    await this.session.send(this.lineOf(value));
  }
  private lineOf(value: number): string {
    return this.features.hasFutureSyntax ? `SL,${value},0` : `SL,${value}`;
  }
}
