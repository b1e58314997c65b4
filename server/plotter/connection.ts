/** Finds and opens a board, real or virtual, and learns what it can do. */
import {
  BoardSession,
  firmwareFeatures,
  PlotwrightError,
  type Clock,
  type FirmwareFeatures,
  type Transport,
  type VirtualBoard,
} from "../../src/index.js";
import { findBoards } from "../serial/find-boards.js";
import { scaledClock } from "../serial/node-clock.js";
import { openSerial } from "../serial/serial-transport.js";

export interface ConnectOptions {
  /** "auto": the first EiBotBoard on USB, else the virtual board. "virtual", or a serial port's path. */
  readonly device: string;
  /** Ports that "auto" skips. */
  readonly isTaken?: ((path: string) => boolean) | undefined;
  /** "auto" with no board on USB: true for the virtual board, false to reject with `no-board`. */
  readonly virtualIfNone: boolean;
  readonly clock: Clock;
  /** How many times faster than real time the board runs; only a virtual board is ever not 1. */
  readonly speed: number;
  /** The built-in virtual board, made when it is needed; the same one after a lost connection. */
  readonly virtualBoard: () => VirtualBoard;
}

export interface Connection {
  readonly session: BoardSession;
  readonly kind: "virtual" | "serial";
  /** Serial path; null for the built-in virtual board. */
  readonly device: string | null;
  readonly features: FirmwareFeatures;
  /** The board's own name (ST); null where it has none. */
  readonly boardName: string | null;
  /** Counts board seconds. */
  readonly boardClock: Clock;
  /** Board seconds in one of ours. */
  readonly speed: number;
  /** The same for how long something may take: as long as the slower of the two, board or computer, would need. */
  readonly waitSpeed: number;
  /** Present for the built-in virtual board. */
  readonly virtualBoard: VirtualBoard | null;
}

/**
 * Rejects with `no-board`, `not-allowed`, `busy`, `board-timeout` or `disconnected`, and a message for the
 * user.
 */
export async function connect(options: ConnectOptions): Promise<Connection> {
  const path = options.device === "auto" ? await firstBoard(options) : options.device;
  if (path === null && !options.virtualIfNone) throw unplugged();
  if (path === null || path === "virtual") return connectVirtual(options);
  return identified(await openSerial(path), "serial", path, options, null);
}

async function firstBoard({ isTaken = () => false }: ConnectOptions): Promise<string | null> {
  const boards = await findBoards();
  return boards.find(({ path }) => !isTaken(path))?.path ?? null;
}

function connectVirtual(options: ConnectOptions): Promise<Connection> {
  const board = options.virtualBoard();
  return identified(board.transport(), "virtual", null, options, board);
}

async function identified(
  transport: Transport,
  kind: Connection["kind"],
  device: string | null,
  options: ConnectOptions,
  virtualBoard: VirtualBoard | null,
): Promise<Connection> {
  const { clock, speed } = options;
  const boardClock = scaledClock(clock, speed);
  // A fast board's line and computer are no faster than others: silence is measured on the slower clock.
  const session = new BoardSession(transport, { clock: speed < 1 ? boardClock : clock });
  try {
    const identity = await session.identify();
    const features = firmwareFeatures(identity.firmware);
    return {
      session,
      kind,
      device,
      features,
      boardName: features.hasGeneralQuery ? await nameOf(session) : null,
      boardClock,
      speed,
      waitSpeed: Math.max(1, speed),
      virtualBoard,
    };
  } catch (error) {
    await session.close();
    throw device === null ? error : atDevice(error, device);
  }
}

async function nameOf(session: BoardSession): Promise<string | null> {
  const name = (await session.query("QT")).trim();
  return name === "" ? null : name;
}

/** Adds the device to the message of an error. */
function atDevice(error: unknown, device: string): unknown {
  if (!(error instanceof PlotwrightError)) return error;
  return new PlotwrightError(error.code, `${device}: ${error.message}`, { cause: error });
}

const unplugged = (): PlotwrightError =>
  new PlotwrightError("no-board", "The plotter is no longer plugged in: check its USB cable and its power.");
