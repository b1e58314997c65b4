/** Finds out which Grbl is connected, and waits until it has drawn what an earlier process has sent. */
import type { SessionLog } from "../../session-log.js";
import { delay, type Clock } from "../../transport.js";
import { SYNC } from "../grbl-job.js";
import { CHECK, INFO, isHeld, isMoving, mayBeDrawCore, NOW, OWN_VERSION, type Status } from "../protocol.js";

/** What is needed of its session. */
interface AskedGrbl {
  readonly clock: Clock;
  readonly log: SessionLog;
  /** As far as it is known. */
  readonly version: string | null;
  /** It has said that it has started. */
  readonly isGreeted: boolean;
  readonly lastStatus: Status | null;
  /** The first report of the parser's modes; "": none. */
  foundModes: string;
  /** It was stopped before it had drawn what an earlier process had sent. */
  isCutShort: boolean;
  now(byte: string): void;
  send(line: string): Promise<void>;
}

/** How long it may take for an answer, s. */
const ANSWER_S = 1;
const POLL_S = 0.2;
/** How long a Grbl may take for what is in its buffers, s. */
const FINISH_S = 60;
/** How long a device may talk while it starts, s. Later it is no Grbl if it has not reported its status. */
const START_S = 3;
/** Time for braking. */
const HOLD_S = 0.5;

/** Returns the version; null if it is still unknown. Lines may be left unanswered. `isAgain`: an earlier attempt has failed. */
export async function askVersion(grbl: AskedGrbl, isAgain: boolean): Promise<string | null> {
  // A Grbl that sleeps, holds or works for another program answers only after a reset. Reset in motion it is locked.
  if (isAgain) {
    const { state = "" } = grbl.lastStatus ?? {};
    grbl.isCutShort ||= isMoving(state) || isHeld(state);
    if (isMoving(state)) {
      grbl.now(NOW.hold);
      await delay(grbl.clock, HOLD_S);
    }
    grbl.now(NOW.reset);
    grbl.foundModes = "";
  }
  // "$" asks for help. It spoils a line that was left unfinished, such as G1X1 of G1X100, so that it is refused. "$I" is
  // refused in motion.
  const lines = ["$", "", CHECK, SYNC, INFO];
  await untilQuiet(grbl, Promise.allSettled(lines.map((line) => grbl.send(line))), isAgain);
  // Only its greeting says so otherwise, and none comes if it was running already.
  if (!grbl.isGreeted && mayBeDrawCore(grbl.version)) {
    await Promise.race([grbl.send(OWN_VERSION).catch(() => undefined), delay(grbl.clock, ANSWER_S)]);
  }
  return grbl.version;
}

/**
 * A Grbl may still draw what a process that has ended has sent. It answers late then, and first to those lines. Its place
 * is known only at the end. `isAgain`: a reply to an earlier attempt must not count for a later line.
 */
async function untilQuiet(grbl: AskedGrbl, answered: Promise<unknown>, isAgain: boolean): Promise<void> {
  const { clock, log } = grbl;
  let isAnswered = false;
  void answered.then(() => (isAnswered = true));
  const startS = clock.nowS();
  let quietSinceS = startS;
  while (clock.nowS() < startS + FINISH_S && clock.nowS() - quietSinceS < ANSWER_S) {
    const { count } = log;
    grbl.now(NOW.status);
    await Promise.race([delay(clock, POLL_S), ...(isAnswered ? [] : [answered])]);
    if (isAnswered && grbl.version !== null && !isAgain && clock.nowS() < startS + POLL_S) return;
    const isGrbl = grbl.lastStatus !== null || clock.nowS() < startS + START_S;
    const isBusy = log.count > count || (grbl.lastStatus !== null && isMoving(grbl.lastStatus.state));
    if (isGrbl && isBusy && !isAgain) quietSinceS = clock.nowS();
  }
}
