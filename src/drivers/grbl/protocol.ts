/** Grbl's replies and real-time commands. */
import { PlotwrightError } from "../../errors.js";
import { HEIGHT_AGAIN, homeAgain } from "../faults.js";
import { alarmWords, errorWords } from "./codes.js";
import { difference, sum, type Axes } from "./model/planner.js";

/** Real-time commands: single bytes that act at once, need no line end and no room in the buffer, and get no `ok`. */
export const NOW = { status: "?", hold: "!", reset: "\x18" } as const;

/** The receive buffer of an Arduino, in characters, including line ends. */
export const RX_BYTES = 128;

/** Asks for version and buffers. Changes nothing; refused in motion. */
export const INFO = "$I";

/** Asks a DrawCore for its version, which it tells without an `ok`; others refuse it. */
export const OWN_VERSION = "v";

/** Brings the carriage to its switches. The Grbl says nothing until it is there. */
export const HOME = "$H";

/** Reports the parser's modes, as a line that begins with MODES_REPORT, and changes nothing. */
export const CHECK = "$G";
export const MODES_REPORT = "[GC:";

/** Ends a lock. */
export const UNLOCK = "$X";

/** The S of a spindle that runs, in a report of the modes; null if it stands, as after a reset. */
export function servoSignalOf(modes: string): number | null {
  const signal = /\bM[34]\b.*\bS([\d.]+)/.exec(modes)?.[1];
  return signal === undefined ? null : Number(signal);
}

/** Grbl and its children: plain, grblHAL, FluidNC and DrawCore. */
const GREETING = /^(?:Grbl(?:HAL)? [\w.]|DrawCore V)/i;

export const isGreeting = (line: string): boolean => GREETING.test(line);

/**
 * The version in a greeting or in the reply to `$I`: "Grbl 1.1h", "grblHAL 1.1f", "FluidNC 3.7.16", "DrawCore 2.09"; null if
 * the line has none.
 */
export function versionOf(line: string): string | null {
  const child = /\b(FluidNC|DrawCore) v?(\d[\w.]*)/i.exec(line);
  if (child && (isGreeting(line) || line.startsWith("[VER:"))) {
    return `${child[1].toLowerCase() === "fluidnc" ? "FluidNC" : "DrawCore"} ${withoutDate(child[2])}`;
  }
  const hal = /^GrblHAL ([\w.]+)/i.exec(line);
  if (hal) return `grblHAL ${withoutDate(hal[1])}`;
  // 0.9 reports its version without a name.
  const plain =
    /^Grbl ([\w.]+)/.exec(line) ?? /^\[VER:([\w.]*[a-z\d])/.exec(line) ?? /^\[(0\.\d\w?\.\d{6,}):/.exec(line);
  return plain && `Grbl ${withoutDate(plain[1])}`;
}

/** The version after one more line of the board; null: still unknown. */
export function versionAfter(line: string, before: string | null): string | null {
  if (line === HAL_FIRMWARE) return before?.replace(/^Grbl /, "grblHAL ") ?? null;
  const version = versionOf(line);
  // A child's greeting names it; its reply to `$I` may only have the number of the Grbl from which it comes.
  const isLess = before !== null && version?.startsWith("Grbl 1.");
  return version === null || isLess ? before : version;
}

/** A DrawCore may say in its reply to `$I` only from which Grbl it comes. */
export const mayBeDrawCore = (version: string | null): boolean => version?.startsWith("Grbl 1.") === true;

/** Drops the date of "1.1h.20190830". */
const withoutDate = (version: string): string => version.replace(/\.\d{6,}$/, "");

/** Versions before 1.1 have more blocks than their successors, and say so nowhere. */
export const isOldVersion = (version: string): boolean => version.startsWith("Grbl 0.");
export const OLD_QUEUE_MOVES = 17;

/** The queue of moves and the receive buffer given by `[OPT:V,15,128]`; null if there are none. */
export function buffersOf(line: string): { queueMoves: number; rxBytes: number } | null {
  const match = /^\[OPT:[^,\]]*,(\d+),(\d+)/.exec(line);
  return match && { queueMoves: Number(match[1]), rxBytes: Number(match[2]) };
}

/** Whether `[OPT:VC,15,128]` says that a plain Grbl is built for CoreXY. */
export const isBuiltForCore = (line: string): boolean => /^\[OPT:[^,\]]*C/.test(line);

/** A line of the reply to `$I`, whose version is that of the Grbl from which grblHAL comes. */
const HAL_FIRMWARE = "[FIRMWARE:grblHAL]";

export interface Status {
  /** "Idle", "Run", "Hold:0" …; "Hold" of version 0.9, which brakes or stands. */
  readonly state: string;
  /** Work position, mm. */
  readonly at: Axes;
  /** The same in machine coordinates, which begin at 0 with each start. */
  readonly machineAt: Axes;
}

/** Machine coordinates begin at 0 with each start. */
export const hasRestarted = ({ machineAt }: Status): boolean => machineAt.every((mm) => mm === 0);

/** Whether the machine moves, or will move, without another command. */
export const isMoving = (state: string): boolean => /^(Run|Jog|Home|Hold:1|Door:[234])/.test(state);

/** Whether a hold would brake it. */
export const isRunning = (state: string): boolean => /^(Run|Jog)/.test(state);

/** A button of the machine, its door or another program holds it. */
export const isHeld = (state: string): boolean => /^(Hold|Door)/.test(state);

/** Its door is open, or was and nobody has resumed since. */
export const isAtDoor = (state: string): boolean => state.startsWith("Door");

export const isLocked = (state: string): boolean => state.startsWith("Alarm");

/** It answers lines, but only checks them. */
export const isChecking = (state: string): boolean => state === "Check";

/** Another program moves it by hand. */
export const isJogging = (state: string): boolean => state === "Jog";

/** Its motors are off. */
export const isSleeping = (state: string): boolean => state === "Sleep";

/** It stands still, and moves only after a reset. */
export const needsReset = (state: string): boolean => isHeld(state) || isChecking(state) || isSleeping(state);

/** A status report that arrived whole. */
const REPORT = /^<([^|<>]+)\|[^<>]*>$/;
/** The same of version 0.9, whose mask ($10) may leave out any field. */
const OLD_REPORT = /^<([A-Z][a-z]+)((?:,[A-Za-z]+:[-\d.]+(?:,[-\d.]+)*)*)>$/;

export const isReport = (line: string): boolean => REPORT.test(line) || OLD_REPORT.test(line);

/** Work offset of a report, in the board's units; not every report has one. */
export function offsetOf(line: string): Axes | null {
  const fields = fieldsOf(line);
  if (!fields?.isOld) return fields && axesOf(fields.text, "WCO", 1);
  const work = axesOf(fields.text, "WPos", 1);
  const machine = axesOf(fields.text, "MPos", 1);
  return work && machine && difference(machine, work);
}

/** A status report; null for another line, or a damaged one. `offset`: the last reported work offset, mm. */
export function statusOf(line: string, offset: Axes, mmPerUnit: number): Status | null {
  const fields = fieldsOf(line);
  if (!fields) return null;
  const { state, text } = fields;
  const work = axesOf(text, "WPos", mmPerUnit);
  const machine = axesOf(text, "MPos", mmPerUnit);
  if (work) return { state, at: work, machineAt: machine ?? sum(work, offset) };
  return machine && { state, at: difference(machine, offset), machineAt: machine };
}

/** A report's state and its fields, each as "|Name:values|". */
function fieldsOf(line: string): { state: string; text: string; isOld: boolean } | null {
  const state = REPORT.exec(line)?.[1];
  if (state !== undefined) return { state, text: line, isOld: false };
  const old = OLD_REPORT.exec(line);
  return old && { state: old[1], text: `${old[2].replace(/,(?=[A-Za-z])/g, "|")}|`, isOld: true };
}

function axesOf(report: string, name: string, mmPerUnit: number): Axes | null {
  const field = new RegExp(`\\|${name}:([-\\d.]+),([-\\d.]+),([-\\d.]+)[|,>]`).exec(report);
  if (!field) return null;
  const [x, y, z] = field.slice(1).map((value) => Number(value) * mmPerUnit);
  return Number.isFinite(x + y + z) ? [x, y, z] : null;
}

/** Unknown command, and what can be wrong with an arc. */
const ARC_ERRORS = [20, 33, 34, 35];

/** `reply`: "error:20", for example; what it means depends on the version. */
export function refusal(line: string, reply: string, version: string | null): PlotwrightError {
  const code = Number(reply.slice(6));
  const why = errorWords(code, version);
  const refused = `The Grbl refused ${line} with ${reply}${why ? ` (${why})` : ""}.`;
  if (line === UNLOCK) return new PlotwrightError("board-error", refused);
  const advice =
    /^G[23]/.test(line) && ARC_ERRORS.includes(code)
      ? "switch off in the machine's profile that it draws arcs"
      : "check the machine's profile against its settings ($$)";
  return new PlotwrightError("board-error", `${refused} If that happens again, ${advice}.`);
}

/** Version 0.9 has words in place of numbers, and these for all that ends a search for switches. */
const OLD_HOMING_ALARM = "Homing fail";
const OLD_ALARMS: Readonly<Record<string, number>> = {
  "Hard limit": 1,
  "Soft limit": 2,
  "Abort during cycle": 3,
  "Probe fail": 5,
  [OLD_HOMING_ALARM]: 9,
};
/** Reported by a reset during motion, or in a search for switches. */
const RESET_ALARMS: readonly (number | null)[] = [3, 6];

/** What decides how errors are told. */
interface Board {
  readonly version: string | null;
  /** The machine finds home by itself. */
  readonly findsHome: boolean;
}

export interface Alarm {
  /** Null: unknown. */
  readonly code: number | null;
  /** A reset may be its cause. */
  readonly isReset: boolean;
}

/** The alarm that a line reports; null for another line. */
export function alarmOf(line: string): Alarm | null {
  const words = /^ALARM: ?(.*)/.exec(line)?.[1];
  if (words === undefined) return null;
  const code = OLD_ALARMS[words] ?? (Number.parseInt(words) || null);
  return { code, isReset: words === OLD_HOMING_ALARM || RESET_ALARMS.includes(code) };
}

/** `name`: what the Grbl calls the alarm. */
export function alarm(
  code: number | null,
  { findsHome, version }: Board,
  name = `ALARM:${code}`,
): PlotwrightError {
  const why = code === null ? undefined : alarmWords(code, version);
  const named = code === null ? "an alarm" : `${name}${why === undefined ? "" : ` (${why})`}`;
  return new PlotwrightError(
    "board-error",
    `The Grbl has stopped with ${named}. Check the carriage's position: ${homeAgain(findsHome)}.`,
  );
}

export const boardRestartedError = (findsHome: boolean): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The Grbl has restarted: its reset button was pressed, or its supply failed. Its pen is lifted first. Its position is " +
      `lost: ${homeAgain(findsHome)}.`,
  );

/** Why a plot or a move cannot go on in this state, in which its position is lost; null for another state. */
export function stateError(state: string, board: Board): PlotwrightError | null {
  if (isLocked(state)) return alarm(Number(/\d+/.exec(state)?.[0] ?? 0) || null, board);
  const why = isSleeping(state)
    ? "it has gone to sleep, by itself or because another program sent $SLP. Its motors are off"
    : state === "Home" && "another program has sent it to its switches";
  if (!why) return null;
  return new PlotwrightError(
    "board-error",
    `The Grbl no longer draws: ${why}. Its position is lost: ${homeAgain(board.findsHome)}.`,
  );
}

/** Another program has begun something that keeps the position. */
export const otherProgram = (state: string): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    `The Grbl no longer draws: another program ${
      isChecking(state) ? "has sent $C, so that it only checks its lines" : "moves it by hand"
    }. The plot was stopped. End that program; when the plot is resumed, it draws again from the last place that is certain.`,
  );

/** The machine was stopped by its door, or by a hold that is not ours. */
export const heldError = (state: string): PlotwrightError =>
  isAtDoor(state) ? doorOpen() : new PlotwrightError("conflict", HELD);

const HELD =
  "The Grbl was held by a button of the machine or by another program, so the move was stopped. Move again to go on.";

export const doorOpen = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The Grbl's safety door is open, and nothing moves until it is closed. The pen could not be lifted: a servo has no signal " +
      "meanwhile, so the pen may rest on the paper. Close the door: the pen is lifted then, and a plot can be resumed where it stopped.",
  );

/** A lock that only the user may remove, because the Grbl wants to be homed. */
export const locked = (findsHome: boolean): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "The Grbl is locked until it is homed ($22=1), and nothing unlocks it without you. " +
      (findsHome
        ? "Home the machine: that unlocks it."
        : "If the machine has switches, switch on that it finds home with them in its profile, and home it. Otherwise lift the pen " +
          "and push the carriage to home by hand, then send $X in the console."),
  );

/** `$X` was refused for the reason in `why`, such as a pressed emergency stop; nothing but its end helps. */
export const staysLocked = (why: PlotwrightError): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    `The Grbl stays locked, and nothing moves. ${why.message} When the cause is gone, it is unlocked and the pen is lifted.`,
  );

const DOOR_REFUSAL = "error:13";
export const isDoorRefusal = (reply: string): boolean => reply === DOOR_REFUSAL;

const CABLE = "Check the USB cable and its distance from motors and mains.";

/** `line`: the first line without an answer. */
export const unanswered = (line: string, state: string): PlotwrightError =>
  new PlotwrightError(
    "board-timeout",
    `The Grbl has not confirmed ${line}, and is ${state}: the line or its answer was lost on the way. ${CABLE}`,
  );

export const outOfStep = (): PlotwrightError =>
  new PlotwrightError(
    "board-error",
    "An answer of the Grbl was lost, damaged or doubled on its way, so a line may not have been drawn. The plot " +
      `was stopped. When it is resumed, it draws again from the last place that is certain. ${CABLE}`,
  );

/** The Grbl was reset while its pen moved, so that it counts from an unknown height. */
export const withUnsureHeight = (error: PlotwrightError): PlotwrightError =>
  new PlotwrightError(error.code, `${error.message} The height of the pen is lost, too: ${HEIGHT_AGAIN}.`);

/** Added to an error after which the pen could not be lifted. */
export const NOT_LIFTED = "The pen could not be lifted: lift it by hand.";

/** A Grbl 0.9 whose mask leaves out where it is. `by`: what can change that. */
export const unplaced = (by: string): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    "The Grbl 0.9 does not report its positions in both machine and work coordinates ($10), so nothing could be drawn in its " +
      `place. Nothing has moved. Send $10=3 ${by}.`,
  );

export const noSwitches = (): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    "The profile says that the Grbl finds home with switches, but homing is off ($22=0). Nothing has moved. Send $22=1 " +
      "in the console if it has switches; otherwise switch homing off in the profile.",
  );
