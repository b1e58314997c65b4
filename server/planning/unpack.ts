/**
 * A large JSON upload, taken apart in a thread of its own: reading 100 MB of JSON takes so long that a board
 * which is plotting would run dry meanwhile.
 */
import { PlotwrightError, type ErrorCode } from "../../src/index.js";
import { BoundedThread } from "./bounded-thread.js";
import { PLANNING_LIMITS } from "./planning-limits.js";

/** What is parsed in the main thread at once; the most that comes back to it besides the drawing. */
export const MAX_PARSED_BYTES = 200_000;
const UNPACK_S = 60;

export interface UnpackInput {
  /** File with `{ …, "drawing": "<svg …" }`. */
  readonly path: string;
  /** Where the drawing's text goes. */
  readonly drawingPath: string;
  readonly maxRestChars: number;
}

/** rest: the other members, as JSON. */
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
