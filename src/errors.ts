/** The codes of `PlotwrightError`. */
export const ERROR_CODES = [
  "bad-file",
  "too-large",
  "bad-setting",
  "out-of-bounds",
  "no-board",
  "busy",
  "board-error",
  "board-timeout",
  "disconnected",
  "not-found",
  "conflict",
  "not-allowed",
  "not-operator",
  "cancelled",
  "disk-full",
  "internal",
] as const;

/** The kind of failure. Stable: programs may depend on it. */
export type ErrorCode = (typeof ERROR_CODES)[number];

/**
 * An expected failure (a bad file, a wrong setting, a lost board): `message` says what is wrong, where, and what to do.
 * Mistakes of the calling program, such as NaN, throw RangeError or TypeError instead. Problems in a drawing that can
 * still be plotted are warnings in the result.
 */
export class PlotwrightError extends Error {
  /** "PlotwrightError". */
  override readonly name = "PlotwrightError";
  /** The kind of failure. */
  readonly code: ErrorCode;

  constructor(code: ErrorCode, message: string, options?: { cause?: unknown }) {
    super(message, options);
    this.code = code;
  }
}

/** The HTTP status and the exit code of each error code. */
export const ERROR_TABLE: Readonly<
  Record<ErrorCode, { readonly httpStatus: number; readonly exitCode: number }>
> = {
  "bad-file": { httpStatus: 422, exitCode: 3 },
  "too-large": { httpStatus: 413, exitCode: 3 },
  "bad-setting": { httpStatus: 400, exitCode: 2 },
  "out-of-bounds": { httpStatus: 422, exitCode: 3 },
  "no-board": { httpStatus: 503, exitCode: 4 },
  busy: { httpStatus: 409, exitCode: 4 },
  "board-error": { httpStatus: 502, exitCode: 5 },
  "board-timeout": { httpStatus: 504, exitCode: 5 },
  disconnected: { httpStatus: 503, exitCode: 5 },
  "not-found": { httpStatus: 404, exitCode: 3 },
  conflict: { httpStatus: 409, exitCode: 5 },
  "not-allowed": { httpStatus: 403, exitCode: 5 },
  "not-operator": { httpStatus: 409, exitCode: 5 },
  cancelled: { httpStatus: 409, exitCode: 5 },
  "disk-full": { httpStatus: 507, exitCode: 5 },
  internal: { httpStatus: 500, exitCode: 5 },
};
