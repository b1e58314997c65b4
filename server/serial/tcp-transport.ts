/** A machine on the network as a `Transport`: a FluidNC, or a program that passes a serial port on, at tcp://HOST:PORT. */
import { connect, type Socket } from "node:net";
import { PlotwrightError, type Transport } from "../../src/index.js";

const CONNECT_MS = 5_000;
/** The port of a FluidNC's Telnet server. */
const TELNET_PORT = 23;

/** Host and port of a device's address; null if it is none on the network. Throws `bad-setting` for one without a host. */
export function tcpAddress(device: string): { readonly host: string; readonly port: number } | null {
  if (!/^tcp:/i.test(device)) return null;
  const url = URL.canParse(device) ? new URL(device) : null;
  if (!url?.hostname || url.pathname.length > 1 || url.search || url.hash || url.username) {
    throw new PlotwrightError(
      "bad-setting",
      `${device} is not the address of a machine on the network: write tcp://HOST:PORT, for example tcp://fluidnc.local:23.`,
    );
  }
  // An IPv6 address is in brackets.
  const host = url.hostname.replace(/^\[|\]$/g, "");
  return { host, port: url.port === "" ? TELNET_PORT : Number(url.port) };
}

/** Connects. Rejects with `no-board`. */
export function openTcp(
  device: string,
  address: NonNullable<ReturnType<typeof tcpAddress>>,
): Promise<Transport> {
  return new Promise((resolve, reject) => {
    const socket = connect({ ...address, timeout: CONNECT_MS });
    const failed = (why: string, cause?: Error): void => {
      socket.destroy();
      reject(
        new PlotwrightError(
          "no-board",
          `There is no connection to ${device} (${why}): check that the machine is switched on, that its address is right, and that it is in the same network.`,
          { cause },
        ),
      );
    };
    socket.once("timeout", () => failed("no answer"));
    socket.once("error", (error) => failed(error.message, error));
    socket.once("connect", () => {
      socket.removeAllListeners();
      socket.setTimeout(0);
      resolve(new TcpTransport(socket, device));
    });
  });
}

class TcpTransport implements Transport {
  private isClosing = false;
  private cause: Error | undefined = undefined;

  constructor(
    private readonly socket: Socket,
    private readonly device: string,
  ) {
    // Lines are short, and each must go at once.
    socket.setNoDelay(true);
    socket.setKeepAlive(true, 10_000);
    // An "error" event without a listener would end the process; "close" follows it.
    socket.on("error", (error) => (this.cause = error));
    // The machine has ended the connection.
    socket.on("end", () => socket.destroy());
  }

  write(bytes: Uint8Array): Promise<void> {
    return new Promise((resolve, reject) => {
      if (this.socket.destroyed) return reject(this.lost());
      this.socket.write(bytes, (error) => (error ? reject(this.lost()) : resolve()));
    });
  }

  onData(listener: (bytes: Uint8Array) => void): void {
    this.socket.removeAllListeners("data");
    this.socket.on("data", listener);
  }

  onClose(listener: (error?: Error) => void): void {
    this.socket.once("close", () => listener(this.isClosing ? undefined : this.lost()));
  }

  close(): Promise<void> {
    this.isClosing = true;
    return new Promise((resolve) => {
      if (this.socket.closed) return resolve();
      this.socket.once("close", () => resolve());
      this.socket.destroy();
    });
  }

  private lost(): PlotwrightError {
    return new PlotwrightError(
      "disconnected",
      `The connection to ${this.device} was lost: check that the machine is switched on and in the network, then connect again.`,
      { cause: this.cause },
    );
  }
}
