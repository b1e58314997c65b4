/** Grbl's replies and real-time commands. */
import { PlotwrightError } from "../../errors.js";
import { difference, type Axes } from "./model/planner.js";

/** Real-time commands: single bytes that act at once, need no line end and no room in the buffer, and get no `ok`. */
export const NOW = { status: "?", hold: "!", reset: "\x18" } as const;

/** Max unanswered characters, including line ends: the buffer of an Arduino. */
export const RX_BYTES = 128;

export const isGreeting = (line: string): boolean => /^Grbl(HAL)? /.test(line);

/** The version in a greeting or in the reply to `$I`, such as "Grbl 1.1h"; null if the line has none. */
export function versionOf(line: string): string | null {
  const match = /^Grbl(?:HAL)? ([\w.]+)/.exec(line) ?? /^\[VER:([\w.]*[a-z\d])/.exec(line);
  if (!match) return null;
  // Drop the date of "1.1h.20190830".
  return `Grbl ${match[1].replace(/\.\d{6,}$/, "")}`;
}

/** The queue of moves and the receive buffer given by `[OPT:V,15,128]`; null if there are none. */
export function buffersOf(line: string): { queueMoves: number; rxBytes: number } | null {
  const match = /^\[OPT:[^,\]]*,(\d+),(\d+)/.exec(line);
  return match && { queueMoves: Number(match[1]), rxBytes: Number(match[2]) };
}

export interface Status {
  /** "Idle", "Run", "Hold:0" … */
  readonly state: string;
  /** Work position, mm. */
  readonly at: Axes;
}

/** Work offset of a report; not every report has one. */
export const offsetOf = (line: string): Axes | null => axesOf(/\|WCO:([^|>]+)/.exec(line)?.[1]);

/** A status report; null for another line. `offset`: the last reported work offset. */
export function statusOf(line: string, offset: Axes): Status | null {
  const state = /^<([^|>]+)/.exec(line)?.[1];
  if (state === undefined) return null;
  const work = axesOf(/\|WPos:([^|>]+)/.exec(line)?.[1]);
  const machine = axesOf(/\|MPos:([^|>]+)/.exec(line)?.[1]);
  if (work) return { state, at: work };
  return machine && { state, at: difference(machine, offset) };
}

function axesOf(text: string | undefined): Axes | null {
  const [x, y, z] = (text ?? "").split(",").map(Number);
  return Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z) ? [x, y, z] : null;
}

const ERRORS: Readonly<Record<number, string>> = {
  8: "the machine must be idle for that",
  9: "the machine is locked after an alarm",
  11: "the line is too long",
  15: "the target is outside the machine's travel",
  20: "Grbl does not know that command",
  22: "no feed rate was set",
  33: "the target is invalid",
};

export const refusal = (line: string, code: number): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    `The Grbl refused ${line} with error:${code}${ERRORS[code] ? ` (${ERRORS[code]})` : ""}: check the machine's profile against its settings ($$).`,
  );

const ALARMS: Readonly<Record<number, string>> = {
  1: "a limit switch was hit",
  2: "the target is beyond the soft limits",
  3: "the machine was reset during a motion",
};

export const alarm = (code: number): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    `The Grbl has stopped with ALARM:${code}${ALARMS[code] ? ` (${ALARMS[code]})` : ""}. Check the carriage's position, and push it to home before you resume.`,
  );

export const restarted = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The Grbl has restarted: its reset button was pressed, or its supply failed. Push the carriage to home before you resume.",
  );
