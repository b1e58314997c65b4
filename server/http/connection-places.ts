/**
 * Who holds the server's connections. A device that has not shown a session or a key is a stranger: strangers share
 * a small part of the places, and each address only a few of those. A new connection always gets a place; where
 * there is none left, the oldest connection of a stranger is closed for it. So strangers can lock nobody out, and
 * most places are kept for paired devices and for this computer.
 */
import type { IncomingMessage } from "node:http";
import type { Socket } from "node:net";

/** A page with its files needs about 10. */
const MOST_OF_ADDRESS = 60;
const MOST_OF_STRANGERS = 300;

export class ConnectionPlaces {
  /** Connections that have shown nothing yet, the oldest first. TLS wraps a socket, so its two ends are the key. */
  readonly #strangers = new Map<string, Socket>();
  readonly #isTrusted: (address: string | undefined) => boolean;

  constructor(isTrusted: (address: string | undefined) => boolean) {
    this.#isTrusted = isTrusted;
  }

  opened(socket: Socket): void {
    if (this.#isTrusted(socket.remoteAddress)) return;
    const key = keyOf(socket);
    this.#strangers.set(key, socket);
    socket.once("close", () => {
      if (this.#strangers.get(key) === socket) this.#strangers.delete(key);
    });
    const all = [...this.#strangers.values()];
    const ofAddress = all.filter(({ remoteAddress }) => remoteAddress === socket.remoteAddress);
    if (ofAddress.length > MOST_OF_ADDRESS) this.#close(ofAddress[0]!);
    else if (all.length > MOST_OF_STRANGERS) this.#close(all[0]!);
  }

  /** The connection's device has shown who it is: it keeps its place for as long as it likes. */
  isKnown({ socket }: IncomingMessage): void {
    this.#strangers.delete(keyOf(socket));
  }

  #close(socket: Socket): void {
    this.#strangers.delete(keyOf(socket));
    socket.destroy();
  }
}

const keyOf = ({ remoteAddress, remotePort }: Socket): string => `${remoteAddress ?? ""} ${remotePort ?? ""}`;
