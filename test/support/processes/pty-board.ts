/** Starts virtual boards behind pseudo-terminals, in other processes, and ends them. */
import { fork, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import type { VirtualServo } from "../../../src/drivers/ebb/virtual/virtual-board.js";
import type { BoardStatistics, MachineId, VirtualBoardState } from "../../../src/internal.js";
import { childScript, hasEnded, nextMessage } from "./child-script.js";

/** After this time a board's process that has not ended is killed. */
const CLOSED_WITHIN_MS = 10_000;

export type ToBoard =
  /** `replug`: after `unplug` or `reset`, the board is available again at the same path. */
  | { readonly type: "unplug" | "replug" | "reset" | "report" }
  /** The line carries nothing in either direction, and sent data is lost. The board itself continues. */
  | { readonly type: "deaf"; readonly deaf: boolean; readonly afterBytes?: number }
  | { readonly type: "mute"; readonly mute: boolean }
  /** It answers, but a running command never ends. */
  | { readonly type: "frozen"; readonly frozen: boolean }
  | { readonly type: "garbage"; readonly bytes: readonly number[] }
  | { readonly type: "lose"; readonly count: number }
  | { readonly type: "volts"; readonly volts: number }
  | { readonly type: "slow"; readonly bytesPerS: number }
  | { readonly type: "send"; readonly line: string };

export interface BoardReport {
  readonly type: "report";
  readonly state: VirtualBoardState;
  readonly statistics: BoardStatistics;
  /** Seconds that a wakeful board's clock was stopped. */
  readonly sleptS: number;
  /** mm from home: x, y, x, y … */
  readonly drawn: readonly { readonly penDown: boolean; readonly xy: readonly number[] }[];
}

export type FromBoard = { readonly type: "open"; readonly path: string } | BoardReport;

/** `wakeful`: its clock stops while the machine does not run its process. */
export class PtyBoard {
  private constructor(
    /** The path for the driver: a link to the terminal, which stays the same over `unplug` and `replug`. */
    readonly path: string,
    private readonly child: ChildProcess,
  ) {}

  static async open(
    options: {
      firmware?: string;
      speed?: number;
      futureSyntax?: boolean;
      wakeful?: boolean;
      servo?: VirtualServo;
      machine?: MachineId;
    } = {},
  ): Promise<PtyBoard> {
    const { firmware = "2.8.1", speed = 1, futureSyntax = false, wakeful = false, servo = {} } = options;
    const { machine = "axidraw-v3" } = options;
    const args = [JSON.stringify({ firmware, speed, futureSyntax, wakeful, servo, machine })];
    const child = fork(childScript("pty-board-child"), args, { execArgv: [] });
    try {
      const opened = await answer(child, "open");
      return new PtyBoard(opened.path, child);
    } catch (error) {
      child.kill("SIGKILL");
      throw error;
    }
  }

  tell(message: ToBoard): void {
    this.child.send(message);
  }

  async report(): Promise<BoardReport> {
    const report = answer(this.child, "report");
    if (this.child.connected) this.tell({ type: "report" });
    return report;
  }

  async close(): Promise<void> {
    const { child } = this;
    if (hasEnded(child)) return;
    const ended = once(child, "exit");
    const killing = setTimeout(() => child.kill("SIGKILL"), CLOSED_WITHIN_MS);
    if (child.connected) child.disconnect();
    await ended;
    clearTimeout(killing);
  }
}

const answer = <T extends FromBoard["type"]>(child: ChildProcess, type: T) =>
  nextMessage<Extract<FromBoard, { type: T }>>(child, (message) => message.type === type);
