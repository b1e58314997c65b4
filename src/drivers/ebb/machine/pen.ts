/** The pen of one board while nothing is plotted. */
import { machineOf } from "../../../machines/profiles.js";
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

  constructor(
    private readonly connection: Connection,
    private readonly changed: () => void,
  ) {}

  setState(isUp: boolean | null, isMoving = false): void {
    this.isUp = isUp;
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
    this.setState(up, true);
    try {
      for (const line of penSetUpCommands(machine, pen)) await session.send(line);
      await session.send(penCommand(machine, move), move.timeMs / 1000);
      await delay(boardClock, move.timeMs / 1000 + SETTLE_S);
    } catch (error) {
      this.setState(null);
      throw error;
    }
    this.setState(up);
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
