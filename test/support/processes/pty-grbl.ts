/** Starts virtual Grbls behind pseudo-terminals, in other processes, and ends them. */
import { fork, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import type {
  VirtualGrblOptions,
  VirtualGrblState,
} from "../../../src/drivers/grbl/virtual/virtual-settings.js";
import type { MachineProfile } from "../../../src/index.js";
import { childScript, hasEnded, nextMessage } from "./child-script.js";

export interface GrblOptions extends VirtualGrblOptions {
  readonly machine: MachineProfile;
  readonly speed: number;
}

/** `replug`: it is available again at the same path. */
export interface ToGrbl {
  readonly type: "unplug" | "replug" | "report";
}

interface GrblReport {
  readonly type: "report";
  readonly state: VirtualGrblState;
  /** mm from home: x, y, x, y … */
  readonly drawn: readonly { readonly penDown: boolean; readonly xy: readonly number[] }[];
}

export type FromGrbl = { readonly type: "open"; readonly path: string } | GrblReport;

export class PtyGrbl {
  private constructor(
    /** A link to the terminal, which stays the same over `unplug` and `replug`. */
    readonly path: string,
    private readonly child: ChildProcess,
  ) {}

  static async open(options: GrblOptions): Promise<PtyGrbl> {
    const child = fork(childScript("pty-grbl-child"), [JSON.stringify(options)], { execArgv: [] });
    const opened = await nextMessage<FromGrbl>(child, ({ type }) => type === "open");
    return new PtyGrbl((opened as { path: string }).path, child);
  }

  tell(type: ToGrbl["type"]): void {
    this.child.send({ type } satisfies ToGrbl);
  }

  async report(): Promise<GrblReport> {
    const report = nextMessage<FromGrbl>(this.child, ({ type }) => type === "report");
    this.tell("report");
    return (await report) as GrblReport;
  }

  async close(): Promise<void> {
    if (hasEnded(this.child)) return;
    const ended = once(this.child, "exit");
    this.child.disconnect();
    await ended;
  }
}
