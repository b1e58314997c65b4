/** Progress, cancelling and time of a long computation, injected by the caller because src has no clock. */
import { PlotwrightError } from "../errors.js";

/** Progress and cancelling of a long computation. Everything is optional. */
export interface Work {
  /** Checked often; an AbortSignal fits. */
  readonly cancel?: { readonly aborted: boolean } | undefined;
  /** Set to stop the search early and use the best result so far. */
  readonly enough?: { readonly aborted: boolean } | undefined;
  /** Seconds of a monotonic clock. */
  readonly nowS?: (() => number) | undefined;
  /** Fraction done, 0 … 1, never decreasing, and the name of the current step. */
  readonly onProgress?: ((done: number, step: string) => void) | undefined;
}

/** Throws `cancelled` if the caller has asked to stop. */
export function stopIfCancelled(work: Work): void {
  if (work.cancel?.aborted) throw new PlotwrightError("cancelled", "Preparing the drawing was cancelled.");
}
