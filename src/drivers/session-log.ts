/** Log of the communication, newest last: a ring buffer of fixed size. */
import type { Clock } from "./transport.js";

/** The kind of an entry in the log. */
export type LogDirection = "sent" | "received" | "note";

const MARKS: Readonly<Record<LogDirection, string>> = { sent: ">", received: "<", note: "#" };

export class SessionLog {
  private readonly times: Float64Array;
  private readonly lines: string[];
  private readonly directions: LogDirection[];
  private readonly startS: number;
  private total = 0;

  constructor(
    private readonly clock: Clock,
    private readonly sizeLines = 20_000,
  ) {
    this.times = new Float64Array(sizeLines);
    this.lines = new Array<string>(sizeLines).fill("");
    this.directions = new Array<LogDirection>(sizeLines).fill("note");
    this.startS = clock.nowS();
  }

  add(direction: LogDirection, line: string): void {
    const slot = this.total % this.sizeLines;
    this.times[slot] = this.clock.nowS() - this.startS;
    this.lines[slot] = line;
    this.directions[slot] = direction;
    this.total++;
  }

  /** One line per entry: seconds since the session began; `>` sent, `<` received, `#` note. */
  text(): string {
    return this.tail(this.sizeLines)
      .map((line) => `${line}\n`)
      .join("");
  }

  /** The last `count` lines, for an error message or a panel. */
  tail(count: number): readonly string[] {
    const out: string[] = [];
    for (let i = Math.max(0, this.total - Math.min(count, this.sizeLines)); i < this.total; i++) {
      const slot = i % this.sizeLines;
      out.push(`${this.times[slot].toFixed(4)} ${MARKS[this.directions[slot]]} ${this.lines[slot]}`);
    }
    return out;
  }
}
