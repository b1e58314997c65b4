/** A page's side of the channel: starts the worker, calls the host, and receives its events. */
import { PlotwrightError } from "../../../src/index.js";
import type { LiveMessage, LiveReport } from "../../../src/schema/index.js";
import type { LiveLink } from "../../../host/handle/live-sender.js";
import { BackendFault, type BackendListener } from "../backend.js";
import type { OwnMethods } from "./host-api.js";
import { hasLocks, provideRandomIds } from "./capabilities.js";
import { browserText } from "./text.js";
import {
  CHANNEL,
  type FromHost,
  type HostCall,
  type Message,
  type PageVisibility,
  type ToHost,
  type WorkerStart,
} from "./protocol.js";
import { reasonOf } from "./worker-fault.js";

/** How long a call waits for a host. After the host's page is closed, there is no host for a moment. */
const NO_HOST_MS = 15_000;

interface Waiting {
  readonly resolve: (value: unknown) => void;
  readonly reject: (error: Error) => void;
}

/** The sender's ends of a live drawing. */
interface LiveEnds {
  readonly report: (report: LiveReport) => void;
  readonly lost: (error: PlotwrightError) => void;
}

export class HostClient {
  readonly tab: string;
  private readonly channel: BroadcastChannel;
  private readonly listeners = new Set<BackendListener>();
  private readonly calls = new Map<number, Waiting>();
  private readonly lives = new Map<number, LiveEnds>();
  private readonly hostWaiters = new Set<() => void>();
  /** The page whose worker is the host; null while none is known. */
  private host: string | null = null;
  private nextId = 1;

  constructor(virtualSpeed: number) {
    provideRandomIds();
    this.tab = crypto.randomUUID();
    const channel = hasLocks() ? CHANNEL : `${CHANNEL}-${this.tab}`;
    this.channel = new BroadcastChannel(channel);
    const start: WorkerStart = { tab: this.tab, channel, virtualSpeed };
    const worker = new Worker(new URL("./host.worker.ts", import.meta.url), {
      type: "module",
      name: JSON.stringify(start),
    });
    const sendVisibility = (): void => {
      const message: PageVisibility = { isHidden: document.visibilityState === "hidden" };
      worker.postMessage(message);
    };
    document.addEventListener("visibilitychange", sendVisibility);
    sendVisibility();
    worker.onerror = (event) => this.failed(reasonOf(event));
    this.channel.onmessage = ({ data }: MessageEvent<Message>) => {
      if (data.to === "pages") this.receive(data);
    };
  }

  get isHost(): boolean {
    return this.host === this.tab;
  }

  /** The first event of a host is a snapshot. This asks a host that is already running for another one. */
  listen(listener: BackendListener): void {
    this.listeners.add(listener);
    this.send({ to: "host", type: "hello", tab: this.tab });
  }

  /** Makes this page's worker the host. Rejects with `busy` while another host is plotting. */
  async takeOver(): Promise<void> {
    if (this.isHost) return;
    await this.callOwn("handOver");
    await this.untilHost(() => this.isHost);
  }

  /** Calls a method that only this host has. */
  async callOwn<Name extends keyof OwnMethods>(
    name: Name,
    id?: string,
  ): Promise<Awaited<ReturnType<OwnMethods[Name]>>> {
    return (await this.call({ group: "host", name, input: { id } })) as Awaited<ReturnType<OwnMethods[Name]>>;
  }

  async call(call: HostCall): Promise<unknown> {
    await this.untilHost(() => this.host !== null);
    const id = this.nextId++;
    this.send({ to: "host", type: "call", tab: this.tab, id, call });
    return new Promise((resolve, reject) => this.calls.set(id, { resolve, reject }));
  }

  /** Opens a live drawing on a plotter of the host. */
  async openLive(
    plotterId: string,
    report: (report: LiveReport) => void,
    lost: (error: PlotwrightError) => void,
  ): Promise<LiveLink> {
    await this.untilHost(() => this.host !== null);
    const id = this.nextId++;
    const { tab } = this;
    const send = (message: LiveMessage | null): void =>
      this.send({ to: "host", type: "live", tab, id, plotterId, message });
    this.lives.set(id, { report, lost });
    return {
      send,
      close: () => {
        if (this.lives.delete(id)) send(null);
      },
    };
  }

  private receive(message: FromHost): void {
    switch (message.type) {
      case "event":
        if (message.tab !== undefined && message.tab !== this.tab) return;
        if (message.event.type === "snapshot") this.setHost(message.host);
        // A host that has handed over still sends events while it closes its plotters.
        if (message.host !== this.host) return;
        for (const listener of this.listeners) {
          if (message.event.type === "snapshot") listener.onLink(true);
          listener.onEvent(message.event);
        }
        return;
      case "answer": {
        if (message.tab !== this.tab) return;
        const call = this.calls.get(message.id);
        this.calls.delete(message.id);
        const { answer } = message;
        if (answer.ok) call?.resolve(answer.value);
        else call?.reject(new BackendFault(answer.code, answer.message));
        return;
      }
      case "live":
        if (message.tab === this.tab) this.lives.get(message.id)?.report(message.report);
        return;
      case "handed-over":
        this.setHost(null);
        return;
      case "failed":
        if (message.host === this.tab) this.failed(message.message);
    }
  }

  /** Sets the host. Calls to the previous one fail, because it no longer answers. */
  private setHost(host: string | null): void {
    if (host === this.host) return;
    this.host = host;
    for (const { reject } of this.calls.values()) reject(new BackendFault("unreachable", browserText.closed));
    this.calls.clear();
    for (const { lost } of this.lives.values()) lost(new PlotwrightError("disconnected", browserText.closed));
    this.lives.clear();
    for (const check of this.hostWaiters) check();
  }

  private failed(message: string): void {
    const notice = { id: "host", at: new Date().toISOString(), message: browserText.failed(message) };
    for (const listener of this.listeners) listener.onEvent({ type: "notice", notice });
  }

  private untilHost(isReady: () => boolean): Promise<void> {
    return new Promise((resolve, reject) => {
      const end = (): void => {
        clearTimeout(timer);
        this.hostWaiters.delete(check);
      };
      const check = (): void => {
        if (!isReady()) return;
        end();
        resolve();
      };
      const timer = setTimeout(() => {
        end();
        reject(new BackendFault("unreachable", browserText.noHost));
      }, NO_HOST_MS);
      this.hostWaiters.add(check);
      check();
    });
  }

  private send(message: ToHost): void {
    this.channel.postMessage(message);
  }
}
