/** Which machine a name means. Apart from set-up.ts, because a page needs it at once. */
import type { MachineProfile } from "./profile.js";
import { MACHINES } from "./profiles.js";

const lettersOf = (text: string): string => text.toLowerCase().replace(/[^a-z0-9]/g, "");

/** The built-in machine that a board's own name tells; null: it tells none. "My NextDraw 8511" is a NextDraw 8511. */
export function machineNamed(boardName: string): MachineProfile | null {
  const letters = lettersOf(boardName);
  const named = MACHINES.filter(({ name }) => letters.includes(lettersOf(name)));
  // "AxiDraw V3/A3" also contains "AxiDraw V3".
  return named.sort((a, b) => b.name.length - a.name.length)[0] ?? null;
}
