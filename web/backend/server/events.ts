/** The live event stream: connects, parses every event by the schema, and reconnects without limit. */
import { serverEventSchema, type ServerEvent } from "../../../src/schema/index.js";
import type { BackendListener } from "../backend.js";

const RETRY_MS = 1_500;
/** A server that has been away for a while, or does not let this device in, is asked less often. */
const QUICK_RETRIES = 10;
const SLOW_RETRY_MS = 6_000;
/** A page that was out of sight for so long (a phone in a pocket) may have a stream that is dead and does not know. */
const ASLEEP_MS = 15_000;

/**
 * Returns a function that closes it. The browser's own retry stops for good after an HTTP error (a server
 * that is just starting), so a closed stream is opened again; so is one that has lost its network.
 */
export const openEvents = (path: string, listener: BackendListener): (() => void) => {
  let source: EventSource | null = null;
  let failures = 0;
  let retry: ReturnType<typeof setTimeout> | null = null;

  const close = (): void => {
    if (retry !== null) clearTimeout(retry);
    retry = null;
    source?.close();
    source = null;
  };
  const open = (): void => {
    close();
    const opened = new EventSource(path);
    source = opened;
    opened.onmessage = ({ data }: MessageEvent<string>) => {
      const event = parseServerEvent(data);
      if (!event) return;
      failures = 0;
      if (event.type === "snapshot") listener.onLink(true);
      listener.onEvent(event);
    };
    opened.onerror = () => {
      listener.onLink(false);
      if (opened.readyState !== EventSource.CLOSED) return;
      failures++;
      retry ??= setTimeout(open, failures > QUICK_RETRIES ? SLOW_RETRY_MS : RETRY_MS);
    };
  };
  const stopWatching = watchNetwork(open, () => {
    close();
    listener.onLink(false);
  });
  open();
  return () => {
    stopWatching();
    close();
  };
};

/** Calls back when the device has its network again, or wakes up, and when it has lost its network. */
const watchNetwork = (onBack: () => void, onGone: () => void): (() => void) => {
  let hiddenAtMs: number | null = null;
  const onSight = (): void => {
    if (document.visibilityState === "hidden") hiddenAtMs = Date.now();
    else if (hiddenAtMs !== null && Date.now() - hiddenAtMs > ASLEEP_MS) onBack();
  };
  window.addEventListener("online", onBack);
  window.addEventListener("offline", onGone);
  document.addEventListener("visibilitychange", onSight);
  return () => {
    window.removeEventListener("online", onBack);
    window.removeEventListener("offline", onGone);
    document.removeEventListener("visibilitychange", onSight);
  };
};

/** Null for an unknown event: a newer server may send kinds that this page does not know. */
export const parseServerEvent = (data: string): ServerEvent | null => {
  try {
    const parsed = serverEventSchema.safeParse(JSON.parse(data));
    return parsed.success ? parsed.data : null;
  } catch {
    return null;
  }
};
