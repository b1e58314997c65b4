/**
 * One line typed to the board, with all its answers. Refuses lines after which the board and the driver would
 * no longer understand each other (console-lines.ts). After lines that move or reset the motors' counters,
 * the driver reads the position back or forgets it.
 */
import { PlotwrightError } from "../../../errors.js";
import type { ConsoleAnswer } from "../../driver.js";
import { commandName } from "../protocol/replies.js";
import { LONGEST_S, whyRefused } from "./console-lines.js";
import type { Carriage } from "./carriage.js";

const MOVES = new Set(["SM", "XM", "LM", "LT", "L3", "T3", "TD", "TR", "HM", "ES"]);
const ZEROES = new Set(["EM", "CS"]);
const PEN = new Set(["SP", "TP", "S2", "SC", "SE"]);

/** Rejects with `bad-setting` for a line that is refused, with `board-timeout` if nothing is answered. */
export async function sendLine(carriage: Carriage, line: string): Promise<ConsoleAnswer> {
  const why = whyRefused(line);
  if (why !== null) throw new PlotwrightError("bad-setting", `${JSON.stringify(line)} was not sent: ${why}.`);
  const name = commandName(line);
  const replies = await repliesTo(carriage, line);
  return { replies, note: await noteOn(carriage, name) };
}

/** All lines up to the answer of a query that is sent after it: some commands answer with more than one line. */
async function repliesTo(carriage: Carriage, line: string): Promise<string[]> {
  const { session } = carriage.connection;
  const mark = `console: ${line}`;
  session.log.add("note", mark);
  await session.query(line, LONGEST_S).catch((error: unknown) => {
    // An error is a line of its own.
    if (!(error instanceof PlotwrightError && error.code === "board-error")) throw error;
  });
  await session.query("QM", LONGEST_S);
  const answers: string[] = [];
  // Newest first: the answer to QM, then the earlier ones.
  for (const one of [...session.log.tail(40)].reverse()) {
    const [, kind, text] = /^\S+ ([<>#]) (.*)$/.exec(one) ?? [];
    if (kind === "#" && text === mark) break;
    if (kind === "<" && text !== undefined) answers.unshift(text);
  }
  // After a line of unknown form the session asks for V, to match answers and queries again.
  return answers.slice(0, -1).filter((text) => commandName(line) === "V" || !/^EBBv.* Version /.test(text));
}

async function noteOn(carriage: Carriage, name: string): Promise<string | null> {
  if (PEN.has(name)) {
    carriage.penIs(null);
    return "The pen was moved or set outside plotwright. The next move sets heights and speeds again.";
  }
  if (ZEROES.has(name)) {
    await carriage.forgetPlace();
    return "The motors' counters were set to zero, so the position is forgotten. Home is where the machine is when it moves next.";
  }
  if (!MOVES.has(name)) return null;
  return (await carriage.findPlaceAgain(LONGEST_S))
    ? "The motors may have moved. The position was read back from their counters."
    : null;
}
