/**
 * Lets only one browser operate at a time: it holds the operator lock, and other browsers watch until they
 * take the lock over. Stopping a plot does not need the lock, and scripts never need it.
 *
 *   free ──a browser acts──> held ──another browser takes over──> held by that one
 *    ^                        │
 *    └── no event stream of the holder for 30 s (page closed, phone gone)
 *
 * The holder is stored in the database, so that a restart of the server does not release the lock.
 */
import { PlotwrightError } from "../../src/index.js";
import { operatorSchema, type Operator } from "../../src/schema/index.js";
import type { Store } from "../storage/store.js";

interface OperatorLockParts {
  readonly store: Pick<Store, "setting" | "saveSetting">;
  readonly announce: (operator: Operator | null) => void;
  readonly log: (line: string) => void;
  /** Default 30 s. */
  readonly lapseMs?: number;
}

const SETTING = "operator";
const LAPSE_MS = 30_000;

export class OperatorLock {
  private current: Operator | null;
  /** Open event streams by browser. */
  private readonly streams = new Map<string, number>();
  private lapse: NodeJS.Timeout | null = null;
  private isClosed = false;

  constructor(private readonly parts: OperatorLockParts) {
    const stored = operatorSchema.safeParse(parts.store.setting(SETTING));
    this.current = stored.success ? stored.data : null;
    this.restartLapse();
  }

  get operator(): Operator | null {
    return this.current;
  }

  /**
   * Call before a browser changes something: gives it the lock if it is free; throws `not-operator` if
   * another has it.
   */
  act(browser: Operator): void {
    if (this.current === null) this.give(browser, "acts first");
    else if (this.current.id !== browser.id) {
      throw new PlotwrightError(
        "not-operator",
        `${this.current.name} is operating. Take over to change something; you can stop a plot without taking over.`,
      );
    } else this.restartLapse();
  }

  take(browser: Operator): Operator {
    if (this.current?.id !== browser.id) {
      const from = this.current === null ? "" : ` from ${this.current.name}`;
      this.give(browser, `takes over${from}`);
    }
    return browser;
  }

  /** A browser has opened its event stream. Call the returned function when the stream ends. */
  streamOpened(id: string): () => void {
    this.streams.set(id, (this.streams.get(id) ?? 0) + 1);
    this.restartLapse();
    return () => {
      const left = (this.streams.get(id) ?? 1) - 1;
      if (left === 0) this.streams.delete(id);
      else this.streams.set(id, left);
      this.restartLapse();
    };
  }

  /** Streams that end after this no longer start the timer. */
  close(): void {
    this.isClosed = true;
    this.restartLapse();
  }

  private give(operator: Operator | null, why: string): void {
    this.current = operator;
    try {
      this.parts.store.saveSetting(SETTING, operator);
    } catch (error) {
      // A full disk must neither prevent operating nor end the server when the lock lapses.
      this.parts.log(`the operator is not stored: ${(error as Error).message}`);
    }
    this.parts.log(`operator: ${operator?.name ?? "none"} (${why})`);
    this.parts.announce(operator);
    this.restartLapse();
  }

  /** Restarts the timer that releases the lock, which runs while the holder has no event stream. */
  private restartLapse(): void {
    if (this.lapse !== null) clearTimeout(this.lapse);
    this.lapse = null;
    if (this.isClosed || this.current === null || this.streams.has(this.current.id)) return;
    const holder = this.current;
    this.lapse = setTimeout(
      () => this.give(null, `${holder.name} has disconnected`),
      this.parts.lapseMs ?? LAPSE_MS,
    );
    this.lapse.unref();
  }
}
