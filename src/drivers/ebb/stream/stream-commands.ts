import type { CommandStream } from "../compile/command-stream.js";
import type { BoardSession } from "./session.js";
import type { StreamOptions, StreamReport } from "./stream-types.js";
import { Streamer } from "./streamer.js";
import type { StreamPosition } from "./timeline.js";
import type { Cancellation } from "../../../prepare/work.js";

/** Progress of a plot. */
export interface StreamProgress extends StreamPosition {
  /** Share of the plot's time that is done, 0 … 1. */
  readonly fraction: number;
  /** Remaining time of the plot, seconds. */
  readonly leftS: number;
}

/**
 * Sends a command stream, waits until the board has executed it, and compares the board's step counters with the
 * prediction. After `cancel`, it sends no more commands and ends when those already sent are done. If `cancel` is
 * aborted from the start, it sends nothing, and the report has no step counters.
 */
export async function streamCommands(
  session: BoardSession,
  stream: CommandStream,
  options: StreamOptions & {
    readonly cancel?: Cancellation;
    readonly onProgress?: (progress: StreamProgress) => void;
    /**
     * Board seconds between calls of `onProgress`, and between checks of `cancel`. Default 0.06. The last call is made
     * when the plot has ended.
     */
    readonly progressEveryS?: number;
  },
): Promise<StreamReport & { readonly underrunCount: number }> {
  if (options.cancel?.aborted) {
    const end = { stream, commandIndex: -1, planS: stream.planS[0] };
    return { steps1: null, steps2: null, exact: true, end, complete: false, underrunCount: 0 };
  }
  const streamer = new Streamer(session, options);
  let stopTicking = (): void => undefined;
  const tick = (): void => {
    if (options.cancel?.aborted && streamer.playing) streamer.cut();
    else options.onProgress?.(progressOf(streamer.position()));
    stopTicking = options.clock.after(options.progressEveryS ?? 0.06, tick);
  };
  const played = streamer.play(stream);
  tick();
  try {
    const report = await played;
    const { end } = report;
    // Where the last command ends; for an empty stream, where it starts.
    options.onProgress?.(progressOf({ ...end, planS: end.stream.planS[end.commandIndex + 1] }));
    return { ...report, underrunCount: streamer.underrunCount };
  } finally {
    stopTicking();
  }
}

function progressOf(place: StreamPosition): StreamProgress {
  const { planS, count } = place.stream;
  const fromS = planS[0];
  const toS = planS[count];
  const fraction = toS > fromS ? Math.min(1, Math.max(0, (place.planS - fromS) / (toS - fromS))) : 1;
  return { ...place, fraction, leftS: Math.max(0, toS - place.planS) };
}
