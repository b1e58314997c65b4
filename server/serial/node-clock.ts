import { performance } from "node:perf_hooks";
import type { Clock } from "../../src/index.js";

/** The machine's monotonic clock, for everything that takes a `Clock`. */
export const nodeClock: Clock = {
  nowS: () => performance.now() / 1000,
  after(delayS, callback) {
    const timer = setTimeout(callback, Math.max(0, delayS * 1000));
    return () => clearTimeout(timer);
  },
};

/**
 * A clock that counts the seconds of a board which runs `speed` times faster than ours.
 * A stream measured on it keeps its window of time ahead whatever the speed.
 */
export function scaledClock(clock: Clock, speed: number): Clock {
  if (speed === 1) return clock;
  return {
    nowS: () => clock.nowS() * speed,
    after: (delayS, callback) => clock.after(delayS / speed, callback),
  };
}
