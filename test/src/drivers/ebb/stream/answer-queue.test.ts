import { describe, expect, it } from "vitest";
import { AnswerQueue } from "../../../../../src/drivers/ebb/stream/answer-queue.js";
import { LineSplitter } from "../../../../../src/drivers/line-splitter.js";

/** Queues the commands, feeds the bytes, and returns what was settled, in order, and the unmatched lines. */
function settled(commands: readonly string[], bytes: string) {
  const strays: string[] = [];
  const answers: [line: string, answer: string][] = [];
  const queue = new AnswerQueue((line) => strays.push(line));
  for (const line of commands) {
    queue.add({ line, settle: (error, value) => void answers.push([line, error?.message ?? value]) });
  }
  const splitter = new LineSplitter();
  splitter.push(
    Uint8Array.from(bytes, (c) => c.charCodeAt(0)),
    (line) => queue.take(line),
  );
  return { answers, strays, waitingCount: queue.count };
}

describe("replies in the syntax after power-on", () => {
  it("are matched to commands in the order in which they were sent, even the empty name of an unnamed board", () => {
    const { answers, strays } = settled(
      ["SP,1,250", "QS", "V", "QM", "QT", "LM,1,2,3,4,5,6"],
      "OK\r\n10,-3\n\rOK\r\nEBBv13_and_above EB Firmware Version 2.8.1\r\nQM,0,0,0,0\n\r\r\nOK\r\nOK\r\n",
    );
    expect(answers).toEqual([
      ["SP,1,250", ""],
      ["QS", "10,-3"],
      ["V", "EBBv13_and_above EB Firmware Version 2.8.1"],
      ["QM", "0,0,0,0"],
      ["QT", ""],
      ["LM,1,2,3,4,5,6", ""],
    ]);
    expect(strays).toEqual([]);
  });

  it("include the report of a surplus parameter after an OK, which is matched to no other command", () => {
    const { answers, strays } = settled(
      ["SM,1,1,1,0,0", "QP"],
      "OK\r\n!7 Err: Extra parameter\r\n1\n\rOK\r\n",
    );
    expect(answers).toEqual([
      ["SM,1,1,1,0,0", ""],
      ["QP", "1"],
    ]);
    expect(strays).toEqual(["!7 Err: Extra parameter (to SM,1,1,1,0,0)"]);
  });

  it("are reported if they are unsolicited", () => {
    expect(settled([], "hello\r\n").strays).toEqual(["hello"]);
    expect(settled(["SP,1"], "noise\r\nOK\r\n")).toMatchObject({
      answers: [["SP,1", ""]],
      strays: ["noise"],
    });
  });
});

describe("replies in the syntax with one line each", () => {
  it("are matched by their names", () => {
    expect(settled(["SP,1", "QS"], "SP\nQS,1,2\n")).toEqual({
      answers: [
        ["SP,1", ""],
        ["QS", "1,2"],
      ],
      strays: [],
      waitingCount: 0,
    });
  });

  it("may have an error after the name", () => {
    const { answers } = settled(["SM"], "SM,!4 Err: Missing parameter(s)\n");
    expect(answers).toEqual([["SM", "The board refused SM: Missing parameter(s)."]]);
  });
});
