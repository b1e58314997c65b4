/**
 * A clock that stops while its process is not scheduled. Used for a virtual board: a real one is never
 * descheduled, so time in which the virtual one was suspended must not count as time in which its host
 * sent nothing. Also used for time limits, which must not fail because the computer suspended the program.
 *
 * A heartbeat every few ms detects this: a late one means that the whole process was suspended.
 */
import type { Clock } from "../../../src/index.js";
import { nodeClock } from "../../../server/serial/node-clock.js";
import { cpuS } from "./watchdog.js";

const BEAT_S = 0.004;
/** A smaller delay is the timer's own jitter. */
const LATE_S = 0.01;

interface WakefulClock extends Clock {
  /** Total seconds that it was stopped. */
  readonly sleptS: () => number;
}

/** `countsWork`: it keeps running while its process works for so long that the heartbeat is late. */
export function wakefulClock({ countsWork = false } = {}): WakefulClock {
  let sleptS = 0;
  let seenS = nodeClock.nowS();
  let mark = process.cpuUsage();
  const look = (): number => {
    const nowS = nodeClock.nowS();
    const lateS = nowS - seenS - BEAT_S;
    if (lateS > LATE_S) sleptS += Math.max(0, countsWork ? lateS - cpuS(mark) : lateS);
    if (countsWork) mark = process.cpuUsage();
    seenS = nowS;
    return nowS;
  };
  setInterval(look, 1_000 * BEAT_S).unref();
  return { nowS: () => look() - sleptS, after: nodeClock.after, sleptS: () => sleptS };
}
