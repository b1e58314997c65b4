/**
 * The worker that every page starts. The one that gets the Web Lock is the host; the others wait for the lock. When the
 * host's page is closed or dies, its lock is released, and the next worker takes over from the stored state.
 */
import { faultOf } from "../../../host/planning/messages.js";
import { performOperation } from "../../../host/operations/host-operations.js";
import { PlotwrightError } from "../../../src/index.js";
import { LiveSession } from "../../../host/operations/live-session.js";
import {
  OPERATIONS,
  type LiveReport,
  type Operation,
  type OperationTable,
} from "../../../src/schema/index.js";
import { hasLocks, provideRandomIds } from "./capabilities.js";
import { openHost, type Host } from "./host.js";
import {
  HOST_LOCK,
  type Answer,
  type FromHost,
  type HostCall,
  type Message,
  type PageVisibility,
  type ToHost,
  type WorkerStart,
} from "./protocol.js";
import { browserText } from "./text.js";

type Call = Extract<ToHost, { type: "call" }>;

provideRandomIds();
const start = JSON.parse(self.name) as WorkerStart;
const channel = new BroadcastChannel(start.channel);
let host: Host | null = null;
let isPageHidden = false;
/** Releases the lock: this worker is then no longer the host. */
let release: () => void = () => undefined;
/** The page to which another host has handed over. */
let next: string | null = null;

/** A message without `to` and `host`, which `post` adds. */
type Sent = FromHost extends infer One ? (One extends FromHost ? Omit<One, "to" | "host"> : never) : never;
const post = (message: Sent): void => channel.postMessage({ to: "pages", host: start.tab, ...message });

channel.onmessage = ({ data }: MessageEvent<Message>) => {
  if (data.to === "pages") {
    if (data.type === "handed-over") next = data.next;
  } else if (host !== null && data.type === "hello") sendSnapshot(host, data.tab);
  else if (host !== null && data.type === "call") void answer(host, data);
  else if (host !== null && data.type === "live") takeLive(host, data);
};

self.onmessage = ({ data }: MessageEvent<PageVisibility>) => {
  isPageHidden = data.isHidden;
};

function sendSnapshot({ snapshot }: Host, tab?: string): void {
  post({
    type: "event",
    event: { type: "snapshot", snapshot: snapshot() },
    ...(tab === undefined ? {} : { tab }),
  });
}

async function answer(from: Host, call: Call): Promise<void> {
  const { tab, id } = call;
  const result = await resultOf(from, call);
  post({ type: "answer", tab, id, answer: result });
  if (
    call.call.group !== "host" ||
    call.call.name !== "handOver" ||
    !result.ok ||
    tab === start.tab ||
    host !== from
  )
    return;
  host = null;
  await from.close();
  post({ type: "handed-over", next: tab });
  release();
}

async function resultOf(from: Host, { tab, call }: Call): Promise<Answer> {
  try {
    if (tab !== start.tab && !isOpenToAll(from, call)) {
      throw anotherTab();
    }
    const value = await perform(from, call);
    // Reading works while changes can't be stored. Handing over does not: they would be lost.
    if (!isReading(call) || call.name === "handOver") await from.written();
    return { ok: true, value };
  } catch (error) {
    return { ok: false, ...faultOf(error) };
  }
}

/** The live drawings of this page, by the number that the page gave them. */
const lives = new Map<number, LiveSession>();

function takeLive(from: Host, { tab, id, plotterId, message }: Extract<ToHost, { type: "live" }>): void {
  const report = (one: LiveReport): void => {
    post({ type: "live", tab, id, report: one });
    if (one.type === "ended" || one.type === "error") lives.delete(id);
  };
  if (tab !== start.tab) return report({ type: "error", ...faultOf(anotherTab()) });
  if (message !== null && "begin" in message) {
    lives.set(id, new LiveSession((wanted) => from.beginLive(plotterId, wanted), report));
  }
  if (message === null) lives.get(id)?.close();
  else lives.get(id)?.take(message);
}

const anotherTab = (): PlotwrightError =>
  new PlotwrightError(
    "not-operator",
    "Another tab is operating. Take over to change something; you can stop a plot without taking over.",
  );

function perform({ operations, own }: Host, { group, name, input }: HostCall): unknown {
  if (group === "host") return own[name](String(input.id));
  const handlers = operations[group] as Readonly<Record<string, (...args: never[]) => unknown>> | undefined;
  const handler = handlers?.[name];
  if (handler === undefined) throw new PlotwrightError("not-allowed", browserText.needsServer);
  return performOperation(operationOf(group, name), handler, input, {});
}

const operationOf = (group: keyof typeof OPERATIONS, name: string): Operation =>
  (OPERATIONS as OperationTable)[group][name];

/** All pages may hand over, which changes nothing itself. */
const isReading = ({ group, name }: HostCall): boolean =>
  group === "host" ? name !== "reconnect" : operationOf(group, name).method === "get";

/** All pages may stop a running job or a move by hand, but only the operator may cancel a queued job. */
const isOpenToAll = ({ isRunning }: Host, call: HostCall): boolean =>
  isReading(call) ||
  (call.group !== "host" &&
    operationOf(call.group, call.name).role === "stop" &&
    (call.group !== "jobs" || isRunning(String(call.input.id))));

async function serve(): Promise<void> {
  for (;;) {
    await navigator.locks.request(HOST_LOCK, async () => {
      const isForAnother = next !== null && next !== start.tab;
      next = null;
      if (isForAnother) return;
      const released = new Promise<void>((resolve) => (release = resolve));
      await beHost();
      await released;
    });
  }
}

async function beHost(): Promise<void> {
  host = await openHost(start, {
    send: (event) => post({ type: "event", event }),
    isPageHidden: () => isPageHidden,
  });
  sendSnapshot(host);
}

const serving = hasLocks() ? serve() : beHost();
serving.catch((error: unknown) => post({ type: "failed", message: faultOf(error).message }));
