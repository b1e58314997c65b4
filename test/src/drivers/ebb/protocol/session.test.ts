import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { BoardSession } from "../../../../../src/index.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";
import { ScriptedLine } from "../../../../support/machines/scripted-line.js";
import { outcome } from "../../../../support/plots/virtual-plotter.js";

const VERSION_281 = "EBBv13_and_above EB Firmware Version 2.8.1\r\n";

function newSession(answer?: (line: string) => string | null) {
  const clock = new ManualClock();
  const line = new ScriptedLine(answer);
  return { clock, line, session: new BoardSession(line, { clock }) };
}

/** The outcome of a promise, as a value. */
describe("identifying the board", () => {
  it("reads the firmware from the reply to V", async () => {
    const { session } = newSession(() => VERSION_281);
    expect(await session.identify()).toMatchObject({ firmware: "2.8.1" });
  });

  it("switches a 3.x board that was left in its other syntax back to the legacy one", async () => {
    const { line, session } = newSession((command) =>
      command === "V" ? "V,EBBv13_and_above EB Firmware Version 3.0.3\n" : "CUOK\r\n",
    );
    expect((await session.identify()).firmware).toBe("3.0.3");
    expect(line.written).toEqual(["V", "CU,1,1", "CU,10,0"]);
  });

  it("switches off the checksums that an earlier program has required", async () => {
    let isRequired = true;
    const { clock, line, session } = newSession((command) => {
      if (command === "CU,54,0,119") isRequired = false;
      else if (isRequired) return "!10 Err: No checksum found but required\r\n";
      return command === "V" ? VERSION_281 : "OK\r\n";
    });
    expect((await clock.run(session.identify())).firmware).toBe("2.8.1");
    expect(line.written).toEqual(["V", "CU,54,0,119", "V"]);
  });

  it.each([
    ["every line", (command: string) => `${command}\r\n`],
    ["every line, its end as ^M", (command: string) => `${command}^M`],
    ["every line, without its end", (command: string) => command],
    ["every line in lower case", (command: string) => `${command.toLowerCase()}\r\n`],
  ])("refuses a port that returns %s, and says what to do", async (_, echo) => {
    for (const version of ["2.8.1", "3.0.3"]) {
      const { clock, session } = newSession(
        (command) => echo(command) + (command === "V" ? VERSION_281.replace("2.8.1", version) : "OK\r\n"),
      );
      expect(await outcome(clock.run(session.identify()))).toMatch(/^no-board: This port returns .*echo off/);
    }
  });

  it("asks again if the remains of an earlier conversation spoil the first reply", async () => {
    let asked = 0;
    const { clock, session } = newSession(() =>
      ++asked === 1 ? "!8 Err: Unknown command '1,:312C'\r\n" : VERSION_281,
    );
    expect((await clock.run(session.identify())).firmware).toBe("2.8.1");
  });

  it("reports within 3 s that nothing answers", async () => {
    const { clock, session } = newSession();
    const identified = outcome(clock.run(session.identify(), 3));
    expect(await identified).toMatch(/^board-timeout: Nothing answers on this port/);
  });

  it("quotes the reply of another device", async () => {
    const { clock, session } = newSession(() => "Grbl 1.1h ['$' for help]\r\n");
    expect(await outcome(clock.run(session.identify(), 3))).toMatch(/^no-board: .*Grbl 1\.1h/);
  });

  it.each([
    ["OK", "OK\r\n", /It sent: "OK"/],
    ["its own error", "!4\r\n", /It sent: .*"!4"/],
    ["the command itself", "V\r\nERROR\r\n", /It sent: .*"V", "ERROR"/],
    ["bytes without an end", "\x81\x7e", /choose another device, or another machine\.$/],
  ])("does not take a device that answers %s, as a modem may, for a plotter", async (_, reply, words) => {
    const { clock, session } = newSession(() => reply);
    const said = await outcome(clock.run(session.identify(), 3));
    expect(said).toMatch(/^no-board: Something answers on this port, but it is not an EiBotBoard/);
    expect(said).toMatch(words);
  });
});

describe("matching replies to commands", () => {
  it("gives each of many pending commands its own reply", async () => {
    const { line, session } = newSession();
    const all = [session.send("SM,10,5,5"), session.query("QS"), session.send("SP,1"), session.query("QG")];
    line.say("OK\r\n-12,34\n\rOK\r\nOK\r\n3E\r\n");
    expect(await Promise.all(all)).toEqual([undefined, "-12,34", undefined, "3E"]);
  });

  it("accepts bytes split anywhere", async () => {
    const reply = "OK\r\n7,-8\n\rOK\r\nQM,0,0,0,0\n\rOK\r\n";
    await fc.assert(
      fc.asyncProperty(
        fc.array(fc.integer({ min: 1, max: reply.length - 1 }), { maxLength: 10 }),
        async (cuts) => {
          const { line, session } = newSession();
          const all = [session.send("SP,1"), session.query("QS"), session.query("QM"), session.send("SP,0")];
          const places = [0, ...cuts.sort((a, b) => a - b), reply.length];
          for (let i = 1; i < places.length; i++) line.say(reply.slice(places[i - 1], places[i]));
          expect(await Promise.all(all)).toEqual([undefined, "7,-8", "0,0,0,0", undefined]);
        },
      ),
    );
  });

  it.each([
    ["without an OK after it", "!4 Err: Missing parameter(s)\r\nOK\r\n5,6\n\rOK\r\n"],
    ["with an OK after it", "!4 Err: Missing parameter(s)\r\nOK\r\nOK\r\n5,6\n\rOK\r\n"],
  ])("names the command that an error belongs to, %s", async (_, reply) => {
    const { line, session } = newSession();
    const all = [outcome(session.send("SM,1")), outcome(session.send("SP,1")), outcome(session.query("QS"))];
    line.say(reply);
    expect(await Promise.all(all)).toEqual([
      "board-error: The board refused SM,1: Missing parameter(s).",
      undefined,
      "5,6",
    ]);
  });

  it("does not take a surplus-parameter error, which comes after the OK, for the next command's reply", async () => {
    const { line, session } = newSession();
    const next = session.send("SP,1");
    line.say("OK\r\n");
    await next;
    const after = session.send("SP,0");
    line.say("!7 Err: Extra parameter\r\nOK\r\n");
    await after;
    expect(session.strayCount).toBe(1);
  });

  it("continues after a lost OK when a later value proves that it was lost", async () => {
    const { line, session } = newSession();
    const all = [session.send("LT,1"), session.send("LT,2"), session.query("QM"), session.send("LT,3")];
    line.say("OK\r\nQM,0,0,0,0\n\rOK\r\n");
    expect(await Promise.all(all)).toEqual([undefined, undefined, "0,0,0,0", undefined]);
    expect(session.lostReplyCount).toBe(1);
  });

  it("reports a lost value, and gives the other queries theirs", async () => {
    const { line, session } = newSession();
    const lost: (string | undefined)[] = [];
    session.write([{ line: "QG", onReply: (error) => lost.push(error?.message) }]);
    const all = [session.send("LT,2"), session.query("QS")];
    line.say("OK\r\n1,2\n\rOK\r\n");
    expect(await Promise.all(all)).toEqual([undefined, "1,2"]);
    expect(lost).toEqual([expect.stringContaining("reply to QG was lost")]);
  });

  it("repeats a query whose value was lost", async () => {
    const { line, session } = newSession();
    const value = session.query("QG");
    const after = session.query("QS");
    line.say("1,2\n\rOK\r\n");
    expect(await after).toBe("1,2");
    line.say("1E\r\n");
    expect(await value).toBe("1E");
    expect(line.written).toEqual(["QG", "QS", "QG"]);
  });

  it("ignores garbage between replies, and counts it", async () => {
    const { line, session } = newSession();
    const all = [session.send("SP,1"), session.query("QS")];
    line.say("\x80\xff?x\r\nOK\r\n#garbage\r\n3,4\n\rOK\r\n");
    expect(await Promise.all(all)).toEqual([undefined, "3,4"]);
    expect(session.strayCount).toBe(2);
  });
});

describe("an unsolicited reply", () => {
  const VERSION = "EBBv13_and_above EB Firmware Version 2.8.1\r\n";
  /** An identified session, and the replies that it assigns to later queries. */
  async function identified() {
    const rig = newSession();
    rig.line.answerWith((line) => (line === "V" ? VERSION : null));
    await rig.session.identify();
    rig.line.answerWith(() => null);
    const answers: string[] = [];
    const ask = (...lines: string[]): void =>
      rig.session.write(
        lines.map((line) => ({
          line,
          onReply: (error, value) => answers.push(`${line}: ${error ? "lost" : value}`),
        })),
      );
    return { ...rig, answers, ask };
  }

  it("a surplus OK does not shift the replies of later queries", async () => {
    const { line, answers, ask } = await identified();
    ask("LT,1", "LT,2", "QG", "QS", "QC", "LT,3");
    line.say("OK\r\nOK\r\nOK\r\n1E\r\n12,34\n\rOK\r\n394,300\r\nOK\r\n");
    // Until the reply to V arrives, any of them may be the surplus one: earlier replies are not trusted.
    expect(line.written.slice(-2)).toEqual(["LT,3", "V"]);
    line.say(`OK\r\n${VERSION}`);
    ask("QS", "QC");
    line.say("15,40\n\rOK\r\n394,301\r\nOK\r\n");
    expect(answers).toEqual([
      ...["LT,1: ", "LT,2: ", "QG: lost", "QS: lost", "QC: lost", "LT,3: "],
      ...["QS: 15,40", "QC: 394,301"],
    ]);
  });

  it("a surplus value is not given to another query", async () => {
    const { line, answers, ask } = await identified();
    ask("QS", "QC");
    line.say("7,8\n\r12,34\n\rOK\r\n394,300\r\nOK\r\n");
    line.say(VERSION);
    expect(answers).not.toContain("QC: 12,34");
    ask("QC");
    line.say("394,301\r\nOK\r\n");
    expect(answers[answers.length - 1]).toBe("QC: 394,301");
  });

  it("step counters are not taken for a supply reading if they cannot be one", async () => {
    const { line, answers, ask } = await identified();
    ask("QC");
    line.say("-12,34\n\rOK\r\n2000,5\n\r");
    expect(answers).toEqual([]);
  });

  it("lost values delay the commands behind them by at most one reply", async () => {
    const { line, answers, ask } = await identified();
    ask("QG", "QS", "QC", "LT,3", "LT,4");
    // All three replies were lost; V is sent at the first OK that does not fit.
    line.say("OK\r\n");
    line.say(`OK\r\n${VERSION}`);
    expect(answers).toEqual(["QG: lost", "QS: lost", "QC: lost", "LT,3: ", "LT,4: "]);
  });

  it("noise with a number after an exclamation mark is not an error of the board", async () => {
    const { line, answers, ask } = await identified();
    ask("LT,1", "LT,2");
    line.say("x!37\r\n#!5~\r\nOK\r\nz!8 Err: Unknown command\r\n");
    expect(answers).toEqual(["LT,1: ", "LT,2: lost"]);
  });
});

describe("a board that fails", () => {
  it("is detected as silent after the session's patience, and everything that waits is rejected", async () => {
    const { clock, session } = newSession();
    const all = [outcome(session.send("SP,1")), outcome(session.query("QS"))];
    const faults: string[] = [];
    session.onFault((error) => faults.push(error.code));
    await clock.advance(1.4);
    expect(faults).toEqual([]);
    await clock.advance(0.2);
    expect(faults).toEqual(["board-timeout"]);
    expect(await Promise.all(all)).toEqual([
      expect.stringMatching(/^board-timeout: .*waiting on SP,1/),
      expect.stringMatching(/^board-timeout/),
    ]);
    expect(await outcome(session.send("SP,0"))).toMatch(/^board-timeout/);
  });

  it("is given the time that the motion before a command takes", async () => {
    const { clock, line, session } = newSession();
    const move = session.send("SM,5000,0,0", 5);
    await clock.advance(6);
    expect(session.failure).toBeNull();
    line.say("OK\r\n");
    await move;
  });

  it("is distinguished from a host that slept: replies that arrived meanwhile are read first", async () => {
    const { clock, line, session } = newSession();
    const move = session.send("SP,1");
    await clock.sleep(60);
    line.say("OK\r\n");
    await move;
    expect(session.failure).toBeNull();
  });

  describe.each([0, 0.3, 1.2, 1.45])("is distinguished from a host that is busy from %f s on", (fromS) => {
    it.each([0.05, 0.2, 1, 1.6, 3])(
      "reads the replies that arrived while the host was busy for %f s before it counts as silent",
      async (forS) => {
        const { clock, line, session } = newSession();
        const move = session.send("SP,1");
        await clock.advance(fromS);
        // As in an event loop, timers that are due come before the bytes that have arrived.
        await clock.sleep(forS);
        expect(session.failure).toBeNull();
        line.say("OK\r\n");
        await move;
      },
    );
  });

  it.each([0.3, 1, 10])("is detected by a host whose timers are all %f s late", async (lateS) => {
    const { clock, session } = newSession();
    const all = outcome(session.send("SP,1"));
    // A check counts at most 0.25 s, and the last one comes after 1.5 s.
    for (let checks = 0; checks < 7; checks++) await clock.sleep(0.25 + lateS);
    expect(await all).toMatch(/^board-timeout/);
  });

  it("rejects everything at once when the connection is lost", async () => {
    const { line, session } = newSession();
    const waiting = outcome(session.query("QS"));
    line.lose(new Error("gone"));
    expect(await waiting).toMatch(/^disconnected: .*USB cable/);
    expect(await outcome(session.query("QS"))).toMatch(/^disconnected/);
  });
});

describe("the log", () => {
  it("holds the communication, in order, and drops the oldest entries beyond its size", async () => {
    const clock = new ManualClock();
    const line = new ScriptedLine(() => "OK\r\n");
    const session = new BoardSession(line, { clock, logLines: 4 });
    for (const command of ["SP,1", "SP,0", "SP,1"]) await session.send(command);
    expect(session.log.text()).toBe("0.0000 > SP,0\n0.0000 < OK\n0.0000 > SP,1\n0.0000 < OK\n");
  });
});
