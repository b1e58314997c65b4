/**
 * Limits the connections of each client. A client is unknown until it has sent a valid session or key. Unknown clients,
 * watchers, those who submit jobs, operators and this computer each have a share of the server's connections, and each
 * client has a limit within its share. So no client, and no number of unknown clients or watchers, can take the
 * connections of operators.
 *
 * A new connection is always accepted; at a limit, the oldest one of the client that has the most is closed.
 */
import type { Socket } from "node:net";
import type { Role } from "../../src/schema/index.js";
import type { Caller } from "./auth.js";

type Share = "unknown" | "local" | Role;

/**
 * Max connections of one client, and of all clients together. A browser has about 10, and more while it loads the page.
 * An unknown client is an address, which all visitors behind a proxy share.
 */
const LIMITS: Readonly<Record<Share, { readonly each: number; readonly all: number }>> = {
  unknown: { each: 60, all: 300 },
  watch: { each: 50, all: 300 },
  submit: { each: 20, all: 300 },
  operate: { each: 100, all: 300 },
  local: { each: 300, all: 300 },
};

/** A last limit, higher than all shares together: at it, Node would refuse connections of operators too. */
export const MAX_CONNECTIONS = 1_600;

interface Member {
  readonly socket: Socket;
  share: Share;
  client: string;
}

export class ConnectionLimits {
  /** TLS wraps the socket object, so the key is the remote address and port. Within a share, the oldest come first. */
  private readonly members = new Map<string, Member>();

  constructor(private readonly isLocal: (address: string | undefined) => boolean) {}

  opened(socket: Socket): void {
    const key = keyOf(socket);
    const client = socket.remoteAddress ?? "";
    this.members.set(key, { socket, share: "unknown", client });
    socket.once("close", () => {
      if (this.members.get(key)?.socket === socket) this.members.delete(key);
    });
    this.move(key, this.isLocal(socket.remoteAddress) ? "local" : "unknown", client);
  }

  /** Call with every request of a client that has identified itself. */
  identified(socket: Socket, { id, role, isLocal }: Caller): void {
    const share = isLocal ? "local" : role;
    const key = keyOf(socket);
    const member = this.members.get(key);
    if (member === undefined || (member.share === share && member.client === id)) return;
    this.move(key, share, id);
  }

  /** Moves a connection to a client's share, and closes one if that share is now too large. */
  private move(key: string, share: Share, client: string): void {
    const moved = this.members.get(key);
    if (moved === undefined) return;
    Object.assign(moved, { share, client });
    // To the end: it must not be the one that is closed.
    this.members.delete(key);
    this.members.set(key, moved);
    const { each, all } = LIMITS[share];
    const members = [...this.members.values()].filter((member) => member.share === share);
    const own = members.filter((member) => member.client === client);
    if (own.length > each) this.close(own[0]);
    else if (members.length > all) this.close(oldestOfLargest(members));
  }

  private close({ socket }: Member): void {
    this.members.delete(keyOf(socket));
    socket.destroy();
  }
}

function oldestOfLargest(members: readonly Member[]): Member {
  const counts = new Map<string, number>();
  for (const { client } of members) counts.set(client, (counts.get(client) ?? 0) + 1);
  const most = Math.max(...counts.values());
  return members.find(({ client }) => counts.get(client) === most) ?? members[0];
}

const keyOf = ({ remoteAddress, remotePort }: Socket): string => `${remoteAddress ?? ""} ${remotePort ?? ""}`;
