/** Which typed lines are kept from the board, however they are written. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { VirtualBoard } from "../../../../../src/index.js";
import { whyRefused } from "../../../../../src/drivers/ebb/machine/console-lines.js";
import { cases } from "../../../../support/runs/full-run.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";

describe("a line for the board", () => {
  it.each(
    [
      ["restarts it", ["BL", "bl", "BL,1", "BL,", "RB", "rb,0", "R", "r", "r,1"]],
      ["restarts it, whatever follows its name", ["BL;", "BLx", "RB0", "rb0,1", "BL_,1", "bL;QM"]],
      ["is longer than the board's buffer", [`ST,${"x".repeat(253)}`, `${"QM".padEnd(256, "x")}BL`]],
      ["goes home slowly", ["HM,1", "HM,0", "HM", "HM,999", "HM,1000,1,0", "HM,25000,0,2880001"]],
      [
        "changes how it answers",
        ["CU,1,0", "CU,01,0", "cu,001,0", "CU,10,1", "CU,0010,1", "CU,54,1", "CU,251,1"],
      ],
      ["changes how the board watches its supply", ["CU,60,0", "cu,060,250"]],
      ["sets its queue", ["CU,4,0", "CU,4", "CU,04,-1", "CU,004,32"]],
      [
        "has numbers that may be read differently",
        ["CU,257,0", "CU,4294967297,0", "CU,,0", "CU", "CU,1x,0", "CU,-1,0"],
      ],
      ["has spaces", ["CU ,1,0", "CU, 1,0", "B L", " BL", "SM,1, 1,1"]],
      ["is more than one line", ["V\rBL", "V\nCU,1,0", "V\tx", ""]],
      ["causes unsolicited lines or writes to memory", ["T,100,0", "MW,1,2", "C,0,0,0,0,0"]],
      ["is not answered by every firmware", ["EM", "EM,1", "em,"]],
      ["never ends", ["LM,0,100,0,0,0,0", "LM,1,100,0,0,0,0", "LM,9,0,0,0,5,0", "L3,0,5,0,0,0,0,0,0"]],
      [
        "lasts for hours",
        ["SM,120001,1,1", "XM,16777215,0,0", "LT,3000001,9,0,9,0", "T3,4000000,1,0,0,1,0,0", "TD,1500001"],
      ],
    ].flatMap(([what, lines]) => (lines as string[]).map((line) => [what, line] as const)),
  )("a line that %s is refused: %j", (_what, line) => {
    expect(whyRefused(line)).not.toBeNull();
  });

  it.each([
    "V",
    "qs",
    "QC",
    "SP,1,250",
    "sp,0",
    "SM,1000,80,-80",
    "EM,1,1",
    "CU,3,1",
    "ST,My plotter",
    "LM,85899346,100,0,85899346,-100,0",
    "LM,0,10,2748,0,0,0",
    "LT,25000,85899346,0,0,0",
    "HM,3200",
    "HM,1000",
    "HM,25000,2880000,0",
    "XX,1",
    "constructor",
  ])("a line without such a fault is sent: %j", (line) => {
    expect(whyRefused(line)).toBeNull();
  });
});

describe("the filter and the virtual board agree on which command a line is", () => {
  const names = ["BL", "RB", "R", "CU", "QM", "V", "T", "C", "SM", "HM", "ST", "XX"];
  const line = fc
    .tuple(
      fc.constantFrom(...names, ...names.map((name) => name.toLowerCase())),
      fc.string({ maxLength: 6, unit: fc.constantFrom(...";,01 .-xBLR_#") }),
    )
    .map(([name, rest]) => name + rest);

  it.each(["BL;", "RB0", "bl;QM", "RB.,1"])(
    "the filter and the virtual board agree on a line which restarts for %s",
    (text) => {
      const board = new VirtualBoard({ clock: new ManualClock(), speed: Infinity });
      let isDropped = false;
      board.onDrop(() => (isDropped = true));
      board.receive(Buffer.from(`${text}\r`));
      expect(isDropped).toBe(true);
      board.close();
    },
  );

  it("so that no line that passes makes it restart, fall silent or answer in another way", () => {
    fc.assert(
      fc.property(
        fc.oneof(line, fc.string({ maxLength: 12 })),
        fc.constantFrom("2.8.1", "3.0.3"),
        (text, firmware) => {
          fc.pre(whyRefused(text) === null);
          const board = new VirtualBoard({ clock: new ManualClock(), firmware, speed: Infinity });
          let sent = "";
          let isDropped = false;
          board.onSend((bytes) => (sent += Buffer.from(bytes).toString("latin1")));
          board.onDrop(() => (isDropped = true));
          board.receive(Buffer.from("SC,4,12345\r"));
          board.receive(Buffer.from(`${text}\r`));
          sent = "";
          board.receive(Buffer.from("QP\r"));
          expect([isDropped, sent]).toEqual([false, expect.stringMatching(/^[01]\n\rOK\r\n$/)]);
          board.close();
        },
      ),
      { numRuns: cases(20_000, 1_000) },
    );
  });
});
