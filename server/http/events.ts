/**
 * The live event stream (server-sent events): a snapshot first, then every change. All browsers get the same
 * events in the same order. One that does not read is disconnected; it reconnects and gets a new snapshot.
 *
 * The text of the snapshot is kept until something changes, and all clients get the same bytes of it and of each event:
 * the memory that slow clients take does not grow with their number.
 */
import { pipeline } from "node:stream/promises";
import { setImmediate as nextTurn } from "node:timers/promises";
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

/**
 * Each session or key gets one snapshot at a time: the system takes megabytes for each client that does not read, and a
 * flood of such clients would delay all answers. One that has not read for this time lets the next one begin, so that a
 * device that was suspended is not kept waiting by its own old connection.
 */
const STUCK_MS = 2_000;

/** What is written to one client before others have their turn. The system takes megabytes at once, which takes time. */
const SLICE_BYTES = 65_536;

/** Who gets the state and the events. */
export interface Viewer {
  /** Its session or key, so that its streams can be ended with it. */
  readonly id: string;
  /** Only the jobs that it has added: the role "submit". */
  readonly seesOnlyOwn: boolean;
}

/** Makes a snapshot: of all, or as one submitter sees it. */
type Make = (submitterId?: string) => Snapshot;

interface Stream {
  readonly viewer: Viewer;
  /** The jobs that the client knows, if it sees only its own. */
  readonly ownJobs: Set<string>;
  /** Events after the snapshot that wait until it is sent; "snapshot": it is not made yet; null: all is sent. */
  waiting: Buffer[] | "snapshot" | null;
}

export class EventHub {
  private readonly streams = new Map<Response, Stream>();
  private readonly events = new LimitedProgress((event) => this.send(event));
  private readonly heartbeat: NodeJS.Timeout;
  private snapshot: { readonly text: Buffer; readonly atMs: number } | null = null;
  /** The callers to whom a snapshot is being sent, with the clients that wait for their turn. */
  private readonly waiting = new Map<string, (() => void)[]>();
  /** The time limits of the snapshots that are being sent. */
  private readonly transfers = new Set<NodeJS.Timeout>();
  private isClosed = false;

  constructor() {
    this.heartbeat = setInterval(() => this.writeToAll(":\n\n"), HEARTBEAT_MS);
    this.heartbeat.unref();
  }

  announce(event: ServerEvent): void {
    if (this.isClosed) return;
    if (event.type !== "progress") this.snapshot = null;
    this.events.announce(event);
  }

  /** The snapshot as JSON. `make` is called only if it has changed. */
  snapshotText(make: () => Snapshot): Buffer {
    const nowMs = performance.now();
    if (this.snapshot === null || nowMs - this.snapshot.atMs > SNAPSHOT_MS) {
      this.snapshot = { text: Buffer.from(jsonOf(make())), atMs: nowMs };
    }
    return this.snapshot.text;
  }

  /** Answers with the snapshot. */
  answer(response: Response, viewer: Viewer, make: Make): Promise<void> {
    return this.inTurn(response, viewer.id, async (isRead) => {
      const text = viewer.seesOnlyOwn ? Buffer.from(jsonOf(make(viewer.id))) : this.snapshotText(make);
      response.type("json").set("Content-Length", String(text.length));
      await send(text, response, isRead);
      response.end();
    });
  }

  async open(request: Request, response: Response, viewer: Viewer, make: Make): Promise<void> {
    response.writeHead(200, {
      "Content-Type": "text/event-stream; charset=utf-8",
      "Cache-Control": "no-store",
      "X-Accel-Buffering": "no",
    });
    const retryMs = Math.round(RETRY_FROM_MS + RETRY_RANGE_MS * Math.random());
    response.write(`retry: ${retryMs}\n\ndata: {"type":"snapshot","snapshot":`);
    const stream: Stream = { viewer, ownJobs: new Set(), waiting: "snapshot" };
    this.streams.set(response, stream);
    request.on("close", () => this.streams.delete(response));
    await this.inTurn(response, viewer.id, async (isRead) => {
      const text = viewer.seesOnlyOwn ? this.ownSnapshot(stream, make) : this.snapshotText(make);
      const events: Buffer[] = [];
      stream.waiting = events;
      if (!(await send(text, response, isRead))) return;
      response.write("}\n\n");
      for (const event of events) response.write(event);
      stream.waiting = null;
    });
  }

  private ownSnapshot({ viewer, ownJobs }: Stream, make: Make): Buffer {
    const snapshot = make(viewer.id);
    for (const { id } of snapshot.jobs) ownJobs.add(id);
    return Buffer.from(jsonOf(snapshot));
  }

  /** Transfers to a caller one after the other. `transfer` calls `isRead` whenever the client reads on. */
  private async inTurn(
    response: Response,
    callerId: string,
    transfer: (isRead: () => unknown) => Promise<void>,
  ): Promise<void> {
    const before = this.waiting.get(callerId);
    if (before === undefined) this.waiting.set(callerId, []);
    else await new Promise<void>((resolve) => before.push(resolve));
    let hasPassed = false;
    const pass = (): void => {
      if (hasPassed) return;
      hasPassed = true;
      // The newest first: older ones may be those of a page that was reloaded.
      const next = this.waiting.get(callerId)?.pop();
      if (next === undefined) this.waiting.delete(callerId);
      else next();
    };
    if (this.isClosed || response.closed) {
      pass();
      return;
    }
    const stuck = setTimeout(pass, STUCK_MS).unref();
    this.transfers.add(stuck);
    try {
      await transfer(() => !this.isClosed && stuck.refresh());
    } finally {
      clearTimeout(stuck);
      this.transfers.delete(stuck);
      pass();
    }
  }

  /** Ends the streams of a session or key that has ended. */
  drop(callerId: string): void {
    for (const [response, stream] of this.streams) if (stream.viewer.id === callerId) this.end(response);
  }

  close(): void {
    this.isClosed = true;
    clearInterval(this.heartbeat);
    for (const stuck of this.transfers) clearTimeout(stuck);
    this.events.close();
    for (const response of this.streams.keys()) this.end(response);
  }

  private end(response: Response): void {
    this.streams.delete(response);
    response.end();
  }

  private send(event: ServerEvent): void {
    const bytes = bytesOf(event);
    for (const [response, stream] of this.streams) {
      // The snapshot will have everything that is announced before.
      if (stream.waiting === "snapshot") continue;
      const own = stream.viewer.seesOnlyOwn ? ownPart(event, stream) : event;
      if (own !== null) this.write(response, stream, own === event ? bytes : bytesOf(own));
    }
  }

  private writeToAll(text: string): void {
    const bytes = Buffer.from(text);
    for (const [response, stream] of this.streams) this.write(response, stream, bytes);
  }

  private write(response: Response, { waiting }: Stream, bytes: Buffer): void {
    if (waiting === "snapshot") return;
    const unsentBytes = waiting?.reduce((sum, { length }) => sum + length, 0) ?? response.writableLength;
    if (unsentBytes > MAX_UNSENT_BYTES) {
      this.streams.delete(response);
      response.destroy();
    } else if (waiting !== null) waiting.push(bytes);
    else response.write(bytes);
  }
}

const bytesOf = (event: ServerEvent): Buffer => Buffer.from(`data: ${JSON.stringify(event)}\n\n`);

/** What a client that sees only its own jobs gets of an event; null: nothing. */
function ownPart(event: ServerEvent, { viewer, ownJobs }: Stream): ServerEvent | null {
  switch (event.type) {
    case "job":
      if (event.job.submittedBy?.id !== viewer.id) return null;
      ownJobs.add(event.job.id);
      return event;
    case "job-removed":
      return ownJobs.delete(event.id) ? event : null;
    case "progress":
      return ownJobs.has(event.jobId) ? event : null;
    case "order":
      return { ...event, ids: event.ids.filter((id) => ownJobs.has(id)) };
    case "expected":
      return {
        ...event,
        expectedS: Object.fromEntries(Object.entries(event.expectedS).filter(([id]) => ownJobs.has(id))),
      };
    // They name the drawings of others.
    case "notice":
    case "notice-removed":
      return null;
    case "snapshot":
    case "plotter":
    case "plotters":
    case "plotter-settings":
    case "machines":
    case "queue":
    case "queues":
    case "operator":
    case "local-name":
      return event;
  }
}

/** The same bytes without a copy, one slice in each turn of the event loop. False: the client has closed. */
const send = (bytes: Buffer, response: Response, isRead: () => unknown): Promise<boolean> =>
  pipeline(slicesOf(bytes, isRead), response, { end: false }).then(
    () => true,
    () => false,
  );

async function* slicesOf(bytes: Buffer, isRead: () => unknown): AsyncGenerator<Buffer> {
  for (let from = 0; from < bytes.length; from += SLICE_BYTES) {
    isRead();
    yield bytes.subarray(from, from + SLICE_BYTES);
    await nextTurn();
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
