/** Log of the communication, newest last: a ring buffer of limited size. */
import type { Clock } from "./transport.js";

/** The kind of an entry in the log. */
export type LogDirection = "sent" | "received" | "note";

const MARKS: Readonly<Record<LogDirection, string>> = { sent: ">", received: "<", note: "#" };

interface Entry {
  /** Seconds since the session began. */
  readonly timeS: number;
  readonly direction: LogDirection;
  readonly line: string;
}

export class SessionLog {
  /**
   * Number of entries so far, with those that were overwritten.
   *
   * @internal
   */
  count = 0;
  private readonly entries: Entry[] = [];
  private readonly startS: number;

  constructor(
    private readonly clock: Clock,
    private readonly sizeLines = 20_000,
  ) {
    this.startS = clock.nowS();
  }

  add(direction: LogDirection, line: string): void {
    this.entries[this.count % this.sizeLines] = { timeS: this.clock.nowS() - this.startS, direction, line };
    this.count++;
  }

  /** One line per entry: seconds since the session began; `>` sent, `<` received, `#` note. */
  text(): string {
    return this.tail(this.sizeLines)
      .map((line) => `${line}\n`)
      .join("");
  }

  /** The last `count` lines, for an error message or a panel. */
  tail(count: number): readonly string[] {
    return this.last(count).map(
      ({ timeS, direction, line }) => `${timeS.toFixed(4)} ${MARKS[direction]} ${line}`,
    );
  }

  /**
   * The lines received after the first `count` entries.
   *
   * @internal
   */
  receivedSince(count: number): string[] {
    const received = this.last(this.count - count).filter(({ direction }) => direction === "received");
    return received.map(({ line }) => line);
  }

  private last(count: number): Entry[] {
    const { entries, sizeLines } = this;
    const length = Math.min(count, entries.length);
    return Array.from({ length }, (_, i) => entries[(this.count - length + i) % sizeLines]);
  }
}
