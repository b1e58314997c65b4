/**
 * The last place that a board certainly reached with its motors powered. The step counters alone do not prove that: a
 * board keeps counting when the motors' supply fails, and counts from 0 after a restart.
 *
 *   one poll:  QS ─── the position ───> QC ─── the supply is good ───> QL ─── the mark is still set
 *
 * The board answers in order, so what QC and QL report was already true at QS.
 */
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { parseSteps } from "../protocol/replies.js";
import type { PollTime } from "../stream/stream-types.js";
import type { Streamer } from "../stream/streamer.js";
import type { StreamPlace } from "../stream/timeline.js";
import { isPowerLow } from "./readings.js";

/** A place of a stream, and the counters there (from home). */
export interface CertainAt {
  readonly place: StreamPlace;
  readonly steps1: number;
  readonly steps2: number;
}

export class CertainPlace {
  private at: CertainAt | null = null;

  constructor(
    private readonly features: FirmwareFeatures,
    private readonly origin: readonly [number, number],
    /** The poll's last line. */
    private readonly lastLine: string,
  ) {}

  /** Call with each reply of a poll, in order. Returns the place on the last reply if all three were good. */
  answered(line: string, reply: string, asked: PollTime, streamer: Streamer): CertainAt | null {
    if (line === "QS") this.at = this.placeOf(reply, asked, streamer);
    else if (isPowerLow(line, reply)) this.at = null;
    if (line !== this.lastLine) return null;
    const { at } = this;
    this.at = null;
    return at;
  }

  private placeOf(reply: string, asked: PollTime, streamer: Streamer): CertainAt | null {
    const [steps1, steps2] = parseSteps(reply, this.origin);
    const place = streamer.placeOfCounters(this.features, steps1, steps2, asked);
    return place && { place, steps1, steps2 };
  }
}
