/** How Grbl and its children differ in what they say: greetings, reports and refusals. */
import { QUEUE_MOVES } from "../model/planner.js";
import { RX_BYTES } from "../protocol.js";

export const FACES = ["1.1", "0.9", "grblHAL", "FluidNC", "DrawCore"] as const;
export type FaceName = (typeof FACES)[number];

/** What a status report tells; positions as text, in the board's unit. */
export interface Reported {
  /** "Hold:0" … */
  readonly state: string;
  readonly machineAt: string;
  readonly workAt: string;
  /** The work offset, if this report has it. */
  readonly offset: string | null;
  /** Blocks and characters that are free. */
  readonly free: string;
  readonly feed: number;
  /** Its setting $10: 1 for machine positions in place of work positions, plus 2 for what is free; of 0.9: `oldReport`. */
  readonly mask: number;
}

export interface Face {
  readonly greeting: string;
  /** The answer to `$I`. */
  readonly info: readonly string[];
  readonly queueMoves: number;
  readonly rxBytes: number;
  /** The answer to `$G`. */
  modes(words: string): string;
  /** $10 as it is delivered, see `Reported`. */
  readonly mask: number;
  report(status: Reported): string;
  /** A refused line and an alarm; version 0.9 uses words. */
  error(code: number): string;
  alarm(code: number): string;
  /** What it says besides. */
  message(words: string): string;
  /** After a refused line it refuses all G-code with the same error up to an empty line or a reset. */
  readonly refusesOn: boolean;
  /** It reports its state also while it seeks its switches. */
  readonly reportsHoming: boolean;
  /** The number of the state in which it resumes after its door was open. */
  readonly doorResuming: number;
  /** It knows G2 and G3. */
  readonly takesArcs: boolean;
  /** What it leaves out of a line. */
  readonly comments: RegExp;
  /** The answer to `v`, which has no "ok"; null: it is refused. */
  readonly ownVersion: string | null;
}

const ARDUINO: Face = {
  greeting: "Grbl 1.1h ['$' for help]",
  info: ["[VER:1.1h.20190830:]", `[OPT:V,${QUEUE_MOVES},${RX_BYTES}]`],
  queueMoves: QUEUE_MOVES,
  rxBytes: RX_BYTES,
  modes: (words) => `[GC:${words}]`,
  mask: 3,
  report: ({ state, machineAt, workAt, free, feed, offset, mask }) =>
    `<${state}|${mask & 1 ? `MPos:${machineAt}` : `WPos:${workAt}`}${mask & 2 ? `|Bf:${free}` : ""}|FS:${feed},0` +
    `${offset === null ? "" : `|WCO:${offset}`}>`,
  error: (code) => `error:${code}`,
  alarm: (code) => `ALARM:${code}`,
  message: (words) => `[MSG:${words}]`,
  refusesOn: false,
  reportsHoming: false,
  doorResuming: 3,
  takesArcs: true,
  comments: /\(.*?\)|;.*/g,
  ownVersion: null,
};

/** The mask of version 0.9: 1 for machine positions, 2 for work positions, 4 and 8 for what is used of its buffers. */
function oldReport({ state, machineAt, workAt, free, mask }: Reported): string {
  const [freeMoves, freeBytes] = free.split(",").map(Number);
  const fields = [
    `MPos:${machineAt}`,
    `WPos:${workAt}`,
    `Buf:${OLD_QUEUE - freeMoves}`,
    `RX:${OLD_RX_BYTES - freeBytes}`,
  ];
  return `<${[state.split(":")[0], ...fields.filter((_, bit) => (mask >> bit) & 1)].join(",")}>`;
}

const OLD_QUEUE = 17;
const OLD_RX_BYTES = 127;
const OLD_ERRORS: Readonly<Record<number, string>> = { 9: "Alarm lock", 20: "Unsupported command" };
const OLD_ALARMS: Readonly<Record<number, string>> = {
  1: "Hard limit",
  2: "Soft limit",
  3: "Abort during cycle",
  5: "Probe fail",
};
const HAL_QUEUE = 100;
const HAL_RX_BYTES = 1_024;

export const faceOf = (name: FaceName): Face => TABLE[name];

/** The face of a version, such as "grblHAL 1.1f" or only "FluidNC"; Grbl 1.1 for another controller's version. */
export const faceNamed = (version: string): FaceName =>
  FACES.find((name) => version.toLowerCase().includes(name.toLowerCase()) && name !== "1.1") ?? "1.1";

const TABLE: Readonly<Record<FaceName, Face>> = {
  "1.1": ARDUINO,
  "0.9": {
    ...ARDUINO,
    greeting: "Grbl 0.9j ['$' for help]",
    info: ["[0.9j.20160303:]"],
    queueMoves: OLD_QUEUE,
    rxBytes: OLD_RX_BYTES,
    modes: (words) => `[${words}]`,
    report: oldReport,
    comments: /\(.*?\)/g,
    error: (code) => `error: ${OLD_ERRORS[code] ?? `Invalid gcode ID:${code}`}`,
    alarm: (code) => `ALARM: ${OLD_ALARMS[code] ?? "Homing fail"}`,
    message: (words) => `[${words}]`,
  },
  grblHAL: {
    ...ARDUINO,
    greeting: "GrblHAL 1.1f ['$' or '$HELP' for help]",
    info: [
      "[VER:1.1f.20240101:]",
      `[OPT:VNM,${HAL_QUEUE},${HAL_RX_BYTES},3,0]`,
      "[AXS:3:XYZ]",
      "[FIRMWARE:grblHAL]",
    ],
    queueMoves: HAL_QUEUE,
    rxBytes: HAL_RX_BYTES,
    refusesOn: true,
    reportsHoming: true,
    doorResuming: 4,
  },
  FluidNC: {
    ...ARDUINO,
    greeting: "Grbl 3.7 [FluidNC v3.7.16 (wifi) '$' for help]",
    info: ["[VER:3.7 FluidNC v3.7.16:]", "[OPT:MPHS]", "[MSG: Machine: Plotter]"],
    reportsHoming: true,
    report: ({ state, machineAt, feed, offset }) =>
      `<${state}|MPos:${machineAt}|FS:${feed},0${offset === null ? "" : `|WCO:${offset}`}>`,
  },
  DrawCore: {
    ...ARDUINO,
    greeting: "Grbl 1.1h DrawCore V2.09 ['$' for help]",
    takesArcs: false,
    ownVersion: "DrawCore V2.09.20230318",
    mask: 2,
  },
};
