/** The queries polled during a stream. Reads the motors' supply and the button from the board's replies. */
import type { SupplyState } from "../../driver.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { parseSteps } from "../protocol/replies.js";
import type { BoardSession } from "../stream/session.js";

/**
 * The second value of `QC` is the motor supply through a divider: about 300 for 9 V. Below this the supply is
 * absent or failing (the threshold that host programs use).
 */
const LOW_SUPPLY = 250;
/** The queue, both motors, and the running command. */
const MOTION_BITS = 0b1111;
const BUTTON_BIT = 1 << 5;
const SUPPLY_FAILED_BIT = 1 << 6;
const LIMIT_BIT = 1 << 7;

/**
 * Measures the supply twice, because only two low readings in a row count. So one poll is enough to detect a supply that
 * fails for a moment, and the motors lose steps at once.
 */
export const SUPPLY_LINES = ["QC", "QC"];

export function isPowerLow(line: string, reply: string): boolean {
  const reading = line === "QC" ? Number(reply.split(",")[1]) : Infinity;
  return reading < LOW_SUPPLY;
}

export function isButtonPressed(line: string, reply: string): boolean {
  if (line === "QG") return (Number.parseInt(reply, 16) & BUTTON_BIT) !== 0;
  return line === "QB" && Number(reply) === 1;
}

/** The parts of a reply to QG that homing needs. */
export function generalStatus(reply: string): {
  readonly isMoving: boolean;
  readonly buttonPressed: boolean;
  readonly supplyFailed: boolean;
  readonly limitReached: boolean;
} {
  const bits = Number.parseInt(reply, 16);
  return {
    isMoving: (bits & MOTION_BITS) !== 0,
    buttonPressed: isButtonPressed("QG", reply),
    supplyFailed: hasSupplyFailed(reply),
    limitReached: (bits & LIMIT_BIT) !== 0,
  };
}

/** Whether the supply has failed since the last QG, for firmware with the latch. */
export const hasSupplyFailed = (generalReply: string): boolean =>
  (Number.parseInt(generalReply, 16) & SUPPLY_FAILED_BIT) !== 0;

/** The motors' supply of a board at rest. `watch` and `hasFailed`: only if the firmware has the latch. */
export class MotorSupply {
  constructor(
    private readonly session: BoardSession,
    private readonly features: FirmwareFeatures,
    private readonly report: (state: SupplyState) => void,
  ) {}

  /** The board then compares the supply with this every 2 ms, and QG reports if it was ever below. */
  async watch(): Promise<void> {
    await this.session.send(`CU,60,${LOW_SUPPLY}`);
  }

  /** Whether it has failed since the last QG. */
  async hasFailed(): Promise<boolean> {
    return hasSupplyFailed(await this.session.query("QG"));
  }

  async read(): Promise<SupplyState> {
    const { hasSupplyLatch } = this.features;
    if (hasSupplyLatch && !(await this.hasFailed())) return "good";
    if (isPowerLow("QC", await this.session.query("QC"))) return "low";
    return hasSupplyLatch ? "failed" : "good";
  }

  /** Whether it is low, or was since the last poll. Reports it as a poll during a plot does. */
  async wasLow(): Promise<boolean> {
    const state = await this.reported();
    // A single low reading may be wrong.
    return state === "failed" || (state === "low" && (await this.reported()) !== "good");
  }

  private async reported(): Promise<SupplyState> {
    const state = await this.read();
    this.report(state);
    return state;
  }
}

/**
 * Finds in the polls of a stream that the supply has failed. A stray line may be taken for the reply to QG; then the
 * true reply follows and is stray. So a failure counts only at the end of a poll without stray lines.
 */
export class SupplyPolls {
  private strayCount: number | null = null;

  constructor(
    private readonly session: Pick<BoardSession, "strayCount">,
    private readonly features: FirmwareFeatures,
    /** The poll's last line. */
    private readonly lastLine: string,
  ) {}

  /** Call with each reply of a poll, in order. Null: no failure so far in this poll. */
  answered(line: string, reply: string): "failed" | "doubtful" | null {
    const { session, features } = this;
    if (features.hasSupplyLatch && line === "QG" && hasSupplyFailed(reply)) {
      this.strayCount = session.strayCount;
    }
    if (this.strayCount === null) return null;
    if (line !== this.lastLine) return "doubtful";
    const isSure = this.strayCount === session.strayCount;
    this.strayCount = null;
    return isSure ? "failed" : "doubtful";
  }
}

/**
 * The step counters that the motors certainly reached with power. The counters alone do not prove that: a board keeps
 * counting when the motors' supply fails, and counts from 0 after a restart.
 *
 *   one poll:  QS ─── the counters ───> QC ─── the supply is good ───> QL ─── the mark is still set
 *
 * The board answers in order, so what QC and QL report was already true at QS.
 */
export class CounterPolls {
  private steps: readonly [number, number] | null = null;

  constructor(
    private readonly origin: readonly [number, number],
    /** The poll's last line. */
    private readonly lastLine: string,
  ) {}

  /** Call with each reply of a poll, in order. Returns the counters on the last reply if all three were good. */
  answered(line: string, reply: string): readonly [number, number] | null {
    if (line === "QS") this.steps = parseSteps(reply, this.origin);
    else if (isPowerLow(line, reply)) this.steps = null;
    if (line !== this.lastLine) return null;
    const { steps } = this;
    this.steps = null;
    return steps;
  }
}

/**
 * The queries polled during a stream: for the board's time, its button, its position, the motors' supply, and whether it
 * has restarted. QG comes after QS: it reports every failure
 * before it, so without one the position of QS is certain.
 */
export function pollLines(features: FirmwareFeatures, markQuery: string): readonly string[] {
  if (!features.hasStepQuery) return ["QM", "QB", ...SUPPLY_LINES];
  if (!features.hasGeneralQuery) return ["QM", "QB", "QS", ...SUPPLY_LINES];
  if (!features.hasClear) return ["QG", "QS", ...SUPPLY_LINES];
  if (!features.hasSupplyLatch) return ["QG", "QS", ...SUPPLY_LINES, markQuery];
  return [features.hasImmediateLift ? "QU,6" : "QM", "QS", "QG", ...SUPPLY_LINES, markQuery];
}
