/** The process, as a command uses it. An interface, so that tests can run commands without a process. */
import { closeSync } from "node:fs";
import { createInterface } from "node:readline";
import { isatty } from "node:tty";
import { printable } from "../../src/internal.js";

export interface CliIo {
  /** Writes results. Text for people is made by `printed`. */
  out(text: string): void;
  /** Writes messages and progress, made by `printed`. */
  err(text: string): void;
  /** Whether messages go to a terminal, so that a status line makes sense. */
  readonly isTerminal: boolean;
  /**
   * On a terminal, keeps this text in the line below all messages, in place of the one before; "" removes it.
   * Elsewhere it does nothing.
   */
  status(text: string): void;
  /** Whether the input is a keyboard, so that a question makes sense. */
  readonly hasKeyboard: boolean;
  /**
   * Called at each Ctrl-C, and once with `isFinal` at SIGTERM, when the terminal is closed (SIGHUP), or when the
   * parent process has ended. The returned function stops listening.
   */
  onInterrupt(listener: (isFinal: boolean) => void): () => void;
  /** Ends the process after this time, and names what still kept it alive. */
  endWithin(ms: number): void;
  /** Calls back for each typed line; the returned function stops listening. */
  onLine(listener: (line: string) => void): () => void;
  /** The lines of stdin, as they come, until `end`: an open stdin would keep the process. */
  inputLines(end: AbortSignal): AsyncIterable<string>;
}

/**
 * A template for what is printed: values come from drawings, boards and servers, and may contain line ends and
 * sequences that control the terminal. Each becomes plain text of one line; only the template itself can end a line.
 */
export const printed = (parts: TemplateStringsArray, ...values: readonly unknown[]): string =>
  String.raw({ raw: parts }, ...values.map((value) => printable(String(value))));

/** One line of a table: what `cut` and other programs can read too. */
export const row = (...cells: readonly unknown[]): string =>
  `${cells.map((cell) => printed`${cell}`).join("\t")}\n`;

/** A time as hours, minutes and seconds: "00:01:30". */
export function minutes(seconds: number): string {
  const whole = Math.round(seconds);
  const parts = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return parts.map((part) => String(part).padStart(2, "0")).join(":");
}

/** A second safeguard, for messages of several lines: without what could control a terminal, except line ends and tabs. */
const harmless = (text: string): string =>
  text
    .split(/([\n\t])/)
    .map((part) => (part === "\n" || part === "\t" ? part : printable(part)))
    .join("");

/** "disconnect": the parent that opened a channel to this process, as `npm start` does, has ended. */
const ENDS = ["SIGTERM", "SIGHUP", "disconnect"] as const;

const STDIO = [0, 1, 2];

/** Goes to the beginning of the terminal's line, and erases it. */
const ERASED = "\r\u001b[K";
/** Room for the "^C" that the terminal echoes after the status line. */
const ECHO_COLUMNS = 4;

export function processIo(): CliIo {
  // The reader may stop ("| head"), the terminal may close, the disk may be full: a plot continues regardless.
  for (const stream of [process.stdout, process.stderr]) stream.on("error", () => undefined);
  const terminals = STDIO.filter((fd) => isatty(fd));
  // At exit Node.js restores the modes of its terminals, and aborts if one of them is gone, unless that one is closed.
  process.once("exit", () => terminals.filter((fd) => !isatty(fd)).forEach((fd) => closeSync(fd)));
  let status = "";
  const erased = (): string => (status === "" ? "" : ERASED);
  const shown = (): string => status.slice(0, process.stderr.columns - ECHO_COLUMNS);
  return {
    // Not filtered: results are also files of every kind, and the pairing code is drawn with colours.
    out: (text) => void process.stdout.write(text),
    err: (text) => void process.stderr.write(erased() + harmless(text) + shown()),
    isTerminal: process.stderr.isTTY,
    status: (text) => {
      if (!process.stderr.isTTY) return;
      const before = erased();
      status = text;
      process.stderr.write(before + shown());
    },
    // Not process.stdin.isTTY: opening stdin as a stream makes a pipe non-blocking, and reading it whole then fails.
    hasKeyboard: isatty(0),
    onInterrupt: (listener) => {
      const soft = (): void => listener(false);
      const final = (): void => listener(true);
      process.on("SIGINT", soft);
      for (const end of ENDS) process.on(end, final);
      // Listening for the end of the parent must not keep this process alive.
      process.channel?.unref();
      return () => {
        process.off("SIGINT", soft);
        for (const end of ENDS) process.off(end, final);
      };
    },
    endWithin: (ms) => {
      const end = (): never => {
        const open = [...new Set(process.getActiveResourcesInfo())].join(", ");
        process.stderr.write(`plotwright: something was still open after ${ms / 1000} s: ${open}\n`);
        process.exit();
      };
      setTimeout(end, ms).unref();
    },
    inputLines: (signal) => createInterface({ input: process.stdin, crlfDelay: Infinity, signal }),
    onLine: (listener) => {
      if (!isatty(0)) return () => undefined;
      const take = (data: Buffer): void => listener(data.toString("utf8").trim());
      // Reading from a closed terminal fails, usually before its SIGHUP arrives. Only the signal ends a command.
      if (process.stdin.listenerCount("error") === 0) process.stdin.on("error", () => undefined);
      process.stdin.on("data", take);
      // A listener alone does not start a stream again that the last one paused.
      process.stdin.resume();
      return () => {
        process.stdin.off("data", take);
        process.stdin.pause();
      };
    },
  };
}
