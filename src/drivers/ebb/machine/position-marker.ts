/**
 * The mark that shows whether the board's step counters mean anything. It is in the board's layer variable, which is 0
 * after each start of the board.
 */
import type { FirmwareFeatures } from "../protocol/firmware.js";
import type { BoardSession } from "../stream/session.js";

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
   * counters, so they do not always count from home.
   */
  async markedMode(): Promise<number> {
    const { session, features } = this;
    if (!features.hasClear) return 0;
    // A board that has restarted has its motors off (QE: from 2.8.0).
    if (features.enableIsQueued && /^0,0$/.test(await session.query("QE"))) return 0;
    const mode = Number(await session.query(this.query)) - POSITION_KNOWN;
    return mode >= 1 && mode <= COARSEST_MODE ? mode : 0;
  }

  /** Call when the motors are on. Only if the counters count from home can the next connection find the position. */
  async set(microstepMode: number, isFromHome: boolean): Promise<void> {
    await this.write(isFromHome ? POSITION_KNOWN + microstepMode : SWITCHED_ON);
  }

  /** Call when the position is lost. */
  async clear(): Promise<void> {
    await this.write(0);
  }

  /** Whether the board has restarted since `set`. Asks twice: a single unexpected reply may belong to another query. */
  async isGone(): Promise<boolean> {
    const { session, features, query } = this;
    const isZero = async (): Promise<boolean> => Number(await session.query(query, MOTION_S)) === 0;
    return features.hasStepQuery && (await isZero()) && (await isZero());
  }

  private async write(value: number): Promise<void> {
    const { session, features } = this;
    if (features.hasStepQuery) await session.send(features.hasFutureSyntax ? `SL,${value},0` : `SL,${value}`);
  }
}
