/**
 * The capabilities of each EiBotBoard firmware: one table, used by the compiler, the driver
 * and the virtual board.
 *
 * Source: the firmware's release notes and ebb.c (repository evil-mad/EggBot).
 */
import { PlotwrightError } from "../../../errors.js";

/**
 * How the 25 kHz interrupt adds up rates. "late": the acceleration is added after the accumulator is updated.
 * "half": before it, with half a tick's acceleration subtracted first, magnitudes only. "signed": as "half",
 * with signed 32-bit rates and a jerk term.
 */
export type TickArithmetic = "late" | "half" | "signed";

export interface FirmwareFeatures {
  readonly version: string;
  /** The kind of motion commands used: constant-rate slices, step-limited ramps, timed ramps, timed ramps with jerk. */
  readonly motion: "slices" | "steps" | "timed" | "jerk";
  readonly arithmetic: TickArithmetic;
  /** Idle ticks after every motion command. */
  readonly idleTicks: number;
  /** Idle ticks after a timed command (LT, T3). */
  readonly idleTicksTimed: number;
  /** L3: negative steps also negate the jerk, and the check for a move that never ends reads each motor's own jerk. */
  readonly l3NegatesJerk: boolean;
  /** Max number of commands waiting behind the running one (set by CU,4 if more than 1). */
  readonly maxFifoDepth: number;
  /** LM, LT, L3 and T3 accept a last argument that clears accumulators. */
  readonly hasClear: boolean;
  /** EM zeroes the accumulators too (it always zeroes the step counters). */
  readonly enableClearsAccumulators: boolean;
  readonly enableIsQueued: boolean;
  readonly hasStepQuery: boolean;
  readonly hasGeneralQuery: boolean;
  /** SP,2: lift at once, bypassing the queue. */
  readonly hasImmediateLift: boolean;
  /** ES also stops a running LT. */
  readonly stopEndsTimed: boolean;
  /** The board notices a failure of the motors' supply by itself (CU,60), and reports it in QG. */
  readonly hasSupplyLatch: boolean;
  /** The board ends a move when a pin of port B has a certain level (CU,51). */
  readonly hasLimitSwitches: boolean;
  /** Replies can be switched to one line each, `NAME,values` (CU,10,1). */
  readonly hasFutureSyntax: boolean;
}

/** [first version, changes from that version on]; later rows override earlier ones. */
const TABLE: readonly (readonly [string, Partial<FirmwareFeatures>])[] = [
  [
    "0.0.0",
    {
      motion: "slices",
      arithmetic: "late",
      idleTicks: 1,
      idleTicksTimed: 1,
      l3NegatesJerk: false,
      maxFifoDepth: 1,
      hasClear: false,
      enableClearsAccumulators: false,
      enableIsQueued: false,
      hasStepQuery: false,
      hasGeneralQuery: false,
      hasImmediateLift: false,
      stopEndsTimed: true,
      hasSupplyLatch: false,
      hasLimitSwitches: false,
      hasFutureSyntax: false,
    },
  ],
  ["2.4.3", { hasStepQuery: true }],
  ["2.5.3", { motion: "steps" }],
  ["2.6.2", { hasGeneralQuery: true }],
  [
    "2.7.0",
    {
      motion: "timed",
      arithmetic: "half",
      idleTicks: 0,
      idleTicksTimed: 0,
      hasClear: true,
      enableClearsAccumulators: true,
      stopEndsTimed: false,
    },
  ],
  ["2.8.0", { enableIsQueued: true }],
  [
    "3.0.0",
    {
      motion: "jerk",
      arithmetic: "signed",
      idleTicksTimed: 1,
      maxFifoDepth: 32,
      stopEndsTimed: true,
      hasSupplyLatch: true,
      hasLimitSwitches: true,
      hasFutureSyntax: true,
    },
  ],
  ["3.0.1", { hasImmediateLift: true }],
  // Unconfirmed: from reports, because no release notes or sources of 3.1 could be read. 3.1.7 is said to load commands
  // at another moment of the tick, which changes no step. If the idle tick is still there, plots end on the same steps
  // and take up to 0.2 % longer.
  ["3.1.0", { idleTicksTimed: 0, l3NegatesJerk: true }],
];

/** The newest version that the table knows. Newer ones are treated alike. */
export const NEWEST_FIRMWARE = "3.1.7";

/** What to say about a version that is newer than the table; null: it is not. Throws `bad-setting` for an invalid one. */
export const newerFirmwareNote = (version: string): string | null =>
  compareFirmware(version, NEWEST_FIRMWARE) > 0
    ? `Firmware ${version} is newer than plotwright knows: it is treated as ${NEWEST_FIRMWARE}. If a plot goes wrong, look for a newer plotwright.`
    : null;

/**
 * The version in a reply to V ("EBBv13_and_above EB Firmware Version 2.8.1"), or null if there is none. What follows its
 * three numbers, for example "-beta", does not count.
 */
export function firmwareFromReply(reply: string): string | null {
  const match = /EBB.*\bversion\s+v?(\d{1,4}\.\d{1,4}(?:\.\d{1,4})?)/i.exec(reply);
  return match?.[1] ?? null;
}

/**
 * −1, 0 or 1 if `a` is older than, equal to or newer than `b`. Throws `bad-setting` for an invalid version.
 */
export function compareFirmware(a: string, b: string): number {
  const x = parseVersion(a);
  const y = parseVersion(b);
  for (let i = 0; i < 3; i++) {
    const difference = x[i] - y[i];
    if (difference !== 0) return Math.sign(difference);
  }
  return 0;
}

/**
 * Looks up a version in the table. A version that is not listed has the features of the nearest older one.
 */
export function firmwareFeatures(version: string): FirmwareFeatures {
  let features = { version } as FirmwareFeatures;
  for (const [from, change] of TABLE) {
    if (compareFirmware(version, from) >= 0) features = { ...features, ...change };
  }
  return features;
}

/**
 * Commands that wait behind the running one during a plot. Without QU,6 (3.0.0) the fill level of a deep queue is
 * unknown, so only one does.
 */
export const queueDepthOf = ({ hasImmediateLift, maxFifoDepth }: FirmwareFeatures): number =>
  hasImmediateLift ? maxFifoDepth : 1;

function parseVersion(version: string): readonly [number, number, number] {
  const match = /^v?(\d{1,4})\.(\d{1,4})(?:\.(\d{1,4}))?$/.exec(String(version).trim());
  if (match === null) {
    throw new PlotwrightError(
      "bad-setting",
      `"${version}" is not a firmware version: expected three numbers such as 2.8.1.`,
    );
  }
  return [Number(match[1]), Number(match[2]), Number(match[3] ?? 0)];
}
