/**
 * When the next command is written.
 *
 * About `windowS` of motion is always sent ahead (0.8 to 1.3 times as much with commands of 150 ms), so that the board
 * keeps moving while the host is stalled. The drawback: on firmware with a queue of one command, the commands sent ahead
 * block the board's parser, and an emergency stop has to wait for them. So the window is 0.3 s, not 3 s. If the board's
 * own queue is deeper, no more is sent than fits into it, and a stop is read at once.
 *
 *      executed        executing     waiting in the board      not yet written
 *   ───────────────|───────^──────|────────────────────────|- - - - - - - - - -
 *                  board time now  <------- windowS ------->
 */
import type { StreamOptions } from "./stream-types.js";
import type { BoardTimeline } from "./timeline.js";

/** Min time between wake-ups. */
export const MIN_WAKE_S = 0.004;
/** Share of the window that is always filled, even if the next command is longer than the rest. */
const RESERVE_SHARE = 0.8;

/**
 * Max seconds of motion sent ahead of the pen, with commands of up to `commandS`: the largest of the window, its reserve
 * plus one command, and one running plus one waiting command.
 */
export const maxAheadS = (windowS: number, commandS: number): number =>
  Math.max(windowS, RESERVE_SHARE * windowS + commandS, 2 * commandS);

/** Board time of a command that is not written yet. */
export interface CommandTime {
  readonly startS: number;
  readonly endS: number;
}

export type SendOptions = Required<Pick<StreamOptions, "clock" | "windowS" | "queueDepth" | "stuckS">> &
  Pick<StreamOptions, "pacing">;

export class SendWindow {
  constructor(
    private readonly options: SendOptions,
    private readonly timeline: Pick<BoardTimeline, "count" | "first">,
  ) {}

  /**
   * @param count of commands that belong together, from `next` on
   * @param unanswered number of written commands that the board has not acknowledged
   */
  mayWrite(next: CommandTime, count: number, boardS: number, unanswered: number): boolean {
    if (this.options.pacing === "acks") return unanswered === 0;
    const waiting = this.timeline.count;
    // Always keep one whole command waiting after the executing one, even if they are longer than the window.
    if (waiting < 2) return true;
    if (this.options.queueDepth > 1 && waiting + count > this.options.queueDepth) return false;
    return this.dueS(next) <= boardS;
  }

  /** Seconds until the next command is due, or the executing one ends. */
  wakeInS(next: CommandTime, boardS: number): number {
    if (this.options.pacing === "acks") return this.options.stuckS;
    const dueInS = this.dueS(next) - boardS;
    const executing = this.timeline.first;
    const endsInS = executing ? executing.endS - boardS : 0;
    return Math.max(MIN_WAKE_S, Math.min(dueInS > 0 ? dueInS : endsInS, Math.max(endsInS, 0)));
  }

  /**
   * Board time at which to write a command: when its end enters the window, or, for a long command, when the motion sent
   * ahead falls to the window's reserve.
   */
  private dueS({ startS, endS }: CommandTime): number {
    const windowS = this.options.windowS + (this.options.clock.latenessS?.() ?? 0);
    return Math.min(endS - windowS, startS - RESERVE_SHARE * windowS);
  }
}
