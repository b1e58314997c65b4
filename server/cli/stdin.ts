/** Stdin as text. It can be read once, and may be asked for more than once (the settings of --config -). */
import { readFileSync } from "node:fs";

let text: string | null = null;

export function readStdin(): string {
  text ??= readFileSync(0, "utf8");
  return text;
}
