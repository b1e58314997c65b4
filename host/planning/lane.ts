/**
 * Limits how much work runs at a time. Each client may use one slot at a time, so that no client can block the
 * others.
 */
import { PlotwrightError } from "../../src/index.js";
import type { Submitter } from "../../src/schema/index.js";

/** The client that asks for something. */
export interface Requester {
  /** Requests of one client run one after the other; default: the server itself. */
  readonly client?: string | undefined;
  /** Aborted when the result is no longer needed. */
  readonly signal?: AbortSignal | undefined;
  /** Who it is, if it may only submit jobs: it gets its own jobs only. Default: it may have all. */
  readonly submitter?: Submitter | undefined;
}

type Lane = <T>(requester: Requester, work: () => Promise<T>) => Promise<T>;

export function lane(slots: number): Lane {
  const running: string[] = [];
  const waiting: { readonly client: string; readonly begin: () => void }[] = [];

  function beginNext(): void {
    if (running.length >= slots) return;
    const at = waiting.findIndex(({ client }) => !running.includes(client));
    const next = waiting[at];
    if (next === undefined) return;
    waiting.splice(at, 1);
    running.push(next.client);
    next.begin();
  }

  function turnOf(client: string, signal: AbortSignal | undefined): Promise<void> {
    return new Promise((resolve, reject) => {
      const entry = { client, begin: resolve };
      const leave = (): void => {
        const at = waiting.indexOf(entry);
        if (at < 0) return;
        waiting.splice(at, 1);
        reject(new PlotwrightError("cancelled", "Planning was cancelled."));
      };
      waiting.push(entry);
      signal?.addEventListener("abort", leave, { once: true });
      if (signal?.aborted === true) leave();
      else beginNext();
    });
  }

  return async ({ client = "", signal }, work) => {
    await turnOf(client, signal);
    try {
      return await work();
    } finally {
      running.splice(running.indexOf(client), 1);
      beginNext();
    }
  };
}
