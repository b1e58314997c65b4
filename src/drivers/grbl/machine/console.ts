/** Sends one line that the user typed, and decides from it what is known afterwards. */
import { PlotwrightError } from "../../../errors.js";
import type { ConsoleAnswer } from "../../driver.js";
import { whyRefused } from "../console-lines.js";
import { SYNC } from "../grbl-job.js";
import type { GrblSession } from "./session.js";

/** Its answer has a note if the machine may have moved. */
export async function sendTyped(session: GrblSession, line: string): Promise<ConsoleAnswer> {
  const why = whyRefused(line);
  if (why) throw new PlotwrightError("bad-setting", `${JSON.stringify(line)} was not sent: ${why}.`);
  const { log } = session;
  const entryCount = log.count;
  let refused = false;
  await session.send(line).catch((error: unknown) => {
    // An error reply is among the received lines.
    if (!(error instanceof PlotwrightError && error.code === "board-error")) throw error;
    refused = true;
  });
  const replies = log.receivedSince(entryCount);
  if (/^\$(\d+=|RST)/i.test(line)) await session.readSettings();
  if (line.startsWith("$") && !/^\$J/i.test(line)) return { replies, refused, note: null };
  await session.send(SYNC).catch(() => undefined);
  return {
    replies,
    refused,
    note: "The machine may have moved, so its position is unknown. The next move starts from here as home.",
  };
}
