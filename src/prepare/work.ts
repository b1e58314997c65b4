/**
 * What a long computation takes from outside: progress, cancelling and time, injected by the caller because src has no
 * clock; and random numbers, the same ones in every run.
 */
import { PlotwrightError } from "../errors.js";

/** Asks a long computation to stop. An AbortSignal fits. */
export interface Cancellation {
  readonly aborted: boolean;
}

/** Progress and cancelling of a long computation. Everything is optional. */
export interface Work {
  /** Checked often. */
  readonly cancel?: Cancellation | undefined;
  /** Set to stop the search early and use the best result so far. */
  readonly enough?: Cancellation | undefined;
  /** Seconds of a monotonic clock. */
  readonly nowS?: (() => number) | undefined;
  /** Fraction done, 0 … 1, never decreasing, and the name of the current step. */
  readonly onProgress?: ((done: number, step: string) => void) | undefined;
}

/** Throws `cancelled` if the caller has asked to stop. */
export function stopIfCancelled(work: Work): void {
  if (work.cancel?.aborted) throw new PlotwrightError("cancelled", "Preparing the drawing was cancelled.");
}

/** Random numbers, so that a plan can be reproduced from the same drawing. (Mulberry32 by T. Ettinger, public domain) */
export function randomFrom(seed: number): () => number {
  let state = seed | 0;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t = (t + Math.imul(t ^ (t >>> 7), t | 61)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}
