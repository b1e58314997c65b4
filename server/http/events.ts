/**
 * The live event stream (server-sent events): a snapshot first, then every change. All browsers get the same
 * events in the same order. One that does not read is disconnected; it reconnects and gets a new snapshot.
 *
 * The text of the snapshot is kept until something changes, and all clients get the same bytes of it and of each event:
 * the memory that slow clients take does not grow with their number.
 */
import type { Request, Response } from "express";
import { LimitedProgress } from "../../host/limited-progress.js";
import type { PlotSettings, ServerEvent, Snapshot } from "../../src/schema/index.js";

const HEARTBEAT_MS = 15_000;
const MAX_UNSENT_BYTES = 4_000_000;
/** After this time the text of the snapshot is made again, for the progress of plots and positions of pens. */
const SNAPSHOT_MS = 1_000;
/** Clients that lose the server reconnect within this range, not all at once. */
const RETRY_FROM_MS = 1_000;
const RETRY_RANGE_MS = 3_000;

interface Stream {
  readonly callerId: string;
  maxUnsentBytes: number;
}

export class EventHub {
  readonly #streams = new Map<Response, Stream>();
  readonly #events = new LimitedProgress((event) => this.#write(`data: ${JSON.stringify(event)}\n\n`));
  readonly #heartbeat: NodeJS.Timeout;
  #snapshot: { readonly text: Buffer; readonly atMs: number } | null = null;
  #isClosed = false;

  constructor() {
    this.#heartbeat = setInterval(() => this.#write(":\n\n"), HEARTBEAT_MS);
    this.#heartbeat.unref();
  }

  announce(event: ServerEvent): void {
    if (this.#isClosed) return;
    if (event.type !== "progress") this.#snapshot = null;
    this.#events.announce(event);
  }

  /** The snapshot as JSON. `make` is called only if it has changed. */
  snapshotText(make: () => Snapshot): Buffer {
    const nowMs = performance.now();
    if (this.#snapshot === null || nowMs - this.#snapshot.atMs > SNAPSHOT_MS) {
      this.#snapshot = { text: Buffer.from(jsonOf(make())), atMs: nowMs };
    }
    return this.#snapshot.text;
  }

  /** `callerId`: the session or key that asks, so that the stream can be ended with it. */
  open(request: Request, response: Response, callerId: string, make: () => Snapshot): void {
    response.writeHead(200, {
      "Content-Type": "text/event-stream; charset=utf-8",
      "Cache-Control": "no-store",
      "X-Accel-Buffering": "no",
    });
    const retryMs = Math.round(RETRY_FROM_MS + RETRY_RANGE_MS * Math.random());
    response.write(`retry: ${retryMs}\n\ndata: {"type":"snapshot","snapshot":`);
    response.write(this.snapshotText(make));
    response.write("}\n\n");
    // A long history takes a while to send. Until then it does not count: otherwise the client would be disconnected
    // by the next event, again after each reconnect.
    const stream = { callerId, maxUnsentBytes: response.writableLength + MAX_UNSENT_BYTES };
    this.#streams.set(response, stream);
    response.once("drain", () => {
      stream.maxUnsentBytes = MAX_UNSENT_BYTES;
    });
    request.on("close", () => this.#streams.delete(response));
  }

  /** Ends the streams of a session or key that has ended. */
  drop(callerId: string): void {
    for (const [response, stream] of this.#streams) if (stream.callerId === callerId) this.#end(response);
  }

  close(): void {
    this.#isClosed = true;
    clearInterval(this.#heartbeat);
    this.#events.close();
    for (const response of this.#streams.keys()) this.#end(response);
  }

  #end(response: Response): void {
    this.#streams.delete(response);
    response.end();
  }

  #write(text: string): void {
    const bytes = Buffer.from(text);
    for (const [response, { maxUnsentBytes }] of this.#streams) {
      if (response.writableLength > maxUnsentBytes) {
        this.#streams.delete(response);
        response.destroy();
      } else {
        response.write(bytes);
      }
    }
  }
}

/** Settings are most of a job's text. They rarely change, and copies of a job share them. */
const settingsTexts = new WeakMap<PlotSettings, string>();

function jsonOf({ jobs, ...others }: Snapshot): string {
  const texts = jobs.map(({ settings, ...job }) => withField(job, "settings", settingsText(settings)));
  return withField(others, "jobs", `[${texts.join(",")}]`);
}

function settingsText(settings: PlotSettings): string {
  const text = settingsTexts.get(settings) ?? JSON.stringify(settings);
  settingsTexts.set(settings, text);
  return text;
}

/** The JSON of an object with one more field. */
const withField = (object: object, name: string, text: string): string =>
  `${JSON.stringify(object).slice(0, -1)},"${name}":${text}}`;
