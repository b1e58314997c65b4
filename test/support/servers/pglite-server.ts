/**
 * PGlite behind a port, for several clients, though it has one session for all. A client has it to itself
 * from the first message of a query to the last, and from BEGIN to the end of the transaction; others wait
 * for their turn. (The package's own server takes turns message by message, so that queries of two clients
 * mix, and stops for good after one error: electric-sql/pglite#1046.)
 *
 *   client  ──Parse Bind Execute Sync──>  one turn  ──…ReadyForQuery "I"──>  the next client's turn
 *           ──BEGIN──>                    one turn  ──…ReadyForQuery "T"──>  still its turn
 */
import { once } from "node:events";
import { createServer, type AddressInfo, type Socket } from "node:net";
import type { PGlite } from "@electric-sql/pglite";

/** Types of messages after which the client waits for an answer: Query, Sync, and a password. */
const ENDS_BATCH = new Set(["Q", "S", "p"].map((type) => type.charCodeAt(0)));
const TERMINATE = "X".charCodeAt(0);
const READY = "Z".charCodeAt(0);
const IDLE = "I".charCodeAt(0);
/** ReadyForQuery: its type, its length, and whether there is a transaction. */
const READY_BYTES = 6;

export class PgliteServer {
  private readonly server = createServer((socket) => void this.serve(socket));
  private readonly sockets = new Set<Socket>();
  private turn: Promise<void> = Promise.resolve();

  private constructor(private readonly database: PGlite) {}

  /** On 127.0.0.1; `port` 0: a free one, see `server.port`. */
  static async listen(database: PGlite, port: number): Promise<PgliteServer> {
    const server = new PgliteServer(database);
    server.server.listen(port, "127.0.0.1");
    await once(server.server, "listening");
    return server;
  }

  get port(): number {
    return (this.server.address() as AddressInfo).port;
  }

  /** Cuts all connections. */
  async stop(): Promise<void> {
    const closed = once(this.server, "close");
    this.server.close();
    for (const socket of this.sockets) socket.destroy();
    await closed;
    await this.turn;
  }

  private async serve(socket: Socket): Promise<void> {
    this.sockets.add(socket.setNoDelay(true));
    let end: (() => void) | null = null;
    try {
      for await (const batch of batchesOf(socket)) {
        end ??= await this.begin();
        let answer: Uint8Array = new Uint8Array();
        for (const message of batch) {
          answer = await this.database.execProtocolRaw(message);
          // A copy: PGlite may use its memory again.
          socket.write(Buffer.from(answer));
        }
        if (isInTransaction(answer)) continue;
        end();
        end = null;
      }
    } catch (error) {
      // A client that disconnects in mid-query is expected; an error of PGlite itself is thrown.
      if (!socket.destroyed) throw error;
    } finally {
      if (end !== null) {
        await this.database.exec("ROLLBACK");
        end();
      }
      this.sockets.delete(socket);
      socket.destroy();
    }
  }

  /** Waits for earlier turns; returns the function that ends its own turn. */
  private async begin(): Promise<() => void> {
    const before = this.turn;
    let end!: () => void;
    this.turn = new Promise((resolve) => (end = resolve));
    await before;
    return end;
  }
}

/** Handles groups of messages, each up to one that is answered, until the client leaves. */
async function* batchesOf(socket: Socket): AsyncIterable<Uint8Array[]> {
  let bytes = Buffer.alloc(0);
  let batch: Uint8Array[] = [];
  // Only the first message has no type.
  let typeBytes = 0;
  for await (const chunk of socket) {
    bytes = Buffer.concat([bytes, chunk as Buffer]);
    while (bytes.length >= typeBytes + 4) {
      const length = typeBytes + bytes.readInt32BE(typeBytes);
      if (bytes.length < length) break;
      const message = Uint8Array.from(bytes.subarray(0, length));
      bytes = bytes.subarray(length);
      if (typeBytes === 1 && message[0] === TERMINATE) return;
      batch.push(message);
      if (typeBytes === 0 || ENDS_BATCH.has(message[0])) {
        yield batch;
        batch = [];
      }
      typeBytes = 1;
    }
  }
}

function isInTransaction(answer: Uint8Array): boolean {
  return answer[answer.length - READY_BYTES] === READY && answer[answer.length - 1] !== IDLE;
}
