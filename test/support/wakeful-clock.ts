/**
 * A board's clock that stands still while its process is not run: a real board is never descheduled, so time that
 * the machine took from the virtual one must not count as time in which its host sent nothing.
 *
 * A heartbeat every few ms tells: one that comes late was a sleep of the whole process.
 */
import type { Clock } from "../../src/index.js";
import { nodeClock } from "../../server/serial/node-clock.js";

const BEAT_S = 0.004;
/** Late by less is the timer's own roughness. */
const LATE_S = 0.01;

export interface WakefulClock extends Clock {
  /** Seconds that it stood still, in all. */
  readonly sleptS: () => number;
}

export function wakefulClock(): WakefulClock {
  let sleptS = 0;
  let seenS = nodeClock.nowS();
  const look = (): number => {
    const nowS = nodeClock.nowS();
    if (nowS - seenS > BEAT_S + LATE_S) sleptS += nowS - seenS - BEAT_S;
    seenS = nowS;
    return nowS;
  };
  setInterval(look, 1_000 * BEAT_S).unref();
  return { nowS: () => look() - sleptS, after: nodeClock.after, sleptS: () => sleptS };
}
