/**
 * Limits the connections of unknown clients. A client is unknown until it has sent a valid session or key.
 * Unknown clients share a small part of the server's connections, and each address may have only a few of
 * them. A new connection is always accepted; at the limit, the oldest unknown connection is closed. So
 * unknown clients cannot lock others out, and most connections remain for paired devices and for this computer.
 */
import type { IncomingMessage } from "node:http";
import type { Socket } from "node:net";

/** Loading the page with its files takes about 10 connections. */
const MAX_PER_ADDRESS = 60;
const MAX_UNKNOWN = 300;

export class ConnectionLimits {
  /**
   * Unknown connections, oldest first. TLS wraps the socket object, so the key is the remote address and
   * port.
   */
  readonly #unknown = new Map<string, Socket>();
  readonly #isTrusted: (address: string | undefined) => boolean;

  constructor(isTrusted: (address: string | undefined) => boolean) {
    this.#isTrusted = isTrusted;
  }

  opened(socket: Socket): void {
    if (this.#isTrusted(socket.remoteAddress)) return;
    const key = keyOf(socket);
    this.#unknown.set(key, socket);
    socket.once("close", () => {
      if (this.#unknown.get(key) === socket) this.#unknown.delete(key);
    });
    const all = [...this.#unknown.values()];
    const ofAddress = all.filter(({ remoteAddress }) => remoteAddress === socket.remoteAddress);
    if (ofAddress.length > MAX_PER_ADDRESS) this.#close(ofAddress[0]);
    else if (all.length > MAX_UNKNOWN) this.#close(all[0]);
  }

  /** Call when a client has identified itself: its connection no longer counts as unknown. */
  identified({ socket }: IncomingMessage): void {
    this.#unknown.delete(keyOf(socket));
  }

  #close(socket: Socket): void {
    this.#unknown.delete(keyOf(socket));
    socket.destroy();
  }
}

const keyOf = ({ remoteAddress, remotePort }: Socket): string => `${remoteAddress ?? ""} ${remotePort ?? ""}`;
