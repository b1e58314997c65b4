/** Stdin as it is. It can be read once, and may be asked for more than once (the settings of --config -). */
import { readFileSync } from "node:fs";

let bytes: Uint8Array | null = null;

export function readStdin(): Uint8Array {
  bytes ??= readFileSync(0);
  return bytes;
}
