/**
 * Parses a large JSON upload in a separate thread. Parsing 100 MB of JSON takes so long that the stream to a
 * plotting board would underrun.
 */
import { PlotwrightError, type ErrorCode } from "../../src/index.js";
import { BoundedThread } from "./bounded-thread.js";
import { PLANNING_LIMITS } from "./planning-limits.js";

/** Bodies up to this size are parsed in the main thread. Also the limit of an upload without its drawing. */
export const MAX_PARSED_BYTES = 200_000;
const UNPACK_S = 60;

export interface UnpackInput {
  /** File with `{ …, "drawing": "<svg …" }`. */
  readonly path: string;
  /** Where the drawing's text goes. */
  readonly drawingPath: string;
  readonly maxRestChars: number;
}

/** `rest`: the other members, as JSON text. */
export type Unpacked =
  | { readonly rest: string; readonly drawingBytes: number }
  | { readonly code: ErrorCode; readonly fault: string };

/** Writes the drawing to its file and returns the rest of the object; throws `bad-setting` or `too-large`. */
export async function unpackUpload(
  files: Omit<UnpackInput, "maxRestChars">,
): Promise<{ rest: unknown; drawingBytes: number }> {
  const workerData: UnpackInput = { ...files, maxRestChars: MAX_PARSED_BYTES };
  const { heapMb, growthMb } = PLANNING_LIMITS;
  const start = { name: "unpack-worker", starterUrl: import.meta.url, heapMb, growthMb };
  const answer = await new Promise<Unpacked>((resolve, reject) => {
    const thread = new BoundedThread<Unpacked>({ ...start, workerData }, { message: resolve, ended: reject });
    const error = new PlotwrightError("too-large", `The request takes longer than ${UNPACK_S} s to read.`);
    thread.allow({ s: UNPACK_S, error });
  });
  if ("fault" in answer) throw new PlotwrightError(answer.code, answer.fault);
  return { rest: JSON.parse(answer.rest) as unknown, drawingBytes: answer.drawingBytes };
}
