/** The error for an unknown command, with what was probably meant. */
import { PlotwrightError } from "../../src/index.js";

const DRAWING = /\.(svg|dxf|hpgl|hpg|plt|json)$/i;

export const notACommand = (word: string, commands: readonly string[]): PlotwrightError =>
  new PlotwrightError("bad-setting", `There is no command ${word}. ${hint(word, commands)}`);

function hint(word: string, commands: readonly string[]): string {
  if (DRAWING.test(word)) return `To plot a drawing: plotwright plot ${word}`;
  if (/^\d+$/.test(word)) {
    return `To choose the port: plotwright --port ${word}, or npm start -- --port ${word} (with -- before the options).`;
  }
  return `The commands are ${commands.join(", ")}.`;
}
