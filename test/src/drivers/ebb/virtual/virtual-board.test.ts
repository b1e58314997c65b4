import { describe, expect, it } from "vitest";
import { setUpCommands } from "../../../../../src/drivers/ebb/protocol/commands.js";
import { VirtualBoard } from "../../../../../src/drivers/ebb/virtual/virtual-board.js";
import {
  commandLine,
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  machineById,
  plan,
} from "../../../../../src/index.js";
import { STANDARD_SERVO } from "../../../../../src/machines/pen-servo.js";
import { strokeSetOf } from "../../../../support/drawings/arbitraries.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";
import { ascii, boardWith } from "../../../../support/machines/board-in-text.js";

describe("the virtual board's bytes", () => {
  it.each([
    ["3.0.3", "V", "EBBv13_and_above EB Firmware Version 3.0.3\r\n"],
    ["2.8.1", "v", "EBBv13_and_above EB Firmware Version 2.8.1\r\n"],
    ["3.0.3", "QM", "QM,0,0,0,0\n\r"],
    ["2.4.3", "QM", "QM,0,0,0\n\r"],
    ["3.0.3", "QG", "10\r\n"],
    ["3.0.3", "QS", "0,0\n\rOK\r\n"],
    ["3.0.3", "QP", "1\n\rOK\r\n"],
    ["3.0.3", "QB", "0\r\nOK\r\n"],
    ["3.0.3", "QC", "394,297\r\nOK\r\n"],
    ["2.8.1", "QC", "0394,0297\r\nOK\r\n"],
    ["3.0.3", "QN", "0\r\nOK\r\n"],
    ["2.8.1", "QN", "0000000000\r\nOK\r\n"],
    ["2.8.1", "QL", "000\r\nOK\r\n"],
    ["3.0.3", "QT", "\r\nOK\r\n"],
    ["3.0.3", "ES", "0\n\rOK\r\n"],
    ["2.8.1", "ES", "0,0,0,0,0\n\rOK\r\n"],
    ["3.0.3", "QU,2", "QU,32\r\nOK\r\n"],
    ["3.0.1", "QU,2", "QU,2,32\r\nOK\r\n"],
    ["3.0.3", "PI,B,1", "PI,1\r\n"],
    ["2.8.1", "EM,1,1", "OK\r\n"],
    ["2.8.1", "CS", "OK\r\n"],
    ["2.8.1", "SC,4,20000", "OK\r\n"],
    ["2.8.1", "R", "OK\r\n"],
    ["2.8.1", "RB", ""],
    ["2.8.1", "XX", "!8 Err: Unknown command 'XX:5858'\r\n"],
    ["2.8.1", "SM", "!4 Err: Missing parameter(s)\r\n"],
    ["2.8.1", "SM,10,abc", "!6 Err: Invalid parameter value\r\n"],
    ["2.8.1", "SPX", "!5 Err: Need comma next, found: 'X'\r\n"],
    ["2.5.3", "LT,10,5,5,5,5", "!8 Err: Unknown command 'LT:4C54'\r\n"],
    ["2.8.1", "LT,10,0,5,0,5", "!6 Err: Invalid parameter value\r\n"],
    ["3.0.3", "LT,0,5,5,5,5", "!6 Err: Invalid parameter value\r\n"],
    ["3.0.3", "LM,-5,-5,0,0,0,0", "!6 Err: Invalid parameter value\r\n"],
  ])("firmware %s answers %s", (firmware, line, reply) => {
    expect(boardWith({ firmware }).ask(line)).toBe(reply);
  });

  it("answers with one named line each in future syntax", () => {
    const { ask } = boardWith({ firmware: "3.0.3" });
    expect(ask("CU,10,1")).toBe("\n");
    expect(ask("SP,1,0")).toBe("SP\n");
    expect(ask("QS")).toBe("QS,0,0\n");
    expect(ask("QU,3")).toBe("QU,1\n\n");
    expect(ask("SM")).toBe("SM,!4 Err: Missing parameter(s)\n");
    expect(ask("CU,10,0")).toBe("CUOK\r\n");
    expect(ask("QS")).toBe("0,0\n\rOK\r\n");
  });

  it("reports surplus parameters after running the command", () => {
    const { ask, board } = boardWith({ speed: Infinity });
    expect(ask("SM,1,1,1,0,0")).toBe("OK\r\n!7 Err: Extra parameter\r\n");
    expect(board.state()).toMatchObject({ steps1: 1, steps2: 1 });
  });

  it("takes CR, LF and CR LF as one end of line and drops other control bytes", () => {
    const { board, take } = boardWith();
    board.receive(ascii("QP\r\nQP\nQ\x01P\rQX\x08P\r"));
    expect(take()).toBe("1\n\rOK\r\n".repeat(4));
  });

  it("refuses a line of more than 255 characters", () => {
    expect(boardWith().ask(`SM,${"1".repeat(260)}`)).toBe("!3 Err: RX Buffer overrun\r\n");
  });

  it("latches its button until it is read", () => {
    const { board, ask } = boardWith({ firmware: "3.0.3" });
    board.pressButton();
    expect(ask("QG")).toBe("30\r\n");
    expect(ask("QG")).toBe("10\r\n");
    board.pressButton();
    expect(ask("QB")).toBe("1\r\nOK\r\n");
    expect(ask("QB")).toBe("0\r\nOK\r\n");
  });

  it("remembers that the motor supply was low", () => {
    const { board, ask } = boardWith({ firmware: "3.0.3" });
    ask("CU,60,250");
    board.setMotorVolts(0);
    expect(ask("QC")).toBe("394,0\r\nOK\r\n");
    board.setMotorVolts(9.1);
    expect(ask("QG")).toBe("50\r\n");
    expect(ask("QG")).toBe("10\r\n");
  });
});

describe("the virtual board's queue", () => {
  it("delays the OK of a move until the one before it has begun", async () => {
    const { clock, board, take } = boardWith({ firmware: "2.8.1" });
    board.receive(ascii("SM,100,80,0\rSM,100,80,0\rSM,100,80,0\rQS\r"));
    expect(take()).toBe("OK\r\nOK\r\n");
    await clock.advance(0.099);
    expect(take()).toBe("");
    await clock.advance(0.002);
    expect(take()).toMatch(/^OK\r\n(80|81),0\n\rOK\r\n$/);
  });

  it("stops reading while its parser is blocked, and reports when it reads again", async () => {
    const { clock, board } = boardWith({ inputBytes: 64 });
    let drained = 0;
    board.onDrain(() => drained++);
    board.receive(ascii("SM,100,8,0\r".repeat(20)));
    expect(board.accepting).toBe(false);
    await clock.advance(1.6);
    expect(board.accepting).toBe(true);
    expect(drained).toBe(1);
  });

  it("is up to 32 deep on firmware 3", () => {
    const { board, take, ask } = boardWith({ firmware: "3.0.3" });
    ask("CU,4,40");
    expect(ask("QU,3")).toBe("QU,32\r\nOK\r\n");
    board.receive(ascii("SM,100,8,0\r".repeat(40)));
    expect(take()).toBe("OK\r\n".repeat(33));
  });

  it("drops running and waiting orders at ES, and keeps the true position", async () => {
    const { clock, board, ask, take } = boardWith({ firmware: "3.0.3" });
    ask("CU,4,32");
    board.receive(ascii("LT,25000,85899346,0,85899346,0\rLT,25000,85899346,0,85899346,0\r"));
    take();
    await clock.advance(0.5);
    expect(ask("ES")).toBe("1\n\rOK\r\n");
    expect(ask("QS")).toBe("500,500\n\rOK\r\n");
    expect(ask("QM")).toBe("QM,0,0,0,0\n\r");
  });

  it("does not stop a timed move at ES on firmware 2.8", async () => {
    const { clock, board, ask, take } = boardWith({ firmware: "2.8.1" });
    board.receive(ascii("LT,25000,85899346,0,85899346,0\r"));
    take();
    await clock.advance(0.5);
    expect(ask("ES")).toBe("0,0,0,0,0\n\rOK\r\n");
    await clock.advance(0.6);
    expect(ask("QS")).toBe("1000,1000\n\rOK\r\n");
  });

  it("stays busy until ES with a motor that has steps to make but no rate", async () => {
    const { clock, ask } = boardWith({ firmware: "3.0.3" });
    ask("LM,85899346,10,0,0,10,0");
    await clock.advance(100);
    expect(ask("QM")).toBe("QM,1,0,1,0\n\r");
    expect(ask("ES")).toBe("1\n\rOK\r\n");
    expect(ask("QS")).toBe("10,0\n\rOK\r\n");
  });

  it("zeroes its counters in the middle of a move and continues", async () => {
    const { clock, ask } = boardWith({ firmware: "2.8.1" });
    ask("SM,1000,1000,-1000");
    await clock.advance(0.5);
    ask("CS");
    await clock.advance(0.6);
    expect(ask("QS")).toMatch(/^501,-501\n\rOK\r\n$/);
  });

  it("clears the counters with EM when its turn comes", async () => {
    const { clock, ask } = boardWith({ firmware: "2.8.1" });
    ask("SM,100,100,100");
    ask("EM,1,1");
    expect(ask("QE")).toBe("16,16\n\rOK\r\n");
    await clock.advance(0.2);
    expect(ask("QS")).toBe("0,0\n\rOK\r\n");
    expect(ask("EM,1")).toBe("");
  });

  it("goes home in a straight line", () => {
    const { ask, board } = boardWith({ firmware: "3.0.3", speed: Infinity });
    ask("SM,1000,3000,-1000");
    ask("HM,3000");
    expect(board.state()).toMatchObject({ steps1: 0, steps2: 0 });
  });
});

describe("the virtual board's test mode", () => {
  // The firmware's own regression tests: command, net steps of motor 1.
  const RECORDED: readonly [string, number][] = [
    ["LM,490123456,5,0,0,0,0", 5],
    ["LM,8589934,29,17353403,0,0,0", 29],
    ["LM,395851877,3,-77012345,0,0,0,115030", -3],
    ["LM,-1050109930,134,5099123,0,0,0", 34],
    ["LT,22,-490123456,0,0,0", -5],
    ["LT,11,1204481500,-77012345,0,0", 4],
    ["LT,14,-79000000,10015000,0,0,128535542", 0],
    ["LT,8842,-388686102,70433,0,0,623903050", -318],
    ["T3,19512,-490123456,0,11,0,0,0", 1889],
    ["T3,69,1800095000,-26012345,600999,0,0,0", 44],
  ];
  const onEach = ["3.0.3", "3.1.7"].flatMap((firmware) => RECORDED.map((row) => [firmware, ...row] as const));
  it.each(onEach)("on firmware %s, %s makes %i steps", (firmware, line, net) => {
    const { ask } = boardWith({ firmware, speed: Infinity });
    ask("CU,251,1");
    expect(ask(line)).toBe("OK\r\n");
    expect(ask("QS")).toBe(`${net},0\n\rOK\r\n`);
  });

  it.each([
    ["3.0.3", 398, 2500 + 7500 + 2625],
    ["2.8.1", 400, 2500 + 7500 + 2501],
  ])("firmware %s ends a braking LM aimed at zero after %i steps", (firmware, steps, ticks) => {
    const { ask, board } = boardWith({ firmware, speed: Infinity });
    ask("LM,0,400,274878,0,400,274878,3");
    ask("LM,687194767,2400,0,687194767,2400,0");
    ask("LM,687194767,400,-274878,687194767,400,-274878");
    expect(board.state()).toMatchObject({ steps1: 2800 + steps, steps2: 2800 + steps });
    expect(Math.abs(board.statistics().movingS * 25_000 - ticks)).toBeLessThan(3);
  });
});

describe("L3 on the virtual board", () => {
  const afterL3 = (firmware: string, line: string): { reply: string; ticks: number; steps: string } => {
    const { ask, board } = boardWith({ firmware, speed: Infinity });
    const reply = ask(line);
    const ticks = Math.round(board.statistics().movingS * 25_000);
    return { reply, ticks, steps: ask("QS").split("\n")[0] };
  };
  const forward = afterL3("3.1.7", "L3,20000000,300,100000,20,0,0,0,0,3");

  it("runs backward as it runs forward from firmware 3.1 on", () => {
    const backward = afterL3("3.1.7", "L3,20000000,-300,100000,20,0,0,0,0,3");
    expect([forward.steps, backward.steps]).toEqual(["300,0", "-300,0"]);
    expect(backward.ticks).toBe(forward.ticks);
  });

  it("does not negate the jerk of a backward move before", () => {
    const backward = afterL3("3.0.3", "L3,20000000,-300,100000,20,0,0,0,0,3");
    expect(backward.ticks).toBeGreaterThan(forward.ticks);
  });

  it("looks at the jerk of each motor from firmware 3.1 on, and before only at the first one's", () => {
    const onlyJerk2 = "L3,0,5,0,0,0,5,0,9";
    expect(afterL3("3.0.3", onlyJerk2).reply).toMatch(/^!6/);
    expect(afterL3("3.1.7", "L3,0,0,0,7,0,5,0,0").reply).toMatch(/^!6/);
    expect(boardWith({ firmware: "3.1.7" }).ask(onlyJerk2)).toBe("OK\r\n");
  });
});

describe("the virtual board's pen", () => {
  it("draws with the pen down and travels with it up", () => {
    const { ask, board } = boardWith({ speed: Infinity });
    ask("SM,100,800,800");
    ask("SP,0,100");
    ask("SM,100,800,-800");
    ask("SP,1,100");
    ask("SM,100,-1600,0");
    const lines = board.drawn();
    expect(lines.map((line) => line.penDown)).toEqual([false, true, false]);
    expect([...lines[1].xy].slice(0, 2)).toEqual([10, 0]);
    expect([...lines[1].xy].slice(-2)).toEqual([10, 10]);
    expect(board.statistics()).toMatchObject({ penMoveCount: 2, moveCount: 3 });
    expect(board.statistics().drawnMm).toBeCloseTo(10, 6);
  });

  it("moves the servo in the time of its machine and rate while the delay holds the queue", async () => {
    const { clock, ask, board } = boardWith();
    ask("SC,4,20000");
    ask("SC,5,10000");
    ask("SC,11,1000");
    ask("SC,12,1000");
    ask("SP,0,300");
    await clock.advance(5);
    ask("SP,1,300");
    await clock.advance(0.12);
    expect(board.state()).toMatchObject({ penUp: true, isBusy: true });
    // The servo alone takes 194.6 ms for these 48.8 %, and its signal 240 ms: 262.6 ms together.
    const pos = 10_000 + 10_000 * (0.12 / 0.26257);
    expect(board.state().penPct).toBeCloseTo((100 * (pos - 7_500)) / 20_500, 2);
    await clock.advance(0.18);
    expect(board.state().isBusy).toBe(false);
  });
});

describe("the virtual board's servo frame", () => {
  /** How fast the pen moves by these commands, percent of its range per second. */
  const speedAfter = (machine: string, ...lines: string[]): number => {
    const { ask, board } = boardWith({ speed: Infinity, machine: machineById(machine) });
    for (const line of [...lines, "SP,0,500"]) ask(line);
    return board.statistics().fastestPenPctPerS;
  };

  it("is 24 ms until SC,8 and SC,9 change it, and again after a reset", () => {
    const down = ["SC,5,10000", "SC,12,410"];
    expect(speedAfter("axidraw-v3", ...down)).toBeCloseTo(410 / 205 / 0.024, 9);
    expect(speedAfter("axidraw-v3", "SC,8,4", ...down)).toBeCloseTo(410 / 205 / 0.012, 9);
    expect(speedAfter("axidraw-v3", "SC,8,4", "SC,9,5", ...down)).toBeCloseTo(410 / 205 / 0.02, 9);
    expect(speedAfter("axidraw-v3", "SC,8,1", "R", ...down)).toBeCloseTo(410 / 205 / 0.024, 9);
  });

  it("of a profile that is no multiple of the board's slots is rounded, and the pen moves as fast as its settings say", () => {
    for (const frameMs of [3, 4, 5, 10, 23, 24]) {
      const machine = { ...machineById("axidraw-v3"), penServo: { ...STANDARD_SERVO, frameMs } };
      const { ask, board } = boardWith({ speed: Infinity, machine });
      for (const line of setUpCommands(machine, { ...DEFAULT_PEN, dropPctPerS: 40 }, "2.8.1")) ask(line);
      ask("SP,0,500");
      expect(board.statistics().fastestPenPctPerS).toBeGreaterThanOrEqual(40 - 1e-9);
      expect(board.statistics().fastestPenPctPerS).toBeLessThan(42);
    }
  });

  it("left by other software makes a gentle pen too fast or too slow, unless the plot's set-up sets it", () => {
    const pen = { ...DEFAULT_PEN, dropPctPerS: 40 };
    for (const [id, otherFrame, factor] of [
      ["axidraw-v3", "SC,8,1", 8],
      ["axidraw-v3", "SC,9,12", 1 / 4],
      ["nextdraw-8511", "SC,8,8", 1 / 8],
    ] as const) {
      const machine = machineById(id);
      const strokes = strokeSetOf([[[0, 0], [5, 0]]]); // prettier-ignore
      const trajectory = plan(strokes, DEFAULT_MOTION, pen, { machine });
      const stream = compile(trajectory, { machine, firmware: "2.8.1", pen });
      const lines = Array.from({ length: stream.count }, (_, i) => commandLine(stream, i));
      const speedOf = (sent: readonly string[]): number => {
        const { ask, board } = boardWith({ speed: Infinity, machine });
        for (const line of [
          otherFrame,
          ...sent.slice(0, sent.findIndex((one) => /^(SP,0|S2)/.test(one)) + 1),
        ])
          ask(line);
        return board.statistics().fastestPenPctPerS;
      };
      // A rate is a whole number of units per frame.
      expect(speedOf(lines)).toBeGreaterThanOrEqual(40);
      expect(speedOf(lines)).toBeLessThan(45);
      const withoutFrame = lines.filter((line) => !/^SC,[89],/.test(line));
      expect(speedOf(withoutFrame) / speedOf(lines)).toBeCloseTo(factor, 9);
    }
  });
});

describe("the virtual board as a transport", () => {
  it("accepts a write when the system has room for it, and passes the bytes on as the board reads", async () => {
    const clock = new ManualClock();
    const board = new VirtualBoard({ clock, systemBytes: 100, inputBytes: 64 });
    const transport = board.transport();
    let okCount = 0;
    transport.onData((bytes) => (okCount += String.fromCharCode(...bytes).split("OK").length - 1));
    let taken = 0;
    const writes = Array.from({ length: 40 }, () =>
      transport.write(ascii("SM,100,80,80\r")).then(() => taken++),
    );
    await Promise.resolve();
    await Promise.resolve();
    expect(taken).toBeLessThan(20);
    await clock.advance(10);
    await Promise.all(writes);
    expect(okCount).toBe(40);
    expect(board.statistics().underrunCount).toBe(0);
  });

  it("closes the previous connection when it is opened again", () => {
    const board = new VirtualBoard({ clock: new ManualClock() });
    let reason: Error | undefined;
    board.transport().onClose((error) => (reason = error));
    board.transport();
    expect(reason).toMatchObject({ code: "disconnected" });
  });

  it("rejects an invalid speed", () => {
    expect(() => new VirtualBoard({ clock: new ManualClock(), speed: 0 })).toThrow(RangeError);
  });
});
