import { describe, expect, it } from "vitest";
import { commandName, LineSplitter, ReplyMatcher, type Reply } from "../../../src/ebb/replies.js";

const ascii = (text: string): Uint8Array => Uint8Array.from(text, (c) => c.charCodeAt(0));

function linesOf(...chunks: string[]): string[] {
  const splitter = new LineSplitter();
  const lines: string[] = [];
  for (const chunk of chunks) splitter.push(ascii(chunk), (line) => lines.push(line));
  return lines;
}

/** Sends the commands, feeds the bytes, and returns what was matched. */
function matched(commands: string[], bytes: string, syntax: "legacy" | "future" = "legacy"): Reply[] {
  const matcher = new ReplyMatcher(syntax);
  for (const command of commands) matcher.expect(command);
  const replies: Reply[] = [];
  for (const line of linesOf(bytes)) {
    const reply = matcher.line(line);
    if (reply !== null) replies.push(reply);
  }
  return replies;
}

describe("lines from the board", () => {
  it("end at any run of CR and LF, wherever the chunks are cut", () => {
    const text = "1,2\n\rOK\r\n\r\nQM,0,0,0,0\n\r";
    const whole = ["1,2", "OK", "QM,0,0,0,0"];
    for (let cut = 0; cut <= text.length; cut++) {
      expect(linesOf(text.slice(0, cut), text.slice(cut))).toEqual(whole);
    }
  });

  it("lose bytes that are no text, and do not grow without end", () => {
    expect(linesOf("O\x00\x07\xffK\r")).toEqual(["OK"]);
    expect(linesOf(`${"x".repeat(10_000)}\r`)[0]!.length).toBeLessThan(1_000);
  });
});

describe("answers in legacy syntax", () => {
  it("belong to commands in the order in which they were sent", () => {
    const replies = matched(
      ["SP,1,250", "QS", "V", "QM", "QT", "LM,1,2,3,4,5,6"],
      "OK\r\n10,-3\n\rOK\r\nEBBv13_and_above EB Firmware Version 2.8.1\r\nQM,0,0,0,0\n\r\r\nOK\r\nOK\r\n",
    );
    expect(replies).toEqual([
      { command: "SP,1,250", value: "", error: null },
      { command: "QS", value: "10,-3", error: null },
      { command: "V", value: "EBBv13_and_above EB Firmware Version 2.8.1", error: null },
      { command: "QM", value: "0,0,0,0", error: null },
      { command: "QT", value: "", error: null },
      { command: "LM,1,2,3,4,5,6", value: "", error: null },
    ]);
  });

  it("name the command that an error belongs to, with or without an OK behind it", () => {
    for (const bytes of [
      "!4 Err: Missing parameter(s)\r\n1\n\rOK\r\n",
      "!4 Err: Missing parameter(s)\r\nOK\r\n1\n\rOK\r\n",
    ]) {
      expect(matched(["SM", "QP"], bytes)).toEqual([
        { command: "SM", value: "", error: { code: 4, message: "Err: Missing parameter(s)" } },
        { command: "QP", value: "1", error: null },
      ]);
    }
  });

  it("give a surplus parameter to the command that has just been answered", () => {
    const replies = matched(["SM,1,1,1,0,0", "QP"], "OK\r\n!7 Err: Extra parameter\r\n1\n\rOK\r\n");
    expect(replies[1]).toMatchObject({ command: "SM,1,1,1,0,0", error: { code: 7 } });
    expect(replies[2]).toMatchObject({ command: "QP", value: "1" });
  });

  it("tell of a line that nobody asked for", () => {
    expect(matched([], "hello\r\n")).toEqual([{ command: null, value: "hello", error: null }]);
    expect(matched(["SP,1"], "noise\r\nOK\r\n")).toHaveLength(2);
  });
});

describe("answers in future syntax", () => {
  it("are one named line each", () => {
    expect(matched(["SP,1", "QS", "QU,3"], "SP\nQS,1,2\nQU,32\n\n", "future")).toEqual([
      { command: "SP,1", value: "", error: null },
      { command: "QS", value: "1,2", error: null },
      { command: "QU,3", value: "32", error: null },
    ]);
  });

  it("carry errors behind the name", () => {
    const [reply] = matched(["SM"], "SM,!4 Err: Missing parameter(s)\n", "future");
    expect(reply).toMatchObject({ command: "SM", error: { code: 4 } });
  });
});

describe("a reply matcher", () => {
  it("waits for nothing from commands that never answer, and forgets on demand", () => {
    const matcher = new ReplyMatcher();
    matcher.expect("RB");
    expect(matcher.waitingCount).toBe(0);
    matcher.expect("SP,1");
    expect(matcher.reset()).toEqual(["SP,1"]);
    expect(matcher.waitingCount).toBe(0);
  });

  it("knows a command's name however it is written", () => {
    expect(["sp,1,250", "QS", " v "].map(commandName)).toEqual(["SP", "QS", "V"]);
  });
});
