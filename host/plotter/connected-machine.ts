/** Finds and opens a plotter, real or virtual, and lets its driver identify it. */
import { PlotwrightError, type Clock, type Transport } from "../../src/index.js";
import {
  allDrivers,
  scaledClock,
  usbIdsOf,
  type ControllerDescription,
  type Driver,
  type Machine,
  type MachineEvents,
  type UsbId,
  type VirtualMachine,
} from "../../src/internal.js";
import { askPort } from "./ask-ports.js";
import type { Devices, FoundBoard } from "./devices.js";
import { boardOf, OtherBoardError, type OtherBoards } from "./other-board.js";

interface PlotterConnectOptions {
  readonly driver: Driver;
  readonly controller: Pick<ControllerDescription, "usbIds" | "candidateIds">;
  /**
   * "auto": the first board on USB that is certainly one of the controller's, else the first candidate that answers, else the
   * virtual one. "virtual", or a serial port's path.
   */
  readonly device: string;
  readonly devices: Devices;
  /** Ports that "auto" skips. */
  readonly isTaken?: ((path: string) => boolean) | undefined;
  /** "auto" with no board of the controller: names one of another. Default: it does not look for any. */
  readonly otherBoards?: OtherBoards | undefined;
  /** "auto" with no board on USB: true for the virtual one, false to reject with `no-board`. */
  readonly virtualIfNone: boolean;
  /** A board has been connected before: the virtual one is never used in its place. */
  readonly hadBoard: boolean;
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
  const other = path === null ? await options.otherBoards?.first(usbIdsOf(options.controller)) : null;
  if (other) throw new OtherBoardError(other);
  if (path === null && (options.hadBoard || !options.virtualIfNone)) throw notFound(options);
  if (path === null || path === "virtual") {
    const machine = await identified(options.virtualMachine().transport(), options);
    return { machine, kind: "virtual", device: null, serialNumber: null };
  }
  const transport = await options.devices.open(path);
  const machine = await identified(transport, options).catch(async (error: unknown) => {
    throw atDevice((await otherController(error, path, options)) ?? error, path);
  });
  return { machine, kind: "serial", device: path, serialNumber: await serialNumberAt(path, options) };
}

/** The error if a board of another controller is at a port that has never had one of this controller; null: none is. */
async function otherController(
  error: unknown,
  path: string,
  options: PlotterConnectOptions,
): Promise<OtherBoardError | null> {
  const isNotIdentified =
    error instanceof PlotwrightError && (error.code === "no-board" || error.code === "board-timeout");
  if (!isNotIdentified || options.hadBoard) return null;
  const others = (await allDrivers()).filter(({ driver }) => driver !== options.driver);
  const board = boardOf(await askPort(path, others, options));
  return board && new OtherBoardError(board, { cause: error });
}

/** A port can be used without it, so errors are ignored. */
async function serialNumberAt(
  path: string,
  { controller, devices }: PlotterConnectOptions,
): Promise<string | null> {
  const boards = await devices.find(usbIdsOf(controller)).catch(() => []);
  return boards.find((board) => board.path === path)?.serialNumber ?? null;
}

async function firstBoard(options: PlotterConnectOptions): Promise<string | null> {
  const { controller, devices, isTaken = () => false } = options;
  const free = async (ids: readonly UsbId[]): Promise<readonly FoundBoard[]> =>
    ids.length === 0 ? [] : (await devices.find(ids)).filter(({ path }) => !isTaken(path));
  const [certain] = await free(controller.usbIds);
  if (certain) return certain.path;
  const candidates = await free(controller.candidateIds);
  if (candidates.length === 0) return null;
  const own = (await allDrivers()).filter(({ driver }) => driver === options.driver);
  for (const { path } of candidates) {
    const { answer } = await askPort(path, own, options);
    if (answer !== null) return path;
  }
  return null;
}

function identified(transport: Transport, options: PlotterConnectOptions): Promise<Machine> {
  const { driver, clock, speed, events } = options;
  return driver.identify(transport, { clock, machineClock: scaledClock(clock, speed), speed, events });
}

/** Adds the device to the message of an error. */
function atDevice(error: unknown, device: string): unknown {
  if (!(error instanceof PlotwrightError)) return error;
  if (error instanceof OtherBoardError)
    return new OtherBoardError(error.board, { cause: error.cause }, device);
  return new PlotwrightError(error.code, `${device}: ${error.message}`, { cause: error });
}

const notFound = ({ controller }: PlotterConnectOptions): PlotwrightError =>
  new PlotwrightError(
    "no-board",
    controller.candidateIds.length > 0
      ? "No plotter of this model answers on any USB port: check its cable and its power, and close other programs that use it."
      : "The plotter is no longer plugged in: check its USB cable and its power.",
  );

export const connectFailed = (cause: unknown): PlotwrightError =>
  new PlotwrightError("internal", "Connecting to the board failed because of an internal error.", { cause });
