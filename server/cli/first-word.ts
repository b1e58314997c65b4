/** The error for an unknown command, with a guess at what the user meant. */
import { PlotwrightError } from "../../src/index.js";

const DRAWING = /\.(svg|dxf|hpgl|hpg|plt|json)$/i;

export const notACommand = (word: string, commands: readonly string[]): PlotwrightError =>
  new PlotwrightError("bad-setting", `There is no command ${word}. ${hint(word, commands)}`);

function hint(word: string, commands: readonly string[]): string {
  if (DRAWING.test(word)) return `To plot a drawing: plotwright plot ${word}`;
  if (/^\d+$/.test(word)) {
    return `To choose the port: plotwright --port ${word}, or npm start -- --port ${word} (with -- before the options).`;
  }
  if (word === "recover" || word === "resume")
    return "To continue a drawing that was begun: plotwright plot --resume";
  if (word === "version") return "To print the version: plotwright --version";
  const near = nearest(word, commands);
  if (near !== null) return `Did you mean ${near}?`;
  return `The commands are ${commands.join(", ")}.`;
}

/** The command that `word` probably misspells; null if there is none. */
function nearest(word: string, commands: readonly string[]): string | null {
  return commands.find((command) => isTypo(word, command) || isTypo(command, word)) ?? null;
}

/** Whether `a` is `b` with one letter missing or different, or with two neighbouring letters swapped. */
function isTypo(a: string, b: string): boolean {
  for (let i = 0; i <= b.length; i++) {
    const [head, tail] = [b.slice(0, i), b.slice(i + 1)];
    if (a === head + tail) return true;
    if (a.length === b.length && a.startsWith(head) && a.endsWith(tail)) return true;
    if (a === head + b.slice(i + 1, i + 2) + b.slice(i, i + 1) + b.slice(i + 2)) return true;
  }
  return false;
}
