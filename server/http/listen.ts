/** The HTTP server, plain or TLS: its limits, and the errors when its port can't be opened. */
import {
  createServer as createHttpServer,
  type IncomingMessage,
  type RequestListener,
  type Server,
  ServerResponse,
} from "node:http";
import { createServer as createHttpsServer } from "node:https";
import type { AddressInfo, Socket } from "node:net";
import type { Duplex } from "node:stream";
import { PlotwrightError } from "../../src/index.js";
import type { Access } from "../security/access.js";
import { callerOf, isTrustedAddress } from "./auth.js";
import { ConnectionLimits, MAX_CONNECTIONS } from "./connection-limits.js";
import { isEndless, offerUpgrade } from "./live-routes.js";
import type { Refusals } from "./refusals.js";

/** PEM texts. */
export interface TlsFiles {
  readonly cert: string;
  readonly key: string;
}

/**
 * Slow uploads are cut off: headers must arrive within 20 s, the whole request within 10 minutes. The
 * keep-alive time is longer than the system may suspend this process. Otherwise, on waking, the process would
 * close an idle connection before reading from it, and a request that arrived meanwhile would be lost.
 */
const TIMES = {
  headersTimeout: 20_000,
  requestTimeout: 10 * 60_000,
  keepAliveTimeout: 75_000,
  connectionsCheckingInterval: 10_000,
  /** A client that does not read the answer or the events that it asked for is disconnected after this time. */
  unreadTimeout: 30_000,
};
/** Requests of a known client that may wait on a connection for the answers to earlier ones. */
const MAX_WAITING = 10;

/**
 * Answers and closes the socket. A connection left half open by the client would keep the port from closing.
 */
function hangUp(socket: Duplex, status: string): void {
  socket.end(`HTTP/1.1 ${status}\r\nConnection: close\r\nContent-Length: 0\r\n\r\n`, () => socket.destroy());
}

/** Throws `bad-setting` when the certificate can't be used. */
export function httpServer(
  tls: TlsFiles | undefined,
  app: RequestListener,
  access: Access,
  refusals: Refusals,
  times: Partial<typeof TIMES> = {},
): Server {
  const limits = new ConnectionLimits((address) => isTrustedAddress(address, access));
  const turns = new Turns(app);
  const listener: RequestListener = (request, response) => {
    // Closed by the rules below, while Node still passes on requests that it has already parsed.
    if (request.socket.destroyed) return;
    const caller = callerOf(request, access);
    if (caller !== null) limits.identified(request.socket, caller);
    // Connections of unknown clients end with the answer, so that refused connections cannot pile up.
    else response.setHeader("Connection", "close");
    turns.take(request, response, caller === null ? 0 : MAX_WAITING);
  };
  const server =
    tls === undefined
      ? createHttpServer({ ...TIMES, ...times }, listener)
      : secureServer(tls, listener, times);
  // Otherwise Node would answer these by itself, past the rules above.
  server.on("checkExpectation", listener);
  server.maxConnections = MAX_CONNECTIONS;
  server.on("connection", (socket) => limits.opened(socket));
  server.setTimeout({ ...TIMES, ...times }.unreadTimeout, (socket) => {
    // Nothing was sent or received for some time. That is as it should be only while an answer is being prepared.
    if (!turns.isBusy(socket) || socket.writableLength > 0) socket.destroy();
  });
  server.on("upgrade", (request, socket, head) => {
    // Node has removed its own listener. Without one, a client that resets the connection would end the process.
    socket.on("error", () => socket.destroy());
    const caller = callerOf(request, access);
    if (caller === null || !offerUpgrade(request, head)) {
      refusals.note(request, caller === null ? "not paired" : "no upgrade to another protocol");
      hangUp(socket, "403 Forbidden");
      return;
    }
    limits.identified(socket as Socket, caller);
    guardUpgrade(app, request, socket as Socket);
  });
  server.on("clientError", (error: NodeJS.ErrnoException, socket) => {
    const isSlow = error.code === "ERR_HTTP_REQUEST_TIMEOUT";
    if (isSlow && isEndless(socket)) return;
    if (isSlow) refusals.note({ socket: socket as Socket }, "it arrived too slowly");
    if (socket.writable && error.code !== "ECONNRESET") {
      hangUp(socket, isSlow ? "408 Request Timeout" : "400 Bad Request");
    } else socket.destroy();
  });
  return server;
}

/** Lets the app check an upgrade as any other request. Its route accepts it; otherwise the answer is the refusal. */
function guardUpgrade(app: RequestListener, request: IncomingMessage, socket: Socket): void {
  const response = new ServerResponse(request);
  response.assignSocket(socket);
  response.setHeader("Connection", "close");
  response.on("finish", () => socket.end(() => socket.destroy()));
  app(request, response);
}

/**
 * Passes on one request of each connection at a time. Node itself parses all requests of a received block at once, and
 * would start hundreds of them together.
 */
class Turns {
  /** The requests that wait behind the current one, by connection. */
  private readonly waiting = new WeakMap<Socket, [IncomingMessage, ServerResponse][]>();

  constructor(private readonly app: RequestListener) {}

  isBusy(socket: Socket): boolean {
    return this.waiting.has(socket);
  }

  /** Starts a request, or lets it wait; closes the connection when more than `maxWaiting` would wait. */
  take(request: IncomingMessage, response: ServerResponse, maxWaiting: number): void {
    const { socket } = request;
    const waiting = this.waiting.get(socket);
    if (waiting === undefined) {
      this.waiting.set(socket, []);
      this.start(request, response);
    } else if (waiting.length < maxWaiting) waiting.push([request, response]);
    else this.cutOff(socket);
  }

  /**
   * Node makes an error for each of the hundreds of requests that it has already parsed. Their stack traces alone would
   * take most of the time that a flood costs.
   */
  private cutOff(socket: Socket): void {
    const { stackTraceLimit } = Error;
    socket.prependOnceListener("close", () => (Error.stackTraceLimit = 0));
    socket.once("close", () => (Error.stackTraceLimit = stackTraceLimit));
    socket.destroy();
  }

  private start(request: IncomingMessage, response: ServerResponse): void {
    const { socket } = request;
    response.once("close", () => {
      const next = this.waiting.get(socket)?.shift();
      if (next === undefined || socket.destroyed) this.waiting.delete(socket);
      else this.start(...next);
    });
    this.app(request, response);
  }
}

function secureServer(tls: TlsFiles, app: RequestListener, times: Partial<typeof TIMES>): Server {
  try {
    return createHttpsServer({ ...TIMES, ...times, ...tls }, app);
  } catch (cause) {
    throw new PlotwrightError(
      "bad-setting",
      `The certificate or its key can't be used (${(cause as Error).message}). Pass PEM files with --cert and --key.`,
      { cause },
    );
  }
}

export function listen(http: Server, port: number, host: string): Promise<void> {
  return new Promise((resolve, reject) => {
    http.once("error", (cause: NodeJS.ErrnoException) => reject(listenFault(cause, port, host)));
    http.listen(port, host, resolve);
  });
}

const LISTEN_FAULTS: Readonly<Record<string, string>> = {
  EACCES: "this user may not use that port; choose one above 1023 with --port",
  EADDRNOTAVAIL: "this computer does not have that address; choose another with --host",
  ENOTFOUND: "no computer has that name; choose another with --host",
};

function listenFault(cause: NodeJS.ErrnoException, port: number, host: string): PlotwrightError {
  if (cause.code === "EADDRINUSE") {
    return new PlotwrightError(
      "conflict",
      `Port ${port} is taken by another program. Stop it, or choose another with --port.`,
      { cause },
    );
  }
  return new PlotwrightError(
    "bad-setting",
    `Can't listen on ${host}:${port}: ${LISTEN_FAULTS[cause.code ?? ""] ?? cause.message}.`,
    { cause },
  );
}

/** The URL of the server on this computer. */
export function urlOf(http: Server, isTls: boolean): string {
  const { address, port, family } = http.address() as AddressInfo;
  const isAny = address === "::" || address === "0.0.0.0";
  const host = isAny ? "127.0.0.1" : family === "IPv6" ? `[${address}]` : address;
  return `${isTls ? "https" : "http"}://${host}:${port}`;
}
