/** Text to bytes and bytes to lines. All controllers use ASCII only. */
const CR = 13;
const LF = 10;
/** The board never sends longer lines; further bytes are noise. */
const MAX_LINE_BYTES = 256;

export function asciiBytes(text: string): Uint8Array {
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/**
 * Splits incoming bytes into lines at any run of CR and LF. Drops empty lines, control bytes
 * and bytes above 126.
 */
export class LineSplitter {
  private pending = "";

  push(bytes: Uint8Array, onLine: (line: string) => void): void {
    for (const byte of bytes) {
      if (byte === CR || byte === LF) {
        const line = this.pending;
        this.pending = "";
        if (line.length > 0) onLine(line);
      } else if (byte >= 32 && byte < 127 && this.pending.length < MAX_LINE_BYTES) {
        this.pending += String.fromCharCode(byte);
      }
    }
  }
}
