/**
 * Does the board run dry when the host is stalled? A dense curve at real speed, through serialport and a
 * pseudo-terminal, to a virtual board in another process (firmware 2.8.1, queue of one), while the sending
 * process is stopped (SIGSTOP) for 150 ms in every second. The judge is the board, which counts the times
 * that its motors stood still for want of a command.
 */
import { fork } from "node:child_process";
import path from "node:path";
import { PtyBoard } from "../test/support/pty-board.js";
import type { SenderReport, SenderTask } from "./stream-sender.js";

type Report = (section: string, rows: readonly Record<string, string | number>[]) => void;

const FIRMWARE = "2.8.1";
const STALL_MS = 150;
const EVERY_MS = 1_000;

const CASES: readonly { readonly what: string; readonly task: SenderTask }[] = [
  { what: "short commands, window of 0.3 s", task: { pacing: "window", fitted: false } },
  { what: "short commands, by acknowledgement", task: { pacing: "acks", fitted: false } },
  { what: "fitted commands, window of 0.3 s", task: { pacing: "window", fitted: true } },
];

export default async function streamBench(report: Report): Promise<void> {
  const rows: Record<string, string | number>[] = [];
  for (const { what, task } of CASES) rows.push({ what, ...(await measure(task)) });
  report("Streaming", rows);
}

async function measure(task: SenderTask): Promise<Record<string, string | number>> {
  const board = await PtyBoard.open({ firmware: FIRMWARE });
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
  const stopStalling = stallRegularly(sender.pid!);
  try {
    const result = await sent;
    stopStalling();
    const { statistics, state } = await board.report();
    return {
      commands: result.commandCount,
      "planned s": Number(result.plannedS.toFixed(2)),
      "board s": Number((statistics.busyS + statistics.underrunS).toFixed(2)),
      underruns: statistics.underrunCount,
      "stood still s": Number(statistics.underrunS.toFixed(2)),
      "longest ms": Number((statistics.longestUnderrunS * 1000).toFixed(0)),
      "ends exactly": state.steps1 === result.steps1 && state.steps2 === result.steps2 ? "yes" : "NO",
    };
  } finally {
    stopStalling();
    sender.kill("SIGKILL");
    await board.close();
  }
}

function stallRegularly(pid: number): () => void {
  let wake: NodeJS.Timeout | undefined;
  const stall = setInterval(() => {
    process.kill(pid, "SIGSTOP");
    wake = setTimeout(() => process.kill(pid, "SIGCONT"), STALL_MS);
  }, EVERY_MS);
  return () => {
    clearInterval(stall);
    clearTimeout(wake);
    try {
      process.kill(pid, "SIGCONT");
    } catch {
      // It has ended by itself.
    }
  };
}
