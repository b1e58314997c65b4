/** `plotwright logs`: all logs as one text, for a support request. */
import { OPERATIONS, requestOf } from "../../src/schema/index.js";
import { defaultDataDir } from "../storage/data-dir.js";
import { bundleText, readLog } from "../storage/log-book.js";
import { mustBeDataFolder, writeOut } from "./files.js";
import type { CliIo } from "./io.js";

export interface LogsOptions {
  readonly data?: string;
  readonly port: number;
  readonly out?: string;
}

const PATIENCE_MS = 3_000;

/** From the running server, with the boards' logs; otherwise from its data folder. */
export async function runLogs(options: LogsOptions, io: CliIo, version: string): Promise<void> {
  const { data, port, out = "-" } = options;
  mustBeDataFolder(data);
  const text =
    (data === undefined ? await fromServer(port) : null) ??
    bundleText({ version, serverLog: readLog(data ?? defaultDataDir()) });
  writeOut(out, `${text}\n`, io);
  if (out !== "-") {
    io.err(`${out} is written. Look through it before you send it.\n`);
  }
}

async function fromServer(port: number): Promise<string | null> {
  try {
    const response = await fetch(`http://127.0.0.1:${port}${requestOf(OPERATIONS.operator.logs, {}).path}`, {
      signal: AbortSignal.timeout(PATIENCE_MS),
    });
    const text = await response.text();
    return response.ok && text.startsWith("plotwright ") ? text : null;
  } catch {
    return null;
  }
}
