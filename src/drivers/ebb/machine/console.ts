/**
 * Sends one typed line to the board and collects its replies. Refuses lines that would break the communication
 * (console-lines.ts). After lines that move the motors or reset their counters, it reads the position back or forgets
 * it.
 */
import { PlotwrightError } from "../../../errors.js";
import type { ConsoleAnswer } from "../../driver.js";
import { commandName } from "../protocol/replies.js";
import { LONGEST_S, whyRefused } from "./console-lines.js";
import type { Carriage } from "./carriage.js";
import { hasSupplyFailed } from "./readings.js";

const MOVES = new Set(["SM", "XM", "LM", "LT", "L3", "T3", "TD", "TR", "HM", "ES"]);
const ZEROES = new Set(["EM", "CS"]);
const PEN = new Set(["SP", "TP", "S2", "SC", "SE"]);

/** Rejects with `bad-setting` if the line is refused, and with `board-timeout` if the board does not answer. */
export async function sendLine(carriage: Carriage, line: string): Promise<ConsoleAnswer> {
  const why = whyRefused(line);
  if (why !== null) throw new PlotwrightError("bad-setting", `${JSON.stringify(line)} was not sent: ${why}.`);
  const name = commandName(line);
  const answer = await answerTo(carriage, line);
  return { ...answer, note: await noteOn(carriage, name, answer.replies) };
}

/** Some commands answer with several lines. A query is sent after the line; all lines before its reply are returned. */
async function answerTo(carriage: Carriage, line: string): Promise<Omit<ConsoleAnswer, "note">> {
  const { session } = carriage.connection;
  session.log.add("note", `console: ${line}`);
  const entryCount = session.log.count;
  let refused = false;
  await session.query(line, LONGEST_S).catch((error: unknown) => {
    // An error reply is among the received lines.
    if (!(error instanceof PlotwrightError && error.code === "board-error")) throw error;
    refused = true;
  });
  await session.query("QM", LONGEST_S);
  // The last line is the answer to QM. After a reply of unknown form the session sends V to match replies to queries
  // again: drop that reply.
  const replies = session.log
    .receivedSince(entryCount)
    .slice(0, -1)
    .filter((text) => commandName(line) === "V" || !/^EBBv.* Version /i.test(text));
  return { replies, refused };
}

async function noteOn(carriage: Carriage, name: string, replies: readonly string[]): Promise<string | null> {
  const { features } = carriage.connection;
  // The board reports a failure only once: without this, the next move would not learn of it.
  if (name === "QG" && features.hasSupplyLatch && replies.some(hasSupplyFailed)) {
    await carriage.position.forget();
    return "The motors' supply has failed for a moment, so the position is unknown. The next move starts from here as home, or finds home first if the machine can.";
  }
  if (PEN.has(name)) {
    carriage.pen.setState(null);
    return "The line may have moved the pen or changed its settings. The next move sets heights and speeds again.";
  }
  if (ZEROES.has(name)) {
    await carriage.position.forget();
    return "The line set the motors' counters to zero, so the position is unknown. The next move starts from here as home, or finds home first if the machine can.";
  }
  if (!MOVES.has(name)) return null;
  return (await carriage.position.readBackOrForget(LONGEST_S))
    ? "The motors may have moved. The position was read back from their counters."
    : "The motors may have moved, so the position is unknown. The next move starts from here as home, or finds home first if the machine can.";
}
