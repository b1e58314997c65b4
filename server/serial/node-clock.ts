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
