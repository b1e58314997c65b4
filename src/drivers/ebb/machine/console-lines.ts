/**
 * Decides which typed lines must not be sent: those that restart the board, hang it, or change how it answers. Commands
 * and numbers are compared as the board reads them, so that "cu,01,0" equals "CU,1,0".
 */
import { TICKS_PER_S, stepsPerSFromRate } from "../../../units.js";
import { commandName, MAX_LINE_BYTES } from "../protocol/replies.js";

/** Maximum duration of a typed motion, seconds of board time. */
export const LONGEST_S = 120;

const TOO_LONG = `it would move for more than ${LONGEST_S} s`;

/** More steps than the carriage of any machine is from its home, on one motor. */
const FARTHEST_STEPS = 120_000;

/** First numbers of CU that are allowed; all others change how the board answers, counts, moves or watches its supply. */
const HARMLESS_SWITCHES = [3];

type Rule = (numbers: readonly number[]) => string | null;

const never =
  (why: string): Rule =>
  () =>
    why;

const RULES: Readonly<Record<string, Rule>> = {
  BL: never("the board would leave its firmware for the boot loader"),
  RB: never("the board would restart. Unplug it and plug it in again instead"),
  R: never("it would undo what plotwright has set. Unplug the board and plug it in again instead"),
  T: never("the board would send lines that plotwright does not expect"),
  C: never("it would change the pins that drive the motors"),
  MW: never("it would write to the board's memory"),
  CU: ([which = 0]) =>
    HARMLESS_SWITCHES.includes(which)
      ? null
      : "it would change how the board answers, moves or watches its supply",
  EM: (numbers) =>
    numbers.length < 2 ? "not every firmware answers it. Give both motors, as in EM,1,1" : null,
  SM: longerMs,
  XM: longerMs,
  LT: longerTicks(1),
  T3: longerTicks(1),
  TD: longerTicks(2),
  HM: ([stepsPerS = 0, to1 = 0, to2 = 0]) =>
    (FARTHEST_STEPS + Math.max(Math.abs(to1), Math.abs(to2))) / Math.min(stepsPerS, TICKS_PER_S) > LONGEST_S
      ? `${TOO_LONG} from the far corner. Give more steps per second`
      : null,
  LM: ([rate1, steps1, accel1, rate2, steps2, accel2]) =>
    stepsTake(steps1, rate1, [accel1]) ?? stepsTake(steps2, rate2, [accel2]),
  L3: ([rate1, steps1, accel1, jerk1, rate2, steps2, accel2, jerk2]) =>
    stepsTake(steps1, rate1, [accel1, jerk1]) ?? stepsTake(steps2, rate2, [accel2, jerk2]),
};

/** Why a line must not be sent; null if it may. */
export function whyRefused(line: string): string | null {
  if (!/^[\x20-\x7e]+$/.test(line)) return "it is not one line of plain characters";
  // The board would take the rest for another line.
  if (line.length > MAX_LINE_BYTES) return `it has more than ${MAX_LINE_BYTES} characters`;
  const name = commandName(line);
  // Only the board's name may contain spaces; elsewhere firmware versions treat them differently.
  if (/ /.test(line) && name !== "ST") return "the board takes no spaces";
  const rule = Object.hasOwn(RULES, name) ? RULES[name] : undefined;
  return rule?.(numbersOf(line)) ?? null;
}

/** A line's numbers as the board reads them: digits up to the first other character; 0 without digits. */
const numbersOf = (line: string): number[] =>
  line
    .split(",")
    .slice(1)
    .map((text) => Number.parseInt(text, 10) || 0);

function longerMs([ms = 0]: readonly number[]): string | null {
  return ms > LONGEST_S * 1000 ? TOO_LONG : null;
}

function longerTicks(parts: number): Rule {
  return ([ticks = 0]) => (ticks * parts > LONGEST_S * TICKS_PER_S ? TOO_LONG : null);
}

/** If the rate changes, the duration cannot be computed from these numbers alone. */
function stepsTake(steps = 0, rate = 0, changes: readonly (number | undefined)[]): string | null {
  if (steps === 0 || changes.some((change) => change !== undefined && change !== 0)) return null;
  if (rate === 0) return "it would never end: there are steps to make at zero speed";
  const durationS = Math.abs(steps) / stepsPerSFromRate(Math.abs(rate));
  return durationS > LONGEST_S ? TOO_LONG : null;
}
