/** What a long computation needs of its caller, as src has no clock and no signals of its own. */
import { PlotwrightError } from "../errors.js";

export interface Work {
  /** Looked at often; an AbortSignal fits. */
  readonly cancel?: { readonly aborted: boolean } | undefined;
  /** Set when the best that has been found so far will do. */
  readonly enough?: { readonly aborted: boolean } | undefined;
  /** Seconds of some clock that never runs backwards. */
  readonly nowS?: (() => number) | undefined;
  /** Fraction done, 0 … 1, never falling, and what is being done. */
  readonly onProgress?: ((done: number, step: string) => void) | undefined;
}

/** Throws `cancelled` once the caller has asked to stop. */
export function stopIfCancelled(work: Work): void {
  if (work.cancel?.aborted) throw new PlotwrightError("cancelled", "Preparing the drawing was cancelled.");
}
