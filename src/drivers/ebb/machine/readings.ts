/** Reads the motors' supply and the button from the board's replies. */

/**
 * The second value of `QC` is the motor supply through a divider: about 300 for 9 V. Below this the supply is
 * absent or failing (the threshold that host programs use).
 */
const LOW_SUPPLY = 250;
const BUTTON_BIT = 1 << 5;

export function isPowerLow(line: string, reply: string): boolean {
  const reading = line === "QC" ? Number(reply.split(",")[1]) : Infinity;
  return reading < LOW_SUPPLY;
}

export function isButtonPressed(line: string, reply: string): boolean {
  if (line === "QG") return (Number.parseInt(reply, 16) & BUTTON_BIT) !== 0;
  return line === "QB" && Number(reply) === 1;
}
