/**
 * One line typed at the board, with everything that it answers. Lines after which the board and the driver would
 * no longer understand each other are refused; after those that move or reset the motors' counters, the driver
 * reads the place back or forgets it.
 */
import { commandName, PlotwrightError } from "../../src/index.js";
import type { CommandAnswer } from "../../src/schema/index.js";
import type { Carriage } from "./carriage.js";

/** Motion that a user has started may last this long, seconds of board time. */
const LONGEST_S = 120;

const REFUSED: readonly (readonly [RegExp, string])[] = [
  [/^CU,1(,|$)/i, "it would switch off the answers that plotwright waits for"],
  [/^CU,4(,|$)/i, "plotwright sets the depth of the board's queue itself"],
  [/^CU,10(,|$)/i, "it would change the syntax in which the board answers"],
  [/^BL$/i, "the board would leave its firmware for the boot loader"],
  [/^EM(,\d*)?$/i, "not every firmware answers it; give both motors, as in EM,1,1"],
];

const MOVES = new Set(["SM", "XM", "LM", "LT", "L3", "T3", "TD", "TR", "HM", "ES"]);
const ZEROES = new Set(["EM", "CS", "R"]);
const PEN = new Set(["SP", "TP", "S2", "SC", "SE"]);

/** Rejects with `bad-setting` for a line that is refused, `board-timeout` when nothing is answered. */
export async function sendLine(carriage: Carriage, line: string): Promise<CommandAnswer> {
  const why = REFUSED.find(([pattern]) => pattern.test(line))?.[1];
  if (why !== undefined) {
    throw new PlotwrightError("bad-setting", `${line} is not sent: ${why}.`);
  }
  const name = commandName(line);
  const { session } = carriage.connection;
  if (name === "RB") {
    await session.send(line);
    return { replies: [], note: "The board starts anew; the connection comes back by itself." };
  }
  const replies = await repliesTo(carriage, line);
  return { replies, note: await noteOn(carriage, name) };
}

/** All lines up to the answer of a query that is sent behind it: some commands answer more than one. */
async function repliesTo(carriage: Carriage, line: string): Promise<string[]> {
  const { session } = carriage.connection;
  const mark = `console: ${line}`;
  session.log.add("note", mark);
  await session.query(line, LONGEST_S).catch((error: unknown) => {
    // What the board refuses, it says in a line of its own.
    if (!(error instanceof PlotwrightError && error.code === "board-error")) throw error;
  });
  await session.query("QM", LONGEST_S);
  const answers: string[] = [];
  // Newest first: the answer to QM, then what was answered before it.
  for (const one of [...session.log.tail(40)].reverse()) {
    const [, kind, text] = /^\S+ ([<>#]) (.*)$/.exec(one) ?? [];
    if (kind === "#" && text === mark) break;
    if (kind === "<" && text !== undefined) answers.unshift(text);
  }
  // Lines of a shape that the session does not know make it ask for V, to know again which answer is which.
  return answers.slice(0, -1).filter((text) => commandName(line) === "V" || !/^EBBv.* Version /.test(text));
}

async function noteOn(carriage: Carriage, name: string): Promise<string | null> {
  if (PEN.has(name)) {
    carriage.penIsUnknown();
    return "The pen was moved or set past plotwright: the next move sets heights and speeds anew.";
  }
  if (ZEROES.has(name)) {
    await carriage.forgetPlace();
    return "The motors' counters were set to zero: the place is forgotten, and home is where the carriage stands when it moves next.";
  }
  if (!MOVES.has(name)) return null;
  return (await carriage.findPlaceAgain(LONGEST_S))
    ? "The motors may have moved: the place was read back from their counters."
    : null;
}
