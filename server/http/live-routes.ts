/**
 * Live drawings: over a WebSocket, which is the only upgrade that this server allows (listen.ts passes it through all
 * guards first), or as the lines of a request's body.
 */
import type { IncomingMessage } from "node:http";
import type { Duplex } from "node:stream";
import type { RequestHandler } from "express";
import { WebSocketServer, type WebSocket } from "ws";
import { PlotwrightError } from "../../src/index.js";
import { LIVE_MESSAGE_BYTES, liveFieldsSchema, type LiveReport } from "../../src/schema/index.js";
import { LiveSession } from "../../host/operations/live-session.js";
import { LIVE_PROTOCOL } from "../../host/handle/live-socket.js";
import { mustKnow, parseWith } from "../../host/parse-with.js";
import { drawLine } from "../../host/plotter/live-lines.js";
import type { LiveStrokes } from "../../host/plotter/live-strokes.js";
import type { JobQueue } from "../../host/queue/job-queue.js";
import type { LiveJob } from "../../host/queue/live-jobs.js";
import type { OperatorLock } from "../security/operator-lock.js";
import { callerIn } from "./auth.js";
import type { Browsers } from "./browser.js";
import { settingsIn } from "./job-routes.js";
import { bytesOf, type Responders } from "./operation-routes.js";

/** Time between two pings, which browsers answer by themselves. */
const PING_MS = 100;
/** A sender that is silent for this time may be gone: the pen is lifted until it answers. */
const SILENT_MS = 400;
/** After this time it counts as lost. */
const LOST_MS = 10_000;
/** Messages of one sender in a second that add nothing to the drawing. */
const MAX_EMPTY_PER_S = 2_000;
/** A sender that does not read its reports is disconnected. */
const MAX_UNREAD_BYTES = 1_000_000;
/** A request that is silent for this time is probed each second, and ends after ten probes without an answer. */
const KEEP_ALIVE_MS = 1_000;
/** Time for a plot to stop when the server ends. */
const CLOSE_MS = 10_000;
/** Longest line of a body, and how many lines the answer names that could not be drawn. */
const MAX_LINE = LIVE_MESSAGE_BYTES;
const MAX_REFUSED = 20;

interface LiveParts {
  readonly queue: JobQueue;
  readonly operatorLock: OperatorLock;
  readonly lives: LiveSockets;
}

/** An upgrade that the guards have not seen yet: what the client has sent after its request. */
const upgrades = new WeakMap<IncomingMessage, Buffer>();
/** Connections whose request may take as long as it takes. */
const endless = new WeakSet<Duplex>();

/** Whether a request asks for a WebSocket of the kind that this server has. Its route then finds `head`. */
export function offerUpgrade(request: IncomingMessage, head: Buffer): boolean {
  const isSocket = request.headers.upgrade?.toLowerCase() === "websocket" && request.method === "GET";
  if (!isSocket || !/^\/api\/v1\/plotters\/[^/?]+\/live$/i.test(request.url ?? "")) return false;
  upgrades.set(request, head);
  return true;
}

export const isEndless = (socket: Duplex): boolean => endless.has(socket);

export const liveResponders = (parts: LiveParts, browsers: Browsers) =>
  ({ draw: openSocket(parts, browsers), send: drawBody(parts) }) satisfies Responders["liveDrawings"];

interface LiveConnection {
  readonly callerId: string;
  readonly session: LiveSession;
}

/** The open WebSockets. */
export class LiveSockets {
  private readonly server = new WebSocketServer({
    noServer: true,
    maxPayload: LIVE_MESSAGE_BYTES,
    perMessageDeflate: false,
    handleProtocols: (offered) => (offered.has(LIVE_PROTOCOL) ? LIVE_PROTOCOL : false),
  });
  private readonly sockets = new Map<WebSocket, LiveConnection>();
  /** Set while those that still draw are waited for. */
  private ending: NodeJS.Timeout | null = null;

  accept(
    request: IncomingMessage,
    head: Buffer,
    callerId: string,
    follow: (socket: WebSocket) => LiveSession,
  ): void {
    this.server.handleUpgrade(request, request.socket, head, (socket) => {
      this.sockets.set(socket, { callerId, session: follow(socket) });
      socket.on("close", () => {
        this.sockets.delete(socket);
        if (this.sockets.size === 0 && this.ending !== null) clearTimeout(this.ending);
      });
    });
  }

  /** Ends those of a session or key that has ended. */
  drop(callerId: string): void {
    for (const [socket, open] of this.sockets) if (open.callerId === callerId) socket.terminate();
  }

  /** Call after the plots were told to stop: those that draw end with the message that their job has ended. */
  close(): void {
    for (const [socket, { session }] of this.sockets) if (!session.isDrawing) socket.terminate();
    if (this.sockets.size === 0) return;
    this.ending = setTimeout(() => this.sockets.forEach((_open, socket) => socket.terminate()), CLOSE_MS);
    this.ending.unref();
  }
}

function openSocket(
  { queue, operatorLock, lives }: LiveParts,
  browsers: Browsers,
): RequestHandler<Record<string, string>> {
  return (request, response) => {
    const head = upgrades.get(request);
    if (head === undefined) {
      throw new PlotwrightError(
        "bad-setting",
        "This address is for a WebSocket. POST takes lines of points.",
      );
    }
    const browser = browsers.of(request);
    const { id: callerId } = callerIn(response);
    const plotterId = request.params["id"];
    response.detachSocket(request.socket);
    lives.accept(request, head, callerId, (socket) => {
      const session = followSocket(socket, (wanted) => queue.live.begin(plotterId, wanted));
      try {
        // Here, because browsers show a page no answer but an open connection.
        if (browser !== null) operatorLock.act(browser);
      } catch (error) {
        session.fail(error);
      }
      return session;
    });
  };
}

/** A session on an open WebSocket. */
function followSocket(
  socket: WebSocket,
  begin: (wanted: Parameters<JobQueue["live"]["begin"]>[1]) => Promise<LiveJob>,
): LiveSession {
  const report = (one: LiveReport): void => {
    if (socket.bufferedAmount > MAX_UNREAD_BYTES) socket.terminate();
    else socket.send(JSON.stringify(one));
    if (one.type === "ended") socket.close(1000);
    if (one.type === "error") socket.close(1008);
  };
  const session = new LiveSession(begin, report);
  let heardMs = performance.now();
  let tickedMs = heardMs;
  let emptyBefore = 0;
  let secondMs = heardMs;
  const heard = (): void => {
    heardMs = performance.now();
    session.isSilent = false;
  };
  const timer = setInterval(() => {
    const nowMs = performance.now();
    // This process was held up: what has come meanwhile is still to be read.
    if (nowMs - tickedMs > 3 * PING_MS) heardMs = nowMs;
    tickedMs = nowMs;
    socket.ping();
    if (nowMs - heardMs > LOST_MS) socket.terminate();
    else if (nowMs - heardMs > SILENT_MS) session.isSilent = true;
  }, PING_MS);
  socket.on("pong", heard);
  socket.on("message", (data: Buffer, isBinary) => {
    heard();
    if (heardMs - secondMs > 1_000) {
      secondMs = heardMs;
      emptyBefore = session.emptyMessages;
    }
    session.take(isBinary ? null : parsed(data));
    if (session.emptyMessages - emptyBefore > MAX_EMPTY_PER_S) {
      session.fail(new PlotwrightError("busy", "Too many messages that add nothing to the drawing."));
    }
  });
  // A frame that is too large, or damaged; "close" follows.
  socket.on("error", () => undefined);
  socket.on("close", () => {
    clearInterval(timer);
    session.close();
  });
  return session;
}

function parsed(data: Buffer): unknown {
  try {
    return JSON.parse(data.toString("utf8"));
  } catch {
    return null;
  }
}

/** Draws the lines of a body while they come: `some-program | curl -T - -X POST …/live`. Answers when all is drawn. */
const drawBody =
  ({ queue }: LiveParts): RequestHandler<Record<string, string>> =>
  async (request, response) => {
    mustKnow(liveFieldsSchema.keyof().options, request.query);
    const { settings, ...fields } = parseWith(liveFieldsSchema, request.query);
    const wanted = { ...fields, ...(settings === undefined ? {} : { settings: settingsIn(settings) }) };
    const live = await queue.live.begin(request.params["id"], wanted);
    const { strokes, ended } = live;
    endless.add(request.socket);
    // If its network is gone without a word, the connection ends after some seconds.
    request.socket.setKeepAlive(true, KEEP_ALIVE_MS);
    response.on("close", () => {
      endless.delete(request.socket);
      live.senderLost();
    });
    if (request.socket.destroyed) live.senderLost();
    // A connection whose body is not read to its end can't be used again.
    response.setHeader("Connection", "close");
    const refused: Refused[] = [];
    const reading = readLines(bytesOf(request), strokes, refused).catch((error: unknown) => {
      live.senderLost();
      if (!strokes.hasFailed) throw error;
    });
    // A job that is cancelled ends although more lines may come.
    const job = await Promise.race([ended, reading.then(() => ended)]);
    response.json({ job, refused });
  };

interface Refused {
  readonly line: number;
  readonly message: string;
}

/** Adds the lines of a body to a live drawing, as fast as there is room. `refused` gets those that can't be drawn. */
async function readLines(
  chunks: AsyncIterable<Uint8Array>,
  strokes: LiveStrokes,
  refused: Refused[],
): Promise<void> {
  let line = 0;
  for await (const text of linesOf(chunks)) {
    line++;
    try {
      drawLine(text, strokes);
      await strokes.room();
    } catch (error) {
      if (strokes.hasFailed || !(error instanceof PlotwrightError)) throw error;
      if (refused.length < MAX_REFUSED) refused.push({ line, message: error.message });
    }
  }
  strokes.end();
}

async function* linesOf(chunks: AsyncIterable<Uint8Array>): AsyncGenerator<string> {
  const decoder = new TextDecoder();
  let rest = "";
  for await (const chunk of chunks) {
    const lines = (rest + decoder.decode(chunk, { stream: true })).split("\n");
    rest = lines.pop() ?? "";
    yield* lines;
    if (rest.length > MAX_LINE) {
      throw new PlotwrightError("too-large", `A line is longer than ${MAX_LINE} characters.`);
    }
  }
  if (rest !== "") yield rest;
}
