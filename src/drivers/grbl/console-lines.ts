/**
 * Decides which typed lines must not be sent: those that act within a line, those after which Grbl does not answer until
 * it is reset or resumed, and those after which it no longer moves. Lines are compared as Grbl reads them, so that
 * "n1 m00" equals "M0".
 */

const WHY_NOT: readonly (readonly [pattern: RegExp, why: string])[] = [
  [
    /M[+-]?0*[01](\.0*)?(?![\d.])/,
    "the Grbl would wait for a resume, which cannot be sent from here. For a wait, send G4P and the seconds",
  ],
  [/^\$SLP$/, "the Grbl would not answer until it is reset. Switch the motors off on the page instead"],
  [/^\$H/, "the Grbl does not answer while it seeks its switches. Home the machine on the page instead"],
  [/^\$C$/, "the Grbl would accept lines and not move. To check a drawing, look at its preview instead"],
];

/** Why a line must not be sent; null if it may. */
export function whyRefused(line: string): string | null {
  if (!/^[\x20-\x7e]{1,79}$/.test(line) || /[?!~]/.test(line)) {
    return "a line has at most 79 plain characters, and none of ? ! ~, which act at once";
  }
  const read = line.replace(/\(.*?\)|;.*|[\s/]/g, "").toUpperCase();
  return WHY_NOT.find(([pattern]) => pattern.test(read))?.[1] ?? null;
}
