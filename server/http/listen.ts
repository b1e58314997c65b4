/** The HTTP server, plain or TLS: its limits, and the errors when its port can't be opened. */
import { createServer as createHttpServer, type RequestListener, type Server } from "node:http";
import { createServer as createHttpsServer } from "node:https";
import type { AddressInfo } from "node:net";
import type { Duplex } from "node:stream";
import { PlotwrightError } from "../../src/index.js";
import type { Access } from "../security/access.js";
import { isTrustedAddress, roleOf } from "./auth.js";
import { ConnectionLimits } from "./connection-limits.js";

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
};
const MAX_CONNECTIONS = 1_000;

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
  log: (line: string) => void,
  times: Partial<typeof TIMES> = {},
): Server {
  const limits = new ConnectionLimits((address) => isTrustedAddress(address, access));
  const listener: RequestListener = (request, response) => {
    if (roleOf(request, access) !== null) limits.identified(request);
    // Connections of unknown clients end with the answer, so that refused connections cannot pile up.
    else response.setHeader("Connection", "close");
    app(request, response);
  };
  const server =
    tls === undefined
      ? createHttpServer({ ...TIMES, ...times }, listener)
      : secureServer(tls, listener, times);
  server.maxConnections = MAX_CONNECTIONS;
  server.on("connection", (socket) => limits.opened(socket));
  // The server supports no other protocol: refuse all upgrades (such as WebSockets, perhaps from another
  // site).
  server.on("upgrade", (request, socket) => {
    // Node has removed its own listener. Without one, a client that resets the connection would end the process.
    socket.on("error", () => socket.destroy());
    log(`refused upgrade to ${request.headers.upgrade ?? "?"} from ${request.socket.remoteAddress ?? "?"}`);
    hangUp(socket, "403 Forbidden");
  });
  server.on("clientError", (error: NodeJS.ErrnoException, socket) => {
    const isSlow = error.code === "ERR_HTTP_REQUEST_TIMEOUT";
    if (isSlow) log("refused a request that arrived too slowly");
    if (socket.writable && error.code !== "ECONNRESET") {
      hangUp(socket, isSlow ? "408 Request Timeout" : "400 Bad Request");
    } else socket.destroy();
  });
  return server;
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
