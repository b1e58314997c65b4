/** A serial port as a `Transport`. Its errors say what to do. */
import { setTimeout } from "node:timers/promises";
import type { SerialPort } from "serialport";
import { PlotwrightError, type Transport } from "../../src/index.js";

/** A Grbl needs this rate; an EiBotBoard is a USB device and ignores it. */
const BAUD_RATE = 115_200;

/** On a busy computer a port stays locked for a moment after it was closed. */
const LOCKED_TRIES = 10;
const LOCKED_MS = 100;

/** Opens and locks a port. Rejects with `no-board`, `not-allowed` or `busy`, the latter only if it stays locked. */
export async function openSerial(path: string): Promise<Transport> {
  for (let tries = 1; ; tries++) {
    try {
      return await openOnce(path);
    } catch (error) {
      const isLocked = error instanceof PlotwrightError && error.code === "busy";
      if (!isLocked || tries === LOCKED_TRIES) throw error;
    }
    await setTimeout(LOCKED_MS);
  }
}

async function openOnce(path: string): Promise<Transport> {
  // Loaded here, because a server with a virtual board never needs it.
  const { SerialPort } = await import("serialport");
  // An Arduino restarts at each change of the line DTR, and a Grbl then forgets its place. Without hupcl the line stays as it
  // is when the port is closed, also if this process is killed, so that the next one finds the Grbl running. Not on Windows.
  const port = new SerialPort({ path, baudRate: BAUD_RATE, autoOpen: false, lock: true, hupcl: false });
  await new Promise<void>((resolve, reject) => {
    port.open((error) => (error ? reject(openError(path, error)) : resolve()));
  });
  return new SerialTransport(port);
}

class SerialTransport implements Transport {
  private closing: Promise<void> | null = null;

  constructor(private readonly port: SerialPort) {
    // An "error" event without a listener would end the process; a lost connection is reported by "close".
    port.on("error", () => undefined);
  }

  write(bytes: Uint8Array): Promise<void> {
    return new Promise((resolve, reject) => {
      if (!this.port.isOpen) {
        reject(lostError(this.port.path));
        return;
      }
      this.port.write(Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength), (error) => {
        if (error) reject(lostError(this.port.path, error));
        else resolve();
      });
    });
  }

  onData(listener: (bytes: Uint8Array) => void): void {
    this.port.removeAllListeners("data");
    this.port.on("data", listener);
  }

  onClose(listener: (error?: Error) => void): void {
    this.port.once("close", (error: Error | null | undefined) => {
      if (this.closing) listener();
      else listener(lostError(this.port.path, error ?? undefined));
    });
  }

  close(): Promise<void> {
    this.closing ??= new Promise((resolve) => {
      if (!this.port.isOpen) {
        resolve();
        return;
      }
      // Discard unsent output: otherwise closing would wait for a board that may no longer read it.
      this.port.flush(() => this.port.close(() => resolve()));
    });
    return this.closing;
  }
}

function lostError(path: string, cause?: Error): PlotwrightError {
  return new PlotwrightError(
    "disconnected",
    `The connection to the board at ${path} was lost: check its USB cable and power, then connect again.`,
    { cause },
  );
}

/** Translates the system's error messages, which differ by platform. */
export function openError(path: string, error: Error): PlotwrightError {
  const words = error.message;
  if (/permission denied|EACCES/i.test(words)) {
    return new PlotwrightError("not-allowed", permissionMessage(path), { cause: error });
  }
  if (/cannot lock|temporarily unavailable|resource busy|EBUSY|EAGAIN|access denied/i.test(words)) {
    return new PlotwrightError(
      "busy",
      `Another program is using ${path}: close it (other plotter software, a serial monitor, a second plotwright), then connect again.`,
      { cause: error },
    );
  }
  if (/no such file|file not found|ENOENT|ENXIO|ENODEV|cannot find/i.test(words)) {
    return new PlotwrightError(
      "no-board",
      `There is no device at ${path}: plug the plotter in, or choose another with --device. On the command line, "plotwright devices" lists them.`,
      { cause: error },
    );
  }
  if (/inappropriate ioctl|ENOTTY|is a directory|EISDIR|invalid argument|EINVAL/i.test(words)) {
    return new PlotwrightError(
      "no-board",
      `${path} is not a serial port: choose the plotter's with --device. On the command line, "plotwright devices" lists them.`,
      { cause: error },
    );
  }
  return new PlotwrightError("no-board", `${path} cannot be opened as a serial port (${words}).`, {
    cause: error,
  });
}

function permissionMessage(path: string): string {
  return (
    `This account may not open ${path}. On Linux add it to the port's group (sudo usermod -aG dialout $USER, ` +
    `on Arch: uucp) and log in again, or add the udev rule ` +
    `SUBSYSTEM=="tty", ATTRS{idVendor}=="04d8", ATTRS{idProduct}=="fd92", TAG+="uaccess" ` +
    `in /etc/udev/rules.d/60-eibotboard.rules and plug the board in again.`
  );
}
