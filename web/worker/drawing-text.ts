/** The text of a drawing, as the page keeps it and hands it to the worker. */
import { encodingOf, textOfBytes } from "../../src/internal.js";

/** A large file's comes as it was read, in UTF-8: to make a string of it, and to copy that, would hold up the page. */
export type DrawingText = string | ArrayBuffer;

/** Files as large as this are kept as they were read: only the worker makes text of them. */
export const LARGE_BYTES = 1_000_000;

/** Text; the bytes of a large file as they are, if they are UTF-8: decoding them would hold up the page. */
export const contentOf = (buffer: ArrayBuffer): DrawingText => {
  const bytes = new Uint8Array(buffer);
  return bytes.length >= LARGE_BYTES && encodingOf(bytes) === "utf-8" ? buffer : textOfBytes(bytes);
};
