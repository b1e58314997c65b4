/** The bytes of stdin. They are read once and stored, since several options may need them (--config -). */
import { readFileSync } from "node:fs";

let bytes: Uint8Array | null = null;

export function readStdin(): Uint8Array {
  bytes ??= readFileSync(0);
  return bytes;
}
