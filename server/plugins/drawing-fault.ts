import { PlotwrightError, type ErrorCode } from "../../src/index.js";

/** `too-large` is missing: it depends on what else uses this computer's memory now. */
const DRAWING_FAULTS: readonly ErrorCode[] = ["bad-file", "bad-setting", "out-of-bounds"];

/** Whether the drawing or its settings are at fault, so that plotting it would fail again, on any server. */
export const isDrawingFault = (error: unknown): boolean =>
  error instanceof PlotwrightError && DRAWING_FAULTS.includes(error.code);
