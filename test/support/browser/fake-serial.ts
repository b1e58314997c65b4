/** The test's end of fake-serial-script.ts: one virtual board on one port, by HTTP. */
import type { IncomingMessage, ServerResponse } from "node:http";
import { VirtualBoard, type Transport } from "../../../src/index.js";
import { nodeClock } from "../../../server/serial/node-clock.js";

export class FakeSerial {
  readonly board: VirtualBoard;
  private isPermitted = false;
  private transport: Transport | null = null;
  private reader: ServerResponse | null = null;

  /** `speed`: board seconds per second. */
  constructor(speed = 1) {
    this.board = new VirtualBoard({ clock: nodeClock, speed, servo: {} });
  }

  /** Whether a page has the port open. */
  get isOpen(): boolean {
    return this.reader !== null;
  }

  async handle(name: string, request: IncomingMessage, response: ServerResponse): Promise<void> {
    switch (name) {
      case "permit":
        this.isPermitted = true;
        return answer(response, 200);
      case "permitted":
        return answer(response, 200, JSON.stringify(this.isPermitted));
      case "open":
        return answer(response, this.open() ? 200 : 409);
      case "read":
        return this.read(response);
      case "write":
        return this.write(request, response);
      case "close":
        await this.transport?.close();
        this.transport = null;
        return answer(response, 200);
      default:
        answer(response, 404);
    }
  }

  close(): void {
    this.reader?.end();
    this.board.close();
  }

  private open(): boolean {
    if (this.reader !== null) return false;
    this.transport = this.board.transport();
    return true;
  }

  /** Frees the port after the tab has died. The board keeps its commands, because nothing has closed the link. */
  private read(response: ServerResponse): void {
    response.writeHead(200, { "content-type": "application/octet-stream", "cache-control": "no-store" });
    response.flushHeaders();
    this.reader = response;
    this.transport?.onData((bytes) => response.write(bytes));
    response.on("close", () => {
      if (this.reader === response) this.reader = null;
    });
  }

  private async write(request: IncomingMessage, response: ServerResponse): Promise<void> {
    const chunks: Buffer[] = [];
    for await (const chunk of request) chunks.push(chunk as Buffer);
    try {
      await this.transport?.write(new Uint8Array(Buffer.concat(chunks)));
      answer(response, this.transport === null ? 410 : 200);
    } catch {
      answer(response, 410);
    }
  }
}

function answer(response: ServerResponse, status: number, text = ""): void {
  response.writeHead(status, { "content-type": "application/json", "cache-control": "no-store" }).end(text);
}
