/** The pen of one board while nothing is plotted. */
import { machineOf } from "../../../machines/profiles.js";
import { dropMoveTime, liftMoveTime, timedPen, waitOf, type TimedPen } from "../../../plan/pen/pen-times.js";
import type { MachineSettings } from "../../machine-job.js";
import { delay } from "../../transport.js";
import { penCommand, penMoveOf, penSetUpCommands } from "../protocol/commands.js";
import { ebbOf } from "../protocol/ebb-controller.js";
import type { Connection } from "./connection.js";

/** The board begins, and so ends, this much after the command was written. */
const SETTLE_S = 0.02;
/** Time for a servo to move from end to end and settle. */
const SERVO_MS = 400;

export class EbbPen {
  /** Null: something else has moved the pen. */
  isUp: boolean | null = null;
  /** It is still moving to that state. */
  isMoving = false;
  /** The height of the last move by hand; null: something else has moved the pen since. */
  private heightPct: number | null = null;

  constructor(
    private readonly connection: Connection,
    private readonly changed: () => void,
  ) {}

  setState(isUp: boolean | null, isMoving = false): void {
    this.isUp = isUp;
    this.heightPct = null;
    this.isMoving = isMoving;
    this.changed();
  }

  /** Lifts or lowers the pen; resolves when it has arrived. */
  async move(up: boolean, settings: MachineSettings, heightPct?: number): Promise<void> {
    const { session, boardClock } = this.connection;
    const machine = machineOf(settings);
    const pct = heightPct ?? (up ? settings.pen.upPct : settings.pen.downPct);
    const pen = { ...settings.pen, ...(up ? { upPct: pct } : { downPct: pct }) };
    const move = penMoveOf(pen, up);
    const waitS = this.moveTimeTo(pct, up, timedPen(settings.pen, machine));
    this.setState(up, true);
    try {
      for (const line of penSetUpCommands(machine, pen)) await session.send(line);
      await session.send(penCommand(machine, move, 1_000 * waitS), waitS);
      await delay(boardClock, waitS + SETTLE_S);
    } catch (error) {
      this.setState(null);
      throw error;
    }
    this.setState(up);
    this.heightPct = pct;
  }

  /** The time of a move to a height, from where the pen is. After anything else has moved it, that may be anywhere. */
  private moveTimeTo(pct: number, up: boolean, pen: TimedPen): number {
    const { isUp } = this;
    const farthestPct = pct > 50 ? 0 : 100;
    const fromPct = isUp === null ? farthestPct : (this.heightPct ?? (isUp ? pen.upPct : pen.downPct));
    const distancePct = pct - fromPct;
    return up
      ? waitOf(liftMoveTime(pen, distancePct), pen.extraLiftMs)
      : waitOf(dropMoveTime(pen, distancePct), pen.extraDropMs);
  }

  /** Moves to a raw position, 1/12 µs, as fast as the servo can; whether that is up or down is then unknown. */
  async moveTo(pos: number, settings: MachineSettings): Promise<void> {
    const { session, boardClock } = this.connection;
    await session.send(`S2,${pos},${ebbOf(machineOf(settings)).servoPin},0,${SERVO_MS}`, SERVO_MS / 1000);
    await delay(boardClock, SERVO_MS / 1000 + SETTLE_S);
    this.setState(null);
  }

  /**
   * Lifts a pen that was left on the paper, where it would bleed. The board still has the plot's up height. Returns
   * whether the pen was up.
   */
  async liftIfDown(): Promise<boolean> {
    const { session } = this.connection;
    const wasUp = Number(await session.query("QP")) === 1;
    if (!wasUp) await session.send(`SP,1,${SERVO_MS}`, SERVO_MS / 1000);
    return wasUp;
  }
}
