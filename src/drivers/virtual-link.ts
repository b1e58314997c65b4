/**
 * The host's end of an in-process connection to a virtual board, including the operating system's buffer.
 */
import { PlotwrightError } from "../errors.js";
import type { Transport } from "./transport.js";

interface LinkTarget {
  readonly accepting: () => boolean;
  readonly nowTick: () => number;
  readonly take: (bytes: Uint8Array, arrivalTick: number) => void;
}

interface OutboxEntry {
  /** Those that the board has not taken yet. */
  bytes: Uint8Array;
  /** When the host wrote it. */
  readonly tick: number;
  readonly resolve: () => void;
  readonly reject: (error: Error) => void;
}

const PACKET_BYTES = 64;

export class VirtualLink implements Transport {
  private readonly outbox: OutboxEntry[] = [];
  private dataListener: ((bytes: Uint8Array) => void) | null = null;
  private closeListener: ((error?: Error) => void) | null = null;
  private closed = false;
  private isPumping = false;

  constructor(
    private readonly systemLimit: number,
    private readonly target: LinkTarget,
  ) {}

  write(bytes: Uint8Array): Promise<void> {
    if (this.closed) {
      return Promise.reject(
        new PlotwrightError("disconnected", "The connection to the virtual board is closed: open it again."),
      );
    }
    return new Promise((resolve, reject) => {
      this.outbox.push({ bytes: bytes.slice(), tick: this.target.nowTick(), resolve, reject });
      this.pump();
    });
  }

  onData(listener: (bytes: Uint8Array) => void): void {
    this.dataListener = listener;
  }

  onClose(listener: (error?: Error) => void): void {
    this.closeListener = listener;
  }

  close(): Promise<void> {
    this.drop();
    return Promise.resolve();
  }

  /** Closes the connection. `error` is the reason; undefined for a plain close. */
  drop(error?: Error): void {
    if (this.closed) return;
    this.closed = true;
    for (const entry of this.outbox.splice(0)) {
      entry.reject(
        error ?? new PlotwrightError("disconnected", "The connection was closed before this was sent."),
      );
    }
    this.closeListener?.(error);
  }

  deliver(bytes: Uint8Array): void {
    if (!this.closed) this.dataListener?.(bytes);
  }

  /** Delivers packets while the board reads. A write resolves when its remaining bytes fit into the system's buffer. */
  pump(): void {
    if (this.isPumping) return;
    this.isPumping = true;
    while (!this.closed && this.outbox.length > 0 && this.target.accepting()) {
      const entry = this.outbox[0];
      const packet = entry.bytes.subarray(0, PACKET_BYTES);
      entry.bytes = entry.bytes.subarray(packet.length);
      if (entry.bytes.length === 0) this.outbox.shift()!.resolve();
      this.target.take(packet, entry.tick);
    }
    this.isPumping = false;
    let waitingBytes = 0;
    for (const entry of this.outbox) {
      waitingBytes += entry.bytes.length;
      if (waitingBytes > this.systemLimit) break;
      entry.resolve();
    }
  }
}
