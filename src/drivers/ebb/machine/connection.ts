/** A board that has been identified, and its features. */
import { PlotwrightError } from "../../../errors.js";
import { firmwareFeatures, type FirmwareFeatures } from "../protocol/firmware.js";
import { BoardSession } from "../stream/session.js";
import type { ConnectOptions } from "../../driver.js";
import type { Clock, Transport } from "../../transport.js";

export interface Connection {
  readonly session: BoardSession;
  readonly features: FirmwareFeatures;
  /** The board's own name (ST); null if it has none. */
  readonly boardName: string | null;
  /** Counts board seconds. */
  readonly boardClock: Clock;
  /** Board seconds per second of this computer. */
  readonly speed: number;
  /** The same for timeouts on both board and computer: the slower of the two counts. */
  readonly waitSpeed: number;
}

/** Rejects with `board-timeout` or `disconnected`, after closing the connection. */
export async function connectBoard(
  transport: Transport,
  { clock, machineClock, speed, events }: ConnectOptions,
): Promise<Connection> {
  // A fast virtual board does not make connection or computer faster, so timeouts are measured on the slower clock.
  const session = new BoardSession(transport, { clock: speed < 1 ? machineClock : clock });
  try {
    const identity = await session.identify();
    const features = firmwareFeatures(identity.firmware);
    // An earlier program may have switched off the OK. Very old firmware does not know the command.
    if (!features.hasFutureSyntax) await session.send("CU,1,1").catch(ignoreRefusal);
    const boardName = features.hasGeneralQuery ? (await session.query("QT")).trim() || null : null;
    session.onFault((error) => events.lost(error));
    return { session, features, boardName, boardClock: machineClock, speed, waitSpeed: Math.max(1, speed) };
  } catch (error) {
    await session.close();
    throw error;
  }
}

/** See `Driver.ask`. */
export async function askBoard(transport: Transport, clock: Clock): Promise<string | null> {
  const session = new BoardSession(transport, { clock });
  try {
    return `EiBotBoard ${(await session.identify()).firmware}`;
  } catch {
    return null;
  } finally {
    await session.close();
  }
}

function ignoreRefusal(error: unknown): void {
  if (!(error instanceof PlotwrightError && error.code === "board-error")) throw error;
}
