/**
 * One operator at a time: of several browsers that may operate, one holds the operator lock, the others watch until
 * they take it. Stopping needs no operator lock. Scripts are not browsers and need none either.
 *
 *   free ──first to act──> held ──take by another──> held by that one
 *    ^                      │
 *    └── no event stream of the holder for 30 s (page closed, phone gone)
 *
 * Kept in the database, so that a restart of the server takes it from nobody.
 */
import { PlotwrightError } from "../../src/index.js";
import { operatorSchema, type Operator } from "../../src/schema/index.js";
import type { Store } from "../queue/store.js";

export interface OperatorLockParts {
  readonly store: Pick<Store, "setting" | "saveSetting">;
  readonly announce: (operator: Operator | null) => void;
  readonly log: (line: string) => void;
  /** 30 s unless told. */
  readonly lapseMs?: number;
}

const SETTING = "operator";
const LAPSE_MS = 30_000;

export class OperatorLock {
  readonly #parts: OperatorLockParts;
  #operator: Operator | null;
  /** Open event streams by browser. */
  readonly #streams = new Map<string, number>();
  #lapse: NodeJS.Timeout | null = null;
  #isClosed = false;

  constructor(parts: OperatorLockParts) {
    this.#parts = parts;
    const kept = operatorSchema.safeParse(parts.store.setting(SETTING));
    this.#operator = kept.success ? kept.data : null;
    this.#watch();
  }

  get operator(): Operator | null {
    return this.#operator;
  }

  /** Before a browser changes something: gives it a free operator lock; throws `not-operator` while another one has it. */
  act(browser: Operator): void {
    if (this.#operator === null) this.#give(browser, "acts first");
    else if (this.#operator.id !== browser.id) {
      throw new PlotwrightError(
        "not-operator",
        `${this.#operator.name} is operating. Take over to change something; stopping works without.`,
      );
    } else this.#watch();
  }

  take(browser: Operator): Operator {
    if (this.#operator?.id !== browser.id) {
      const from = this.#operator === null ? "" : ` from ${this.#operator.name}`;
      this.#give(browser, `takes over${from}`);
    }
    return browser;
  }

  /** A browser has opened its event stream; to be called back when that ends. */
  streamOpened(id: string): () => void {
    this.#streams.set(id, (this.#streams.get(id) ?? 0) + 1);
    this.#watch();
    return () => {
      const left = (this.#streams.get(id) ?? 1) - 1;
      if (left === 0) this.#streams.delete(id);
      else this.#streams.set(id, left);
      this.#watch();
    };
  }

  /** Streams that end after it start no clock any more. */
  close(): void {
    this.#isClosed = true;
    this.#watch();
  }

  #give(operator: Operator | null, why: string): void {
    this.#operator = operator;
    try {
      this.#parts.store.saveSetting(SETTING, operator);
    } catch (error) {
      // A full disk must not keep anybody from operating, nor end the server when a turn lapses.
      this.#parts.log(`the operator is not stored: ${(error as Error).message}`);
    }
    this.#parts.log(`operator: ${operator?.name ?? "nobody"} (${why})`);
    this.#parts.announce(operator);
    this.#watch();
  }

  /** The clock runs from the holder's last stream or act on. */
  #watch(): void {
    if (this.#lapse !== null) clearTimeout(this.#lapse);
    this.#lapse = null;
    if (this.#isClosed || this.#operator === null || this.#streams.has(this.#operator.id)) return;
    const gone = this.#operator;
    this.#lapse = setTimeout(
      () => this.#give(null, `${gone.name} has been gone for a while`),
      this.#parts.lapseMs ?? LAPSE_MS,
    );
    this.#lapse.unref();
  }
}
