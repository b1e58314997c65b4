/**
 * A clock that stands still while its process is not run. For a board: a real one is never descheduled, so time that
 * the machine took from the virtual one must not count as time in which its host sent nothing. And for what must be
 * done within seconds: a computer that stops the program for a while says nothing of the program.
 *
 * A heartbeat every few ms tells: one that comes late was a sleep of the whole process.
 */
import type { Clock } from "../../src/index.js";
import { nodeClock } from "../../server/serial/node-clock.js";
import { cpuS } from "./watchdog.js";

const BEAT_S = 0.004;
/** Late by less is the timer's own roughness. */
const LATE_S = 0.01;

export interface WakefulClock extends Clock {
  /** Seconds that it stood still, in all. */
  readonly sleptS: () => number;
}

/** `countsWork`: it goes on while its process works for so long that the heartbeat is late. */
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
