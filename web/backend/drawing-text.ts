/** The text of a drawing, as the page stores it and passes it to the worker. */
import { encodingOf, textOfBytes } from "../../src/internal.js";

/** A large file is stored as UTF-8 bytes: decoding and copying a string would block the page. */
export type DrawingText = string | ArrayBuffer;

/** Files from this size on stay bytes. Only the worker decodes them. */
const LARGE_BYTES = 1_000_000;

export const textOf = (drawing: DrawingText): string =>
  typeof drawing === "string" ? drawing : textOfBytes(new Uint8Array(drawing));

/** Decodes a file, except a large one in UTF-8. */
export const contentOf = (buffer: ArrayBuffer): DrawingText => {
  const bytes = new Uint8Array(buffer);
  return bytes.length >= LARGE_BYTES && encodingOf(bytes) === "utf-8" ? buffer : textOfBytes(bytes);
};
