import { useSyncExternalStore } from "react";

const INTERVAL_MS = 5_000;

/** One time for the whole page: two "done 16:42" that are computed a moment apart could differ by a minute. */
let nowMs = Date.now();
let timer: ReturnType<typeof setInterval> | undefined;
const listeners = new Set<() => void>();

function subscribe(listener: () => void): () => void {
  if (listeners.size === 0) {
    nowMs = Date.now();
    timer = setInterval(tick, INTERVAL_MS);
  }
  listeners.add(listener);
  return () => {
    listeners.delete(listener);
    if (listeners.size === 0) clearInterval(timer);
  };
}

function tick(): void {
  nowMs = Date.now();
  for (const listener of listeners) listener();
}

/** The current time in ms, updated often enough for "done 16:42". */
export const useNow = (): number => useSyncExternalStore(subscribe, () => nowMs);
