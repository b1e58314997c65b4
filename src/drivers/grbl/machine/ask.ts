/** Asks a device whether it is a Grbl. It may be any other device with such a USB chip, so nothing but questions is sent. */
import { LineSession } from "../../line-session.js";
import { delay, type Clock, type Transport } from "../../transport.js";
import { INFO, isGreeting, isReport, mayBeDrawCore, NOW, OWN_VERSION, versionAfter } from "../protocol.js";

const POLL_S = 0.2;
/** An Arduino restarts when its port is opened, and does not answer for up to two seconds. */
const STATUS_TRIES = 15;
const INFO_TRIES = 5;

/** See `Driver.ask`. */
export async function askGrbl(transport: Transport, clock: Clock): Promise<string | null> {
  let isGrbl = false;
  let isGreeted = false;
  let version: string | null = null;
  const lines = new LineSession(
    transport,
    {
      lineEnd: "\n",
      take: (line) => {
        isGreeted ||= isGreeting(line);
        isGrbl ||= isGreeted || isReport(line);
        version = versionAfter(line, version);
      },
      silent: () => undefined,
      ended: () => undefined,
    },
    { clock },
  );
  const until = async (isDone: () => boolean, tries: number, ask: () => void): Promise<void> => {
    for (let i = 0; i < tries && !isDone() && lines.failure === null; i++) {
      ask();
      await delay(clock, POLL_S);
    }
  };
  try {
    await until(
      () => isGrbl,
      STATUS_TRIES,
      () => lines.writeText(NOW.status),
    );
    if (!isGrbl) return null;
    // An earlier program may have left an unfinished line, which spoils the first question.
    await until(
      () => version !== null,
      INFO_TRIES,
      () => lines.writeLines([INFO]),
    );
    if (!isGreeted && mayBeDrawCore(version)) {
      lines.writeLines([OWN_VERSION]);
      await delay(clock, POLL_S);
    }
    // One in motion or asleep does not tell its version.
    return version ?? "Grbl";
  } finally {
    await lines.close();
  }
}
