import { readFileSync } from "node:fs";
import { openOutlineFont, PlotwrightError, type ImportOptions } from "../../src/index.js";
import { textOfBytes } from "../../src/internal.js";
import { fileFault } from "../storage/file-fault.js";

/** The file's text, whatever its encoding; throws `bad-file` with the reason if it can't be read. */
export function readDrawing(file: string): string {
  return textOfBytes(readBytes(file));
}

/** The file's bytes; throws `bad-file` with the reason if it can't be read. */
export function readBytes(file: string): Buffer<ArrayBuffer> {
  try {
    return readFileSync(file);
  } catch (cause) {
    throw new PlotwrightError("bad-file", `${file} can't be read: ${fileFault(cause)}.`, { cause });
  }
}

/** For `importDrawing`: text is drawn in the outlines of this font file. Throws `bad-setting` if it is not a font. */
export async function inFont(file: string | undefined): Promise<Pick<ImportOptions, "text" | "font">> {
  if (file === undefined) return {};
  try {
    return { text: "outline", font: await openOutlineFont(readFileSync(file)) };
  } catch (cause) {
    const why = cause instanceof PlotwrightError ? cause.message : `it can't be read: ${fileFault(cause)}.`;
    throw new PlotwrightError("bad-setting", `--font ${file}: ${why}`, { cause });
  }
}
