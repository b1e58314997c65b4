/** What goes into a `Streamer`, and what comes out of it. */
import type { InFlight, StreamPlace } from "./timeline.js";
import type { Clock } from "../../transport.js";

export interface StreamOptions {
  /** Counts board seconds. */
  readonly clock: Clock;
  /** Motion kept ahead of the pen, board seconds. Default 0.3. */
  readonly windowS?: number;
  /** Commands that wait in the board's queue before its parser blocks: 1, or what `CU,4` has set. */
  readonly queueDepth?: number;
  /** "acks": for comparison only, the next command is written when the one before is acknowledged. */
  readonly pacing?: "window" | "acks";
  /** Queries sent during the stream, every so many board seconds. `QU,6`, `QG` or `QM` as the first keep the time line true. */
  readonly poll?: { readonly lines: readonly string[]; readonly everyS: number };
  /** Board seconds beyond the plan before a board that does not get on counts as stuck. Default 2. */
  readonly stuckS?: number;
  readonly onPoll?: (line: string, reply: string, asked: PollTime) => void;
  /** What to add to the board's step counters for the places of the streams. Default 0, 0. */
  readonly origin?: readonly [number, number];
}

/** When a poll was written: the board takes its reading then or a little later. */
export interface PollTime {
  readonly boardS: number;
  readonly place: StreamPlace;
}

export interface RefusedCommand {
  readonly at: StreamPlace;
  /** Null for one that takes no time. */
  readonly command: InFlight | null;
}

export interface StreamReport {
  /** The board's step counters, `origin` added; null where its firmware cannot say. */
  readonly steps1: number | null;
  readonly steps2: number | null;
  /** True when they equal the prediction (or cannot be read). */
  readonly exact: boolean;
  /** The last command written: the state after it is where the board stands. */
  readonly end: StreamPlace;
  /** False after a cut that nothing followed. */
  readonly complete: boolean;
}
