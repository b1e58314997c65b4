/** A page's side of the channel: starts the worker, calls the host, and receives its events. */
import type { BackendListener } from "../backend.js";
import { BackendFault } from "../backend.js";
import type { HostMethod } from "./host-api.js";
import { browserText } from "./text.js";
import {
  CHANNEL,
  type FromHost,
  type Message,
  type Remote,
  type ToHost,
  type WorkerStart,
} from "./protocol.js";

/** How long a call waits for a host: after a host's page was closed, there is none for a moment. */
const NO_HOST_MS = 15_000;

interface Waiting {
  readonly resolve: (value: unknown) => void;
  readonly reject: (error: Error) => void;
}

export class HostClient {
  readonly tab = crypto.randomUUID();
  readonly remote: Remote;
  readonly #channel = new BroadcastChannel(CHANNEL);
  readonly #listeners = new Set<BackendListener>();
  readonly #calls = new Map<number, Waiting>();
  readonly #hostWaiters = new Set<() => void>();
  /** The page whose worker is the host; null while none is known. */
  #host: string | null = null;
  #nextId = 1;

  constructor(virtualSpeed: number) {
    const start: WorkerStart = { tab: this.tab, virtualSpeed };
    const worker = new Worker(new URL("./host.worker.ts", import.meta.url), {
      type: "module",
      name: JSON.stringify(start),
    });
    worker.onerror = (event) => this.#failed(event.message);
    this.#channel.onmessage = ({ data }: MessageEvent<Message>) => {
      if (data.to === "pages") this.#hear(data);
    };
    this.remote = new Proxy({} as Remote, {
      get:
        (_target, method) =>
        (...args: readonly unknown[]) =>
          this.#call(method as HostMethod, args),
    });
  }

  get isHost(): boolean {
    return this.#host === this.tab;
  }

  /** Each host's first event is a snapshot. A host that is running already is asked for one. */
  listen(listener: BackendListener): () => void {
    this.#listeners.add(listener);
    this.#send({ to: "host", type: "hello", tab: this.tab });
    return () => this.#listeners.delete(listener);
  }

  /** Makes this page's worker the host. Rejects with `busy` while another host is plotting. */
  async takeOver(): Promise<void> {
    if (this.isHost) return;
    await this.remote.handOver();
    await this.#untilHost(() => this.isHost);
  }

  async #call(method: HostMethod, args: readonly unknown[]): Promise<unknown> {
    await this.#untilHost(() => this.#host !== null);
    const id = this.#nextId++;
    this.#send({ to: "host", type: "call", tab: this.tab, id, method, args });
    return new Promise((resolve, reject) => this.#calls.set(id, { resolve, reject }));
  }

  #hear(message: FromHost): void {
    switch (message.type) {
      case "event":
        if (message.tab !== undefined && message.tab !== this.tab) return;
        if (message.event.type === "snapshot") this.#hostIs(message.host);
        // A host that has handed over still sends events while it closes its plotters.
        if (message.host !== this.#host) return;
        for (const listener of this.#listeners) {
          if (message.event.type === "snapshot") listener.onLink(true);
          listener.onEvent(message.event);
        }
        return;
      case "answer": {
        if (message.tab !== this.tab) return;
        const call = this.#calls.get(message.id);
        this.#calls.delete(message.id);
        const { answer } = message;
        if (answer.ok) call?.resolve(answer.value);
        else call?.reject(new BackendFault(answer.code, answer.message));
        return;
      }
      case "handed-over":
        this.#hostIs(null);
        return;
      case "failed":
        if (message.host === this.tab) this.#failed(message.message);
    }
  }

  /** Sets the host. Calls to the previous one fail, because it no longer answers. */
  #hostIs(host: string | null): void {
    if (host === this.#host) return;
    this.#host = host;
    for (const { reject } of this.#calls.values())
      reject(new BackendFault("unreachable", browserText.closed));
    this.#calls.clear();
    for (const check of this.#hostWaiters) check();
  }

  #failed(message: string): void {
    const notice = { id: "host", at: new Date().toISOString(), message: browserText.failed(message) };
    for (const listener of this.#listeners) listener.onEvent({ type: "notice", notice });
  }

  #untilHost(isReady: () => boolean): Promise<void> {
    return new Promise((resolve, reject) => {
      const end = (): void => {
        clearTimeout(timer);
        this.#hostWaiters.delete(check);
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
      this.#hostWaiters.add(check);
      check();
    });
  }

  #send(message: ToHost): void {
    this.#channel.postMessage(message);
  }
}
