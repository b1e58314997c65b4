/** The page's backend with plotwright's server: REST requests and the live event stream. */
import {
  API_PATH,
  clientOf,
  OPERATIONS,
  requestOf,
  apiErrorSchema,
  type Operation,
  type OperationInput,
  parseServerEvent,
} from "../../../src/schema/index.js";
import { BackendFault, type Backend, type BackendListener, type DrawingSource } from "../backend.js";

/** Texts of errors in requests to the server. */
const serverText = {
  server: (status: number) => `The server answered with an error (${status}). Try again.`,
  unreachable: "The server can’t be reached. Is plotwright still running?",
};

export const createServerBackend = (fetchPath: Fetch = (path, init) => fetch(path, init)): Backend => ({
  ...clientOf(OPERATIONS, (one, input) => sendOperation(fetchPath, one, input)),
  features: { sharing: true, library: true, asksForPort: false, whyNoPort: null },
  listen: (listener) => openEvents(`${API_PATH}${OPERATIONS.state.events.path}`, listener),
  connect: () => Promise.reject(new BackendFault("internal", "The server finds its plotters itself.")),
  live: async (id, wanted) => {
    const { beginLive, liveSocket } = await import("../live.js");
    return beginLive(liveSocket(pageSocket, location.origin, id), wanted);
  },
  fileOf: async ({ of, id }, maxBytes) => {
    const stop = new AbortController();
    const one = SOURCES[of];
    const response = await fetchPath(requestOf(one, { id }).path, { signal: stop.signal });
    if (!response.ok || Number(response.headers.get("content-length") ?? 0) > maxBytes) {
      stop.abort();
      return null;
    }
    return response.arrayBuffer();
  },
});

const pageSocket = (address: string, protocols: string[]): Promise<WebSocket> =>
  Promise.resolve(new WebSocket(address, protocols));

/** The operations that return drawings. */
const SOURCES: Readonly<Record<DrawingSource["of"], Operation>> = {
  job: OPERATIONS.jobs.drawing,
  sample: OPERATIONS.samples.get,
  library: OPERATIONS.library.get,
};

type Fetch = (path: string, init?: RequestInit) => Promise<Response>;

/** Sends one operation, and returns its answer. Rejects with a BackendFault. */
const sendOperation = async (fetchPath: Fetch, one: Operation, input: OperationInput): Promise<unknown> => {
  const { path, body, ...init } = requestOf(one, input);
  let response: Response;
  try {
    response = await fetchPath(path, {
      ...init,
      ...(body === undefined ? {} : { body: one.body === "file" ? new Blob([body]) : body }),
    });
  } catch {
    throw new BackendFault("unreachable", serverText.unreachable);
  }
  if (!response.ok) throw await faultOf(response);
  if (one.answer === "file") {
    // The tables of encodings are not needed before.
    const { contentOf } = await import("../drawing-text.js");
    return contentOf(await response.arrayBuffer());
  }
  if (one.answer === "picture") return response.arrayBuffer();
  if (one.answer === "text" || one.answer === "events" || one.answer === "socket") return response.text();
  return one.answer.parse(await response.json());
};

const faultOf = async (response: Response): Promise<BackendFault> => {
  const parsed = apiErrorSchema.safeParse(await response.json().catch(() => null));
  if (parsed.success) return new BackendFault(parsed.data.error.code, parsed.data.error.message);
  // A proxy between page and server answers without a body.
  const isGone = response.status === 502 || response.status === 503 || response.status === 504;
  return new BackendFault("internal", isGone ? serverText.unreachable : serverText.server(response.status));
};

const RETRY_MS = 1_500;
/** Pages that lose the server together do not all come back at once. */
const spread = (ms: number): number => ms * (0.7 + 0.6 * Math.random());
/** After this many failures (the server is off, or refuses this device) the retries are slower. */
const QUICK_RETRIES = 10;
const SLOW_RETRY_MS = 6_000;
/** A page that was hidden for longer (a phone in a pocket) may have a dead stream without an error event. */
const ASLEEP_MS = 15_000;

/**
 * The live event stream: connects, parses every event with its schema, and always reconnects.
 *
 * The browser does not retry after an HTTP error (from a server that is just starting), so the stream is opened again
 * here. It is also opened again when the network is back or the device wakes up.
 */
const openEvents = (path: string, listener: BackendListener): void => {
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
