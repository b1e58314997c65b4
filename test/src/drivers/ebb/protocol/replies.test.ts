import { describe, expect, it } from "vitest";
import { commandName, replyShape } from "../../../../../src/drivers/ebb/protocol/replies.js";
import { LineSplitter } from "../../../../../src/drivers/line-splitter.js";

const ascii = (text: string): Uint8Array => Uint8Array.from(text, (c) => c.charCodeAt(0));

function linesOf(...chunks: string[]): string[] {
  const splitter = new LineSplitter();
  const lines: string[] = [];
  for (const chunk of chunks) splitter.push(ascii(chunk), (line) => lines.push(line));
  return lines;
}

describe("lines from the board", () => {
  it("end at any run of CR and LF, wherever the chunks are cut", () => {
    const text = "1,2\n\rOK\r\n\r\nQM,0,0,0,0\n\r";
    const whole = ["1,2", "OK", "QM,0,0,0,0"];
    for (let cut = 0; cut <= text.length; cut++) {
      expect(linesOf(text.slice(0, cut), text.slice(cut))).toEqual(whole);
    }
  });

  it("lose bytes that are not text, and have a maximum length", () => {
    expect(linesOf("O\x00\x07\xffK\r")).toEqual(["OK"]);
    expect(linesOf(`${"x".repeat(10_000)}\r`)[0].length).toBeLessThan(1_000);
  });
});

describe("a command", () => {
  it("has a name, however it is written", () => {
    expect(["sp,1,250", "QS", "v"].map(commandName)).toEqual(["SP", "QS", "V"]);
  });

  it("is answered by OK, by values, by both or not at all", () => {
    const kinds = ["SP", "V", "QS", "RB"].map(replyShape);
    expect(kinds.map(({ ok }) => ok)).toEqual([true, false, true, false]);
    expect(kinds.map(({ valueEnd }) => valueEnd !== null)).toEqual([false, true, true, false]);
    expect(kinds.map(({ isSilent }) => isSilent)).toEqual([false, false, false, true]);
  });
});
