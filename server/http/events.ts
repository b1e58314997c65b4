/**
 * The live event stream (server-sent events): a snapshot first, then every change. All browsers get the same
 * events in the same order. One that does not read is disconnected; it reconnects and gets a new snapshot.
 */
import type { Request, Response } from "express";
import { LimitedProgress } from "../../host/limited-progress.js";
import type { ServerEvent, Snapshot } from "../../src/schema/index.js";

const HEARTBEAT_MS = 15_000;
const MAX_UNSENT_BYTES = 4_000_000;

export class EventHub {
  /** Each client's limit of unsent bytes. */
  readonly #clients = new Map<Response, number>();
  readonly #events = new LimitedProgress((event) => this.#write(line(event)));
  readonly #heartbeat: NodeJS.Timeout;
  #isClosed = false;

  constructor() {
    this.#heartbeat = setInterval(() => this.#write(":\n\n"), HEARTBEAT_MS);
    this.#heartbeat.unref();
  }

  announce(event: ServerEvent): void {
    if (this.#isClosed) return;
    this.#events.announce(event);
  }

  open(request: Request, response: Response, snapshot: () => Snapshot): void {
    response.writeHead(200, {
      "Content-Type": "text/event-stream; charset=utf-8",
      "Cache-Control": "no-store",
      "X-Accel-Buffering": "no",
    });
    response.write(`retry: 1000\n\n${line({ type: "snapshot", snapshot: snapshot() })}`);
    // A long history takes a while to send. Until then it does not count: otherwise the client would be disconnected
    // by the next event, again after each reconnect.
    this.#clients.set(response, response.writableLength + MAX_UNSENT_BYTES);
    response.once("drain", () => {
      if (this.#clients.has(response)) this.#clients.set(response, MAX_UNSENT_BYTES);
    });
    request.on("close", () => this.#clients.delete(response));
  }

  /** Ends every stream; clients that still have access reconnect at once. */
  dropAll(): void {
    for (const client of this.#clients.keys()) client.end();
    this.#clients.clear();
  }

  close(): void {
    this.#isClosed = true;
    clearInterval(this.#heartbeat);
    this.#events.close();
    this.dropAll();
  }

  #write(text: string): void {
    for (const [client, limit] of this.#clients) {
      if (client.writableLength > limit) {
        this.#clients.delete(client);
        client.destroy();
      } else {
        client.write(text);
      }
    }
  }
}

const line = (event: ServerEvent): string => `data: ${JSON.stringify(event)}\n\n`;
