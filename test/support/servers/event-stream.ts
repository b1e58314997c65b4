/** Reads a server's event stream as a browser does. */
import { serverEventSchema, type ServerEvent } from "../../../src/schema/index.js";

export class EventStream {
  readonly seen: ServerEvent[] = [];
  private readonly abort = new AbortController();
  private wake: (() => void)[] = [];
  /** Resolves when the server has ended the stream. */
  ended: Promise<void> = Promise.resolve();

  static async open(url: string, headers: Record<string, string> = {}): Promise<EventStream> {
    const stream = new EventStream();
    const response = await fetch(`${url}/api/v1/events`, { headers, signal: stream.abort.signal });
    if (response.status !== 200 || response.body === null) throw new Error(`status ${response.status}`);
    stream.ended = stream.read(response.body).catch(() => undefined);
    return stream;
  }

  /** The first matching event, of those received or still to come. */
  async find<T extends ServerEvent["type"]>(
    type: T,
    fits: (event: Extract<ServerEvent, { type: T }>) => boolean = () => true,
  ): Promise<Extract<ServerEvent, { type: T }>> {
    for (;;) {
      const found = this.seen.find(
        (event): event is Extract<ServerEvent, { type: T }> =>
          event.type === type && fits(event as Extract<ServerEvent, { type: T }>),
      );
      if (found !== undefined) return found;
      await new Promise<void>((resolve) => this.wake.push(resolve));
    }
  }

  close(): void {
    this.abort.abort();
  }

  private async read(body: ReadableStream<Uint8Array>): Promise<void> {
    const decoder = new TextDecoder();
    let text = "";
    for await (const chunk of body) {
      text += decoder.decode(chunk, { stream: true });
      const blocks = text.split("\n\n");
      text = blocks.pop() ?? "";
      for (const block of blocks) {
        if (block.startsWith("data: ")) this.seen.push(serverEventSchema.parse(JSON.parse(block.slice(6))));
      }
      this.wake.splice(0).forEach((wake) => wake());
    }
  }
}
