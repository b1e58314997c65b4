/**
 * Entry "plotwright/web-serial": drives a board directly from a page by Web Serial (Chromium browsers, in a secure
 * context, which includes http://localhost).
 */
import { PlotwrightError, type Clock, type Transport } from "../../src/index.js";
import { portFilters } from "./port-filters.js";

/** The used part of the browser's `SerialPort`. */
export interface WebSerialPort {
  readonly readable: ReadableStream<Uint8Array> | null;
  readonly writable: WritableStream<Uint8Array> | null;
  open(options: { baudRate: number }): Promise<void>;
  close(): Promise<void>;
}

/** The used part of `navigator.serial`. */
export interface WebSerial {
  requestPort(options: { filters: { usbVendorId: number; usbProductId?: number }[] }): Promise<WebSerialPort>;
}

/** A Grbl needs this rate; an EiBotBoard is a USB device and ignores it. */
const BAUD_RATE = 115_200;

/**
 * Lets the user choose a board in the browser's own dialog, and opens it. Browsers allow this only in a click handler.
 * Rejects with `no-board` (nothing chosen), `not-allowed` (no Web Serial here), `busy`.
 */
export async function requestBoard(serial: WebSerial | undefined = browserSerial()): Promise<Transport> {
  if (serial === undefined) {
    throw new PlotwrightError(
      "not-allowed",
      "This browser can’t open USB boards from a page: use Chrome or Edge, at https or on localhost.",
    );
  }
  let port: WebSerialPort;
  try {
    port = await serial.requestPort({ filters: portFilters() });
  } catch (cause) {
    throw new PlotwrightError("no-board", "No board was chosen. Plug it in, and choose it in the list.", {
      cause,
    });
  }
  return openWebSerial(port);
}

/** Opens a port that the page already has, for example from `navigator.serial.getPorts()`. Rejects with `busy`. */
export async function openWebSerial(port: WebSerialPort): Promise<Transport> {
  try {
    await port.open({ baudRate: BAUD_RATE });
  } catch (cause) {
    throw new PlotwrightError(
      "busy",
      "The board can’t be opened: close other programs and pages that use it, then connect again.",
      { cause },
    );
  }
  if (port.readable === null || port.writable === null) throw lost();
  return new WebSerialTransport(port, port.readable.getReader(), port.writable.getWriter());
}

/** The page's clock, for `BoardSession` and `Streamer`. */
export function browserClock(): Clock {
  return {
    nowS: () => performance.now() / 1_000,
    after(delayS, callback) {
      const timer = setTimeout(callback, delayS * 1_000);
      return () => clearTimeout(timer);
    },
  };
}

class WebSerialTransport implements Transport {
  private readonly ended: Promise<void>;
  private dataListener: (bytes: Uint8Array) => void = () => undefined;
  private closeListener: ((error?: Error) => void) | null = null;
  private end: { readonly error: Error | undefined } | null = null;
  private isClosing = false;

  constructor(
    private readonly port: WebSerialPort,
    private readonly reader: ReadableStreamDefaultReader<Uint8Array>,
    private readonly writer: WritableStreamDefaultWriter<Uint8Array>,
  ) {
    // `write` reports a failure itself. Without this the loss would also be an unhandled rejection.
    writer.closed.catch(() => undefined);
    this.ended = this.read();
  }

  async write(bytes: Uint8Array): Promise<void> {
    if (this.end !== null || this.isClosing) throw lost();
    try {
      await this.writer.write(bytes);
    } catch (cause) {
      throw lost(cause);
    }
  }

  onData(listener: (bytes: Uint8Array) => void): void {
    this.dataListener = listener;
  }

  onClose(listener: (error?: Error) => void): void {
    this.closeListener = listener;
    if (this.end !== null) this.reportEnd();
  }

  async close(): Promise<void> {
    if (!this.isClosing) {
      this.isClosing = true;
      await this.reader.cancel().catch(() => undefined);
    }
    await this.ended;
  }

  /** Reads until the port is closed or lost, then releases the streams and the port. */
  private async read(): Promise<void> {
    let failure: unknown;
    try {
      for (;;) {
        const { value, done } = await this.reader.read();
        if (done) break;
        this.dataListener(value);
      }
    } catch (error) {
      failure = error;
    }
    this.reader.releaseLock();
    await this.writer.abort().catch(() => undefined);
    this.writer.releaseLock();
    await this.port.close().catch(() => undefined);
    this.end = { error: this.isClosing ? undefined : lost(failure) };
    this.reportEnd();
  }

  private reportEnd(): void {
    const listener = this.closeListener;
    if (listener === null || this.end === null) return;
    this.closeListener = null;
    listener(this.end.error);
  }
}

function browserSerial(): WebSerial | undefined {
  return (globalThis as { navigator?: { serial?: WebSerial } }).navigator?.serial;
}

const lost = (cause?: unknown): PlotwrightError =>
  new PlotwrightError(
    "disconnected",
    "The connection to the board is lost: check its USB cable and power, then connect again.",
    { cause },
  );
