/**
 * Does the board run out of commands when the host is stalled? A dense curve at real speed, through
 * serialport and a pseudo-terminal, to a virtual board in another process (firmware 2.8.1, queue of one). The
 * sending process is stopped (SIGSTOP) for 150 ms in every second. The board counts how often its motors
 * stood still because it had no command. Time in which the machine does not run the board's own process is
 * not board time, because a real board is never descheduled. That time is reported, and so is the real length
 * of the sender's stops.
 */
import { fork } from "node:child_process";
import path from "node:path";
import { cpus, loadavg } from "node:os";
import { PtyBoard } from "../test/support/processes/pty-board.js";
import type { Report } from "./run.js";
import type { SenderReport, SenderTask } from "./stream-sender.js";

const FIRMWARE = "2.8.1";
const STALL_MS = 150;
const EVERY_MS = 1_000;

const CASES: readonly { readonly what: string; readonly task: SenderTask }[] = [
  { what: "short commands, window of 0.3 s", task: { pacing: "window", merged: false } },
  { what: "short commands, by acknowledgement", task: { pacing: "acks", merged: false } },
  { what: "merged commands, window of 0.3 s", task: { pacing: "window", merged: true } },
  { what: "shaped, quality fast, window of 0.3 s", task: { pacing: "window", merged: true, shaped: true } },
];

export default async function streamBench(report: Report): Promise<void> {
  const rows: Record<string, string | number>[] = [];
  const loads: number[] = [];
  for (const { what, task } of CASES) {
    rows.push({ what, ...(await measure(task)) });
    loads.push(loadavg()[0]);
  }
  const load = `${Math.min(...loads).toFixed(1)} to ${Math.max(...loads).toFixed(1)}`;
  report("Streaming", rows, `Load while it ran: ${load} on ${cpus().length} cores.`);
}

async function measure(task: SenderTask): Promise<Record<string, string | number>> {
  const board = await PtyBoard.open({ firmware: FIRMWARE, wakeful: true });
  const sender = fork(
    path.join(import.meta.dirname, "stream-sender.ts"),
    [board.path, JSON.stringify(task)],
    {
      execArgv: ["--import", "tsx"],
    },
  );
  const sent = new Promise<SenderReport>((resolve, reject) => {
    sender.once("message", (message) => resolve(message as SenderReport));
    sender.once("exit", (code) => reject(new Error(`the sender ended with ${code}`)));
  });
  const stalls = stallRegularly(sender.pid!);
  try {
    const result = await sent;
    stalls.end();
    const { statistics, state, sleptS } = await board.report();
    return {
      commands: result.commandCount,
      "planned s": Number(result.plannedS.toFixed(2)),
      "board s": Number((statistics.busyS + statistics.underrunS).toFixed(2)),
      underruns: statistics.underrunCount,
      "stood still s": Number(statistics.underrunS.toFixed(2)),
      "longest ms": Number((statistics.longestUnderrunS * 1000).toFixed(0)),
      "longest stop ms": Number(stalls.longestMs().toFixed(0)),
      "board asleep s": Number(sleptS.toFixed(2)),
      "ends exactly": state.steps1 === result.steps1 && state.steps2 === result.steps2 ? "yes" : "NO",
    };
  } finally {
    stalls.end();
    sender.kill("SIGKILL");
    await board.close();
  }
}

interface Stalls {
  /** Length of the longest stop. */
  longestMs(): number;
  end(): void;
}

function stallRegularly(pid: number): Stalls {
  let longestMs = 0;
  let stoppedAt: number | null = null;
  let wake: NodeJS.Timeout | undefined;
  const goOn = (): void => {
    signal(pid, "SIGCONT");
    if (stoppedAt !== null) longestMs = Math.max(longestMs, performance.now() - stoppedAt);
    stoppedAt = null;
  };
  const stall = setInterval(() => {
    stoppedAt = performance.now();
    signal(pid, "SIGSTOP");
    wake = setTimeout(goOn, STALL_MS);
  }, EVERY_MS);
  return {
    longestMs: () => longestMs,
    end: () => {
      clearInterval(stall);
      clearTimeout(wake);
      goOn();
    },
  };
}

function signal(pid: number, name: "SIGSTOP" | "SIGCONT"): void {
  try {
    process.kill(pid, name);
  } catch {
    // It has ended by itself.
  }
}
