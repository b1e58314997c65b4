import type { CommandStream } from "../compile/command-stream.js";
import type { BoardSession } from "./session.js";
import type { StreamOptions, StreamReport } from "./stream-types.js";
import { Streamer } from "./streamer.js";
import type { StreamPlace } from "./timeline.js";
import type { Cancellation } from "../../transport.js";

/** Plays one stream to its end, or after `cancel` is raised, until the commands already written are done. */
export async function streamCommands(
  session: BoardSession,
  stream: CommandStream,
  options: StreamOptions & {
    readonly cancel?: Cancellation;
    readonly onProgress?: (place: StreamPlace) => void;
    /** Board seconds between calls of `onProgress`, and between checks of `cancel`. Default 0.06. */
    readonly progressEveryS?: number;
  },
): Promise<StreamReport & { readonly underrunCount: number }> {
  const streamer = new Streamer(session, options);
  let stopTicking: (() => void) | null = null;
  const tick = (): void => {
    if (options.cancel?.aborted && streamer.playing) streamer.cut();
    else options.onProgress?.(streamer.place());
    stopTicking = options.clock.after(options.progressEveryS ?? 0.06, tick);
  };
  const played = streamer.play(stream);
  tick();
  try {
    const report = await played;
    return { ...report, underrunCount: streamer.underrunCount };
  } finally {
    (stopTicking as (() => void) | null)?.();
  }
}
