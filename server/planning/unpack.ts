/**
 * A large JSON upload, taken apart in a thread of its own: reading 100 MB of JSON takes so long that a board
 * which is plotting would run dry meanwhile.
 */
import { PlotwrightError } from "../../src/index.js";
import { startWorker } from "./worker-entry.js";

export interface UnpackInput {
  /** File with `{ …, "drawing": "<svg …" }`. */
  readonly path: string;
  /** Where the drawing's text goes. */
  readonly drawingPath: string;
}

export type Unpacked = { readonly rest: unknown; readonly drawingBytes: number } | { readonly fault: string };

/** Writes the drawing to its file and returns the rest of the object; throws `bad-setting`. */
export async function unpackUpload(input: UnpackInput): Promise<{ rest: unknown; drawingBytes: number }> {
  const worker = startWorker("unpack-worker", import.meta.url, { workerData: input });
  try {
    const answer = await new Promise<Unpacked>((resolve, reject) => {
      worker.once("message", resolve);
      worker.once("error", reject);
      worker.once("exit", () => reject(new Error("The unpacking thread ended without an answer")));
    });
    if ("fault" in answer) throw new PlotwrightError("bad-setting", answer.fault);
    return answer;
  } finally {
    await worker.terminate();
  }
}
