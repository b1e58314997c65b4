/** Inputs and results of a `Streamer`. */
import type { StreamPosition } from "./timeline.js";
import type { Clock } from "../../transport.js";

/** How commands are sent. Only the clock is required. */
export interface StreamOptions {
  /** Counts board seconds. */
  readonly clock: Clock;
  /** Motion sent ahead of the pen, board seconds. Default 0.3. */
  readonly windowS?: number;
  /** Commands that the board's queue holds before its parser blocks: 1, or the value set by `CU,4`. */
  readonly queueDepth?: number;
  /** "acks", for comparison only: the next command is written when the previous one is acknowledged. */
  readonly pacing?: "window" | "acks";
  /**
   * Queries sent during the stream, every `everyS` board seconds. With `QU,6`, `QG` or `QM` as the first, the estimated
   * board time stays accurate.
   */
  readonly poll?: { readonly lines: readonly string[]; readonly everyS: number };
  /**
   * Queries written with the commands, so that the board answers them between two commands: at most every `everyS` board
   * seconds. Their replies go to `onPoll` too.
   */
  readonly between?: { readonly lines: readonly string[]; readonly everyS: number } | undefined;
  /** Board seconds beyond the plan after which a board that makes no progress counts as stuck. Default 2. */
  readonly stuckS?: number;
  readonly onPoll?: (line: string, reply: string, asked: PollTime) => void;
  /** Sent directly after an emergency stop, because a pen on its way down must not reach the paper. */
  readonly liftLine?: string;
  /** Offset to add to the board's step counters to get the streams' steps. Default 0, 0. */
  readonly origin?: readonly [number, number];
}

/** When a poll was written. The board reads its counters then or slightly later. */
export interface PollTime {
  /** On the stream's clock. A busy host may read the reply much later. */
  readonly clockS: number;
  readonly boardS: number;
  readonly place: StreamPosition;
}

/** How a stream ended. */
export interface StreamReport {
  /** The board's step counters plus `origin`; null if its firmware does not report them. */
  readonly steps1: number | null;
  readonly steps2: number | null;
  /** True if they equal the prediction (or cannot be read). */
  readonly exact: boolean;
  /** The last command written; the board is in the state after it. */
  readonly end: StreamPosition;
  /** False if the stream was cut and not replaced. */
  readonly complete: boolean;
}
