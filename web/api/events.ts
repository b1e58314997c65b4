/** The live event stream: connects, parses every event by the schema, and connects again for ever. */
import { serverEventSchema, type ServerEvent } from "../../src/schema/index.js";

export interface EventsListener {
  onEvent(event: ServerEvent): void;
  onLink(isConnected: boolean): void;
}

const RETRY_MS = 1_500;

/**
 * Returns a function that closes it. The browser's own retry stops for good after an HTTP error
 * (a server that is just starting), so a closed stream is opened anew.
 */
export const openEvents = (path: string, listener: EventsListener): (() => void) => {
  let source: EventSource | null = null;
  let retry: ReturnType<typeof setTimeout> | null = null;

  const open = (): void => {
    source = new EventSource(path);
    source.onmessage = ({ data }: MessageEvent<string>) => {
      const event = parseServerEvent(data);
      if (!event) return;
      if (event.type === "snapshot") listener.onLink(true);
      listener.onEvent(event);
    };
    source.onerror = () => {
      listener.onLink(false);
      if (source?.readyState !== EventSource.CLOSED) return;
      retry = setTimeout(open, RETRY_MS);
    };
  };
  open();
  return () => {
    if (retry !== null) clearTimeout(retry);
    source?.close();
  };
};

/** Null for what is no event of ours: a newer server may send kinds that this page does not know. */
export const parseServerEvent = (data: string): ServerEvent | null => {
  try {
    const parsed = serverEventSchema.safeParse(JSON.parse(data));
    return parsed.success ? parsed.data : null;
  } catch {
    return null;
  }
};
