/** Brings a Grbl to rest along its path, so that its position stays known. */
import { delay, type Clock } from "../../transport.js";
import { doorOpen, isAtDoor, isLocked, isMoving, isRunning, NOW, type Status } from "../protocol.js";

const TRIES = 200;
const POLL_S = 0.05;

interface BrakingSession {
  readonly clock: Clock;
  readonly resetCount: number;
  now(byte: string): void;
  status(): Promise<Status>;
  reset(): Promise<Status>;
}

/** Resolves at rest, after a reset, or when it has waited long enough. */
export async function brake(session: BrakingSession): Promise<void> {
  const { resetCount } = session;
  session.now(NOW.hold);
  let before: Status | null = null;
  for (let i = 0; i < TRIES; i++) {
    const status = await session.status();
    // What moves now is not what was to be stopped.
    if (session.resetCount > resetCount) return;
    // Version 0.9 does not say whether it still brakes.
    const stands = status.state !== "Hold" || (before !== null && isSamePlace(before, status));
    if (stands && !isMoving(status.state)) return;
    // While it resumes after its door was open, it takes no hold.
    if (i > 0 && isRunning(status.state)) session.now(NOW.hold);
    before = status;
    await delay(session.clock, POLL_S);
  }
}

/**
 * Ends what an earlier connection has left: motion, a hold … Returns whether there was anything. Throws if its door keeps it
 * from moving.
 */
export async function endLeft(session: BrakingSession): Promise<boolean> {
  const { state } = await session.status();
  if (state === "Idle" || isLocked(state)) return false;
  await brake(session);
  if (isAtDoor((await session.reset()).state)) throw doorOpen();
  return true;
}

export const isSamePlace = (a: Status, b: Status): boolean => a.at.every((mm, axis) => mm === b.at[axis]);
