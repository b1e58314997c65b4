/** Finds and opens a plotter, real or virtual, and lets its driver identify it. */
import { PlotwrightError, type Clock, type Transport } from "../../src/index.js";
import {
  scaledClock,
  type Driver,
  type Machine,
  type MachineEvents,
  type UsbId,
  type VirtualMachine,
} from "../../src/internal.js";

interface PlotterConnectOptions {
  readonly driver: Driver;
  /** USB ids that only this driver's boards use. */
  readonly usbIds: readonly UsbId[];
  /** "auto": the first board on USB with one of `usbIds`, else the virtual one. "virtual", or a serial port's path. */
  readonly device: string;
  readonly devices: Devices;
  /** Ports that "auto" skips. */
  readonly isTaken?: ((path: string) => boolean) | undefined;
  /** "auto" with no board on USB: true for the virtual one, false to reject with `no-board`. */
  readonly virtualIfNone: boolean;
  readonly clock: Clock;
  /** How many times faster than real time the machine runs. Always 1 for a real one. */
  readonly speed: number;
  /** The built-in virtual machine, created when needed; the same one after a lost connection. */
  readonly virtualMachine: () => VirtualMachine;
  readonly events: MachineEvents;
}

export interface ConnectedMachine {
  readonly machine: Machine;
  readonly kind: "virtual" | "serial";
  /** Serial path; null for the built-in virtual machine. */
  readonly device: string | null;
  /** Of the board's USB device; null if it has none. */
  readonly serialNumber: string | null;
}

/**
 * Rejects with `no-board`, `not-allowed`, `busy`, `board-timeout` or `disconnected`, and a message for the
 * user.
 */
export async function connect(options: PlotterConnectOptions): Promise<ConnectedMachine> {
  const path = options.device === "auto" ? await firstBoard(options) : options.device;
  if (path === null && !options.virtualIfNone) throw notFound(options);
  if (path === null || path === "virtual") {
    const machine = await identified(options.virtualMachine().transport(), options);
    return { machine, kind: "virtual", device: null, serialNumber: null };
  }
  const transport = await options.devices.open(path);
  const machine = await identified(transport, options).catch((error: unknown) => {
    throw atDevice(error, path);
  });
  return { machine, kind: "serial", device: path, serialNumber: await serialNumberAt(path, options) };
}

/** A port can be used without it, so errors are ignored. */
async function serialNumberAt(
  path: string,
  { usbIds, devices }: PlotterConnectOptions,
): Promise<string | null> {
  const boards = await devices.find(usbIds).catch(() => []);
  return boards.find((board) => board.path === path)?.serialNumber ?? null;
}

async function firstBoard({
  usbIds,
  devices,
  isTaken = () => false,
}: PlotterConnectOptions): Promise<string | null> {
  const boards = await devices.find(usbIds);
  return boards.find(({ path }) => !isTaken(path))?.path ?? null;
}

function identified(transport: Transport, options: PlotterConnectOptions): Promise<Machine> {
  const { driver, clock, speed, events } = options;
  return driver.identify(transport, { clock, machineClock: scaledClock(clock, speed), speed, events });
}

/** Adds the device to the message of an error. */
function atDevice(error: unknown, device: string): unknown {
  if (!(error instanceof PlotwrightError)) return error;
  return new PlotwrightError(error.code, `${device}: ${error.message}`, { cause: error });
}

const notFound = ({ usbIds }: PlotterConnectOptions): PlotwrightError =>
  new PlotwrightError(
    "no-board",
    usbIds.length === 0
      ? "This machine's controller can't be detected automatically: choose its port: on the page in Sharing, Plotters."
      : "The plotter is no longer plugged in: check its USB cable and its power.",
  );

export const connectFailed = (cause: unknown): PlotwrightError =>
  new PlotwrightError("internal", "Connecting to the board failed because of an internal error.", { cause });

/** A board on a serial port of this computer. */
export interface FoundBoard {
  /** The name by which `open` opens it; on the server the path to pass to `--device`. */
  readonly path: string;
  /** Manufacturer, to show to users. */
  readonly description: string;
  readonly serialNumber: string | null;
}

/** The serial ports of this computer. The server opens them with serialport, the page with Web Serial. */
export interface Devices {
  /** All boards on USB with these ids, sorted by path. */
  find(ids: readonly UsbId[]): Promise<readonly FoundBoard[]>;
  /** Opens and locks a port. Rejects with `no-board`, `not-allowed` or `busy`. */
  open(path: string): Promise<Transport>;
}
