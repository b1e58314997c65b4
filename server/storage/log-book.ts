/**
 * The server's log in the data folder, for bug reports: two files of at most 1 MB each. Callers must keep
 * secrets out of the log. As a second safeguard, secrets of a known form are masked when the log is read for
 * a report. Lines are written in the background, because the thread also streams to the board.
 */
import { readFileSync, statSync } from "node:fs";
import { appendFile, rename } from "node:fs/promises";
import { arch, homedir, release } from "node:os";
import { join } from "node:path";
import { printable } from "../../src/internal.js";
import type { Job, Plotter } from "../../src/schema/index.js";

const MAX_BYTES = 1_000_000;
/** Longer lines are cut. */
const MAX_LINE = 4_000;
/** Lines that wait for a slow disk. Beyond that they are left out. */
const MAX_WAITING = 200_000;

export class LogBook {
  private readonly path: string;
  private bytes: number;
  private waiting = "";
  private writing: Promise<void> | null = null;

  constructor(dataDir: string) {
    this.path = logPath(dataDir);
    this.bytes = statSync(this.path, { throwIfNoEntry: false })?.size ?? 0;
  }

  write(line: string): void {
    if (this.waiting.length > MAX_WAITING) return;
    const text = printable(line.replace(/\s*\n\s*/g, " | "));
    const cut = text.length > MAX_LINE ? `${text.slice(0, MAX_LINE)}…` : text;
    this.waiting += `${new Date().toISOString()} ${cut}\n`;
    this.writing ??= this.writeWaiting().finally(() => {
      this.writing = null;
    });
  }

  /** Resolves when all lines so far are in the file. */
  async written(): Promise<void> {
    await this.writing;
  }

  private async writeWaiting(): Promise<void> {
    while (this.waiting !== "") {
      const text = this.waiting;
      this.waiting = "";
      try {
        if (this.bytes > MAX_BYTES) {
          await rename(this.path, `${this.path}.1`);
          this.bytes = 0;
        }
        await appendFile(this.path, text, { mode: 0o600 });
        this.bytes += Buffer.byteLength(text);
      } catch {
        // A full disk must not stop a plot. The line is also printed to the terminal.
      }
    }
  }
}

const logPath = (dataDir: string): string => join(dataDir, "server.log");

/** The whole log, oldest line first; "" if there is none. */
export function readLog(dataDir: string): string {
  return [`${logPath(dataDir)}.1`, logPath(dataDir)].map(readOrNothing).join("");
}

interface LogBundle {
  readonly version: string;
  readonly serverLog: string;
  readonly jobs?: readonly Job[];
  readonly plotters?: readonly { readonly plotter: Plotter; readonly log: string }[];
}

/**
 * One text for a bug report: versions, state of plotters and jobs, the server's log, the logs of the boards.
 */
export function bundleText({ version, serverLog, jobs = [], plotters = [] }: LogBundle): string {
  const counts = new Map<string, number>();
  for (const { state } of jobs) counts.set(state, (counts.get(state) ?? 0) + 1);
  const states = [...counts].map(([state, count]) => `${count} ${state}`).join(", ");
  const heads = plotters.map(
    ({ plotter: { id, name, kind, device, connection, firmware, boardName, message } }) =>
      `plotter ${id} "${name}": ${kind} ${device ?? ""} ${connection}, firmware ${firmware ?? "?"}, board ${boardName ?? "without a name"}${message === null ? "" : `: ${message}`}`,
  );
  const text = [
    `plotwright ${version}, Node ${process.version}, ${process.platform} ${release()} ${arch()}, ${new Date().toISOString()}`,
    ...heads,
    ...(jobs.length === 0 ? [] : [`jobs: ${states}`]),
    "",
    "=== server ===",
    serverLog,
    ...plotters.flatMap(({ plotter, log }) => [`=== board of ${plotter.id} ===`, log]),
  ].join("\n");
  return withoutSecrets(text);
}

/** Masks pairing tokens, keys, cookies, passwords in addresses, and the user's home folder. */
export function withoutSecrets(text: string): string {
  return text
    .replace(/\b(token|secret|password|key)=[^\s&"']+/gi, "$1=…")
    .replace(/\bBearer\s+[\w.~+/-]+=*/gi, "Bearer …")
    .replace(/\bplotwright_(session|browser)=[\w-]+/g, "plotwright_$1=…")
    .replace(/:\/\/[^\s/@"']+@/g, "://…@")
    .replaceAll(homedir(), "~");
}

function readOrNothing(path: string): string {
  try {
    return readFileSync(path, "utf8");
  } catch {
    return "";
  }
}
