/** Ends the lock of a Grbl, unless its door or its emergency stop keeps it locked. */
import type { PlotwrightError } from "../../../errors.js";
import { doorOpen, isDoorRefusal, isLocked, staysLocked, UNLOCK } from "../protocol.js";
import type { GrblSession } from "./session.js";

/** Returns why it is still locked; null: it is not. */
export async function unlock(session: GrblSession): Promise<PlotwrightError | null> {
  const refused = await session.sendSurely(UNLOCK).then(
    () => null,
    (error: PlotwrightError) => error,
  );
  if (session.failure) throw session.failure;
  if (!isLocked((await session.status()).state)) return null;
  return refused === null || isDoorRefusal(session.lastRefusal) ? doorOpen() : staysLocked(refused);
}
