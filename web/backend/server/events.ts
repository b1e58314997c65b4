/** The live event stream: connects, parses every event with its schema, and always reconnects. */
import { serverEventSchema, type ServerEvent } from "../../../src/schema/index.js";
import type { BackendListener } from "../backend.js";

const RETRY_MS = 1_500;
/** Pages that lose the server together do not all come back at once. */
const spread = (ms: number): number => ms * (0.7 + 0.6 * Math.random());
/** After this many failures (the server is off, or refuses this device) the retries are slower. */
const QUICK_RETRIES = 10;
const SLOW_RETRY_MS = 6_000;
/** A page that was hidden for longer (a phone in a pocket) may have a dead stream without an error event. */
const ASLEEP_MS = 15_000;

/**
 * The browser does not retry after an HTTP error (from a server that is just starting), so the stream is opened again
 * here. It is also opened again when the network is back or the device wakes up.
 */
export const openEvents = (path: string, listener: BackendListener): void => {
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
      retry ??= setTimeout(open, spread(failures > QUICK_RETRIES ? SLOW_RETRY_MS : RETRY_MS));
    };
  };
  let hiddenAtMs: number | null = null;
  window.addEventListener("online", open);
  window.addEventListener("offline", () => {
    close();
    listener.onLink(false);
  });
  document.addEventListener("visibilitychange", () => {
    if (document.visibilityState === "hidden") hiddenAtMs = Date.now();
    else if (hiddenAtMs !== null && Date.now() - hiddenAtMs > ASLEEP_MS) open();
  });
  open();
};

/** Null for an unknown event, which a newer server may send. */
export const parseServerEvent = (data: string): ServerEvent | null => {
  try {
    const parsed = serverEventSchema.safeParse(JSON.parse(data));
    return parsed.success ? parsed.data : null;
  } catch {
    return null;
  }
};
