/** Decodes a file's bytes to text. The encoding comes from its first bytes, its XML declaration, or its DXF header. */
import { charOfEachByte, textOfDxf } from "./dxf/dxf-code-pages.js";
import { isHpglBegun } from "./hpgl/hpgl-reader.js";

declare const TextDecoder: new (encoding: string) => { decode(bytes: Uint8Array): string };

const HEAD_BYTES = 256;
const NON_ASCII = /[\u0080-\uffff]/;
const STARTS: readonly (readonly [encoding: string, bytes: readonly number[]])[] = [
  ["utf-8", [0xef, 0xbb, 0xbf]],
  ["utf-16be", [0xfe, 0xff]],
  ["utf-16le", [0xff, 0xfe]],
  // "<?" and "<s" without a byte order mark.
  ["utf-16be", [0, 0x3c, 0]],
  ["utf-16le", [0x3c, 0, 0x3f, 0]],
  ["utf-16le", [0x3c, 0, 0x73, 0]],
];

/** The name of the encoding, in lower case; "utf-8" if the file does not declare one. */
export function encodingOf(bytes: Uint8Array): string {
  for (const [encoding, start] of STARTS) {
    if (start.every((byte, i) => bytes[i] === byte)) return encoding;
  }
  const head = String.fromCharCode(...bytes.subarray(0, HEAD_BYTES));
  return (/^\s*<\?xml\s[^>]*?encoding\s*=\s*["']([\w.:-]+)["']/.exec(head)?.[1] ?? "utf-8").toLowerCase();
}

/**
 * Bytes that are invalid in the encoding become U+FFFD; an unknown encoding is read as UTF-8. HPGL is no text in UTF-8:
 * its encoded lines use all bytes, so each becomes the character with its number.
 */
export function textOfBytes(bytes: Uint8Array): string {
  const text = decoded(bytes);
  if (!NON_ASCII.test(text) || !isHpglBegun(text.slice(0, HEAD_BYTES))) return text;
  return text.includes("\ufffd") || hasEncodedBytes(text) ? charOfEachByte(bytes) : text;
}

/** Whether an encoded line of HPGL (PE) has other characters than ASCII: its bytes were valid UTF-8 by chance. */
function hasEncodedBytes(text: string): boolean {
  for (let at = text.indexOf("PE"); at >= 0; at = text.indexOf("PE", at)) {
    const end = text.indexOf(";", at);
    if (NON_ASCII.test(text.slice(at, end < 0 ? undefined : end))) return true;
    if (end < 0) return false;
    at = end;
  }
  return false;
}

function decoded(bytes: Uint8Array): string {
  const encoding = encodingOf(bytes);
  try {
    const dxf = encoding === "utf-8" ? textOfDxf(bytes) : null;
    return dxf ?? new TextDecoder(encoding).decode(bytes);
  } catch {
    return new TextDecoder("utf-8").decode(bytes);
  }
}
