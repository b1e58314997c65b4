/**
 * Detects a board that answers and accepts commands but does not step: the step counters that it reports stay the same
 * while the plan advances. Otherwise a long command would hide the fault until its end.
 */
import { parseSteps } from "../protocol/replies.js";
import type { PollTime } from "../stream/stream-types.js";
import type { StreamPosition } from "../stream/timeline.js";
import type { Clock } from "../../transport.js";

/** Seconds of this computer without a step although motion is planned. */
const STALL_S = 1.2;
/** Min planned steps of one motor in that time; far more than the error of the board's estimated time. */
const MOVED_STEPS = 160;

interface LastChange {
  readonly steps: string;
  readonly sinceS: number;
  readonly planned: readonly [number, number];
}

export class AdvanceWatch {
  private lastChange: LastChange | null = null;

  constructor(
    private readonly clock: Clock,
    private readonly speed: number,
  ) {}

  /**
   * Call with each reply to QS, the time of the query, and the board's planned place now. True if the motors do not move.
   * A busy host reads a reply long after the board sent it. So the first of two equal replies counts from when it was
   * read, and the second until it was asked for: the time between them is certain.
   */
  isStalled(reply: string, asked: PollTime, now: StreamPosition): boolean {
    const steps = parseSteps(reply).join();
    if (this.lastChange?.steps !== steps) {
      this.lastChange = { steps, sinceS: this.clock.nowS(), planned: plannedSteps(now) };
      return false;
    }
    const { sinceS, planned: before } = this.lastChange;
    const planned = plannedSteps(asked.place);
    const moved = Math.max(Math.abs(planned[0] - before[0]), Math.abs(planned[1] - before[1]));
    return asked.clockS - sinceS > STALL_S * this.speed && moved > MOVED_STEPS;
  }
}

/** Step counts at a time of a stream, interpolated linearly within a command. */
function plannedSteps({ stream, commandIndex, planS }: StreamPosition): readonly [number, number] {
  const before = Math.max(0, commandIndex - 1);
  const [fromS, toS] = [stream.planS[commandIndex], stream.planS[commandIndex + 1]];
  const share = toS > fromS ? Math.min(1, Math.max(0, (planS - fromS) / (toS - fromS))) : 1;
  const between = (steps: Int32Array): number =>
    steps[before] + share * (steps[commandIndex] - steps[before]);
  return [between(stream.steps1), between(stream.steps2)];
}
