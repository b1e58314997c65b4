import { performance } from "node:perf_hooks";
import type { Clock } from "../../src/index.js";

/** The computer's monotonic clock as a `Clock`. */
export const nodeClock: Clock = {
  nowS: () => performance.now() / 1000,
  after(delayS, callback) {
    const timer = setTimeout(callback, Math.max(0, delayS * 1000));
    return () => clearTimeout(timer);
  },
};

/**
 * The clock of a virtual board that runs `speed` times faster than real time.
 * A stream that uses it keeps the same window of board time ahead at any speed.
 */
export function scaledClock(clock: Clock, speed: number): Clock {
  if (speed === 1) return clock;
  return {
    nowS: () => clock.nowS() * speed,
    after: (delayS, callback) => clock.after(delayS / speed, callback),
  };
}
