import { describe, expect, it } from "vitest";
import {
  BoardSession,
  compile,
  DEFAULT_MOTION,
  DEFAULT_PEN,
  machineById,
  plan,
  streamCommands,
  VirtualBoard,
  type CommandStream,
  type PlotwrightError,
} from "../../../../../src/index.js";
import { Streamer, type StreamProgress, type StreamOptions } from "../../../../../src/internal.js";
import { strokeSetOf, type Point } from "../../../../support/drawings/arbitraries.js";
import { makeStream, wavyRows, type StreamRow } from "../../../../support/drawings/make-stream.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";
import { StallingHost } from "../../../../support/clocks/stalling-host.js";
import { outcome } from "../../../../support/plots/virtual-plotter.js";

const PEN_UP: StreamRow = { line: "SP,1,200", durationS: 0.2 };
const PEN_DOWN: StreamRow = { line: "SP,0,200", durationS: 0.2 };
const DEEP = { queueDepth: 32, poll: { lines: ["QU,6"], everyS: 0.25 } };
const SHALLOW = { poll: { lines: ["QG"], everyS: 0.25 } };

interface Rig {
  readonly world: ManualClock;
  readonly host: StallingHost;
  readonly board: VirtualBoard;
  readonly session: BoardSession;
}

async function newRig(
  firmware = "2.8.1",
  options: { speed?: number; answerDelayS?: number } = {},
): Promise<Rig> {
  const world = new ManualClock();
  const host = new StallingHost(world);
  const board = new VirtualBoard({ clock: world, firmware, speed: options.speed ?? 1 });
  const transport = host.transport(board.transport(), options.answerDelayS ?? 0.001);
  const session = new BoardSession(transport, { clock: host.clock });
  await world.run(session.identify());
  await world.run(session.send("EM,1,1"));
  return { world, host, board, session };
}

async function play(rig: Rig, stream: CommandStream, options: Partial<StreamOptions> = {}) {
  if ((options.queueDepth ?? 1) > 1) await rig.world.run(rig.session.send(`CU,4,${options.queueDepth}`));
  const streamer = new Streamer(rig.session, { clock: rig.host.clock, ...options });
  const report = await rig.world.run(streamer.play(stream));
  return { streamer, report };
}

describe("a stream on a healthy host", () => {
  it.each([
    ["2.4.4", { poll: { lines: ["QM"], everyS: 0.25 } }],
    ["2.8.1", SHALLOW],
    ["3.0.3", DEEP],
  ])("ends where predicted, without a gap, on firmware %s", async (firmware, options) => {
    const rig = await newRig(firmware);
    const rows = [PEN_DOWN, ...wavyRows(400, 20), PEN_UP, ...wavyRows(50, 40, 1)];
    const { streamer, report } = await play(rig, makeStream(rows), options);
    expect(report).toMatchObject({ exact: true, complete: true });
    expect(streamer.underrunCount).toBe(0);
    expect(rig.board.statistics().underrunCount).toBe(0);
  });

  it("never has more in flight than the window and one command", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    let mostS = 0;
    const watch = (): void => {
      mostS = Math.max(mostS, streamer.inFlightS());
      rig.world.after(0.01, watch);
    };
    watch();
    await rig.world.run(streamer.play(makeStream(wavyRows(300, 30))));
    expect(mostS).toBeLessThanOrEqual(0.33);
    expect(mostS).toBeGreaterThan(0.25);
  });

  it("sends more ahead only while the clock's timers may be late", async () => {
    const rig = await newRig();
    let latenessS = 0;
    const clock = {
      nowS: () => rig.world.nowS(),
      after: (delayS: number, callback: () => void) => rig.world.after(delayS, callback),
      latenessS: () => latenessS,
    };
    const streamer = new Streamer(rig.session, { clock, ...SHALLOW });
    const played = streamer.play(makeStream(wavyRows(300, 30)));
    await rig.world.advance(1);
    expect(streamer.inFlightS()).toBeLessThanOrEqual(0.33);
    latenessS = 0.7;
    await rig.world.advance(1);
    expect(streamer.inFlightS()).toBeGreaterThan(0.95);
    latenessS = 0;
    await rig.world.advance(1);
    expect(streamer.inFlightS()).toBeLessThanOrEqual(0.33);
    await rig.world.run(played);
    expect(streamer.underrunCount).toBe(0);
  });

  it("leaves room in a deep queue, so that a stop is read at once", async () => {
    const rig = await newRig("3.0.3");
    await rig.world.run(rig.session.send("CU,4,32"));
    const streamer = new Streamer(rig.session, { clock: rig.world, ...DEEP });
    const played = outcome(streamer.play(makeStream(wavyRows(2_000, 4))));
    await rig.world.advance(1.5);
    const stopped = rig.session.query("ES");
    expect(await rig.world.run(stopped, 0.01)).toBe("1");
    streamer.abandon(rig.session.failure ?? ({ code: "cancelled", message: "" } as PlotwrightError));
    await played;
  });

  it("sends no more queries after its end, and leaves no timer, wherever the last query was", async () => {
    for (let count = 20; count < 60; count++) {
      const rig = await newRig("2.8.1", { answerDelayS: 0.02 });
      await play(rig, makeStream(wavyRows(count, 20)), SHALLOW);
      const said = rig.session.log.text();
      await rig.world.advance(2);
      expect(rig.session.log.text()).toBe(said);
      expect(rig.world.timerCount).toBe(0);
    }
  });

  it("reports a position that keeps up with the pen", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    const played = streamer.play(makeStream(wavyRows(200, 25)));
    await rig.world.advance(2);
    // 2 s in: a millisecond or two for the connection.
    expect(streamer.position().planS).toBeCloseTo(2, 2);
    expect(streamer.position().commandIndex).toBe(79);
    await rig.world.run(played);
    expect(rig.board.state().boardS).toBeGreaterThan(5);
  });
});

describe("a host that stops for 150 ms every second", () => {
  const rows = [PEN_DOWN, ...wavyRows(2_000, 15)];

  it.each([
    ["2.8.1", SHALLOW],
    ["3.0.3", DEEP],
  ])("never lets the board run dry on firmware %s", async (firmware, options) => {
    const rig = await newRig(firmware);
    const stopStalling = rig.host.stallRegularly(1, 0.15);
    const { streamer, report } = await play(rig, makeStream(rows), options);
    stopStalling();
    expect(report.exact).toBe(true);
    expect(rig.board.statistics().underrunCount).toBe(0);
    expect(streamer.underrunCount).toBe(0);
  });

  it.each([
    ["2.8.1", SHALLOW],
    ["3.0.3", DEEP],
  ])(
    "never lets the board run dry between the longest commands on firmware %s",
    async (firmware, options) => {
      const rig = await newRig(firmware);
      const stopStalling = rig.host.stallRegularly(0.97, 0.17);
      const { report } = await play(rig, makeStream([PEN_DOWN, ...wavyRows(200, 148)]), options);
      stopStalling();
      expect(report.exact).toBe(true);
      expect(rig.board.statistics().underrunCount).toBe(0);
    },
  );

  it("never lets the board run dry between the slices of 10 ms that firmware 2.4.4 gets", async () => {
    const loops = Array.from({ length: 900 }, (_, i): Point => [
      30 + i / 12 + 2 * Math.cos(i / 5),
      40 + 2 * Math.sin(i / 5),
    ]);
    const trajectory = plan(strokeSetOf([loops]), DEFAULT_MOTION, DEFAULT_PEN);
    const stream = compile(trajectory, {
      machine: machineById("axidraw-v3"),
      firmware: "2.4.4",
      pen: DEFAULT_PEN,
    });
    const rig = await newRig("2.4.4");
    const stopStalling = rig.host.stallRegularly(1, 0.15);
    const { streamer, report } = await play(rig, stream, { poll: { lines: ["QM"], everyS: 0.25 } });
    stopStalling();
    expect(stream.count / trajectory.totalS).toBeGreaterThan(90);
    expect(report.exact).toBe(true);
    expect(rig.board.statistics().underrunCount).toBe(0);
    expect(streamer.underrunCount).toBe(0);
  });

  it("has underruns if it waits for acknowledgements instead, and counts them", async () => {
    const rig = await newRig();
    const stopStalling = rig.host.stallRegularly(1, 0.15);
    const { streamer, report } = await play(rig, makeStream(rows), { pacing: "acks" });
    stopStalling();
    expect(report.exact).toBe(true);
    const { underrunCount } = rig.board.statistics();
    expect(underrunCount).toBeGreaterThan(20);
    expect(streamer.underrunCount).toBeGreaterThan(20);
  });
});

describe("a board whose clock differs from the host's", () => {
  it.each([
    ["slower by 0.2 %, queue of 1", "2.8.1", SHALLOW, 0.998],
    ["faster by 0.2 %, queue of 1", "2.8.1", SHALLOW, 1.002],
    ["slower by 0.2 %, deep queue", "3.0.3", DEEP, 0.998],
    ["faster by 0.2 %, deep queue", "3.0.3", DEEP, 1.002],
  ])("is tracked for minutes: %s", async (_, firmware, options, speed) => {
    const rig = await newRig(firmware, { speed });
    // Mostly long commands: with two of them in flight, the acknowledgements alone give no information.
    const { report, streamer } = await play(rig, makeStream(wavyRows(1_000, 200)), options);
    expect(report.exact).toBe(true);
    expect(rig.board.statistics().underrunCount).toBe(0);
    expect(streamer.underrunCount).toBe(0);
  });
});

describe("cutting and replacing", () => {
  it("ends early at a cut, and reports the board's position", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    const played = streamer.play(makeStream(wavyRows(500, 20)));
    await rig.world.advance(1);
    const cut = streamer.cut();
    const report = await rig.world.run(played);
    expect(report).toMatchObject({
      complete: false,
      exact: true,
      end: { commandIndex: cut.commandIndex - 1 },
    });
    expect(cut.planS).toBeGreaterThan(1.2);
    expect(cut.planS).toBeLessThan(1.35);
  });

  it("switches to another stream without a gap", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    const first = makeStream(wavyRows(500, 20));
    const played = streamer.play(first);
    await rig.world.advance(1);
    const { commandIndex } = streamer.cut();
    const from = [first.steps1[commandIndex - 1], first.steps2[commandIndex - 1]] as const;
    expect(streamer.replace(makeStream(wavyRows(20, 30), from))).toBe(true);
    const report = await rig.world.run(played);
    expect(report).toMatchObject({ complete: true, exact: true });
    expect(rig.board.statistics().underrunCount).toBe(0);
  });

  it("switches at a command that is still to come, and refuses one that was sent", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    const first = makeStream(wavyRows(500, 20));
    const played = streamer.play(first);
    await rig.world.advance(1);
    expect(streamer.cutAt(3, makeStream([PEN_UP]))).toBe(false);
    const from = [first.steps1[299], first.steps2[299]] as const;
    expect(streamer.cutAt(300, makeStream([PEN_UP], from))).toBe(true);
    const report = await rig.world.run(played);
    expect(report).toMatchObject({ complete: true, exact: true, end: { commandIndex: 0 } });
    expect(rig.board.statistics().underrunCount).toBe(0);
  });

  it("reports the fraction done and the time left while it plays", async () => {
    const rig = await newRig();
    const stream = makeStream(wavyRows(100, 20));
    const seen: StreamProgress[] = [];
    const onProgress = (progress: StreamProgress): unknown => seen.push(progress);
    await rig.world.run(streamCommands(rig.session, stream, { clock: rig.world, onProgress }));
    const totalS = stream.planS[stream.count];
    for (const { fraction, leftS, planS } of seen) {
      expect(fraction).toBeCloseTo(planS / totalS, 9);
      expect(leftS).toBeCloseTo(totalS - planS, 9);
    }
    expect(seen[0].fraction).toBeLessThan(0.1);
    expect(seen.at(-1)).toMatchObject({ fraction: 1, leftS: 0 });
  });

  it("stops at a cancellation, with the board at rest and its position known", async () => {
    const rig = await newRig();
    const cancel = { aborted: false };
    const seen: number[] = [];
    const played = streamCommands(rig.session, makeStream(wavyRows(500, 20)), {
      clock: rig.world,
      cancel,
      onProgress: (place) => seen.push(place.planS),
    });
    rig.world.after(2, () => (cancel.aborted = true));
    const report = await rig.world.run(played);
    expect(report).toMatchObject({ complete: false, exact: true });
    expect(seen.length).toBeGreaterThan(20);
    expect(seen.every((planS, i) => i === 0 || planS >= seen[i - 1])).toBe(true);
  });
});

describe("streamCommands on a board's own clock", () => {
  it("takes the board's time on a fast board, and no time on one of infinite speed", async () => {
    const stream = makeStream(wavyRows(500, 20));
    const playedAt = async (speed: number): Promise<number> => {
      const world = new ManualClock();
      const board = new VirtualBoard({ clock: world, speed });
      const session = new BoardSession(board.transport(), { clock: world });
      await world.run(session.identify());
      await world.run(session.send("EM,1,1"));
      const startS = world.nowS();
      const report = await world.run(streamCommands(session, stream, { clock: board.clock }));
      expect(report).toMatchObject({ complete: true, exact: true, underrunCount: 0 });
      return world.nowS() - startS;
    };
    expect(await playedAt(50)).toBeCloseTo(stream.planS[stream.count] / 50, 1);
    expect(await playedAt(Infinity)).toBe(0);
  });
});

describe("a stream that sends no command", () => {
  it("reports its progress and the board's position if it has no command", async () => {
    const rig = await newRig();
    const seen: StreamProgress[] = [];
    const onProgress = (progress: StreamProgress): unknown => seen.push(progress);
    const played = streamCommands(rig.session, makeStream([]), { clock: rig.world, onProgress });
    expect(await rig.world.run(played)).toMatchObject({ complete: true, exact: true, steps1: 0, steps2: 0 });
    expect(seen.at(-1)).toMatchObject({ fraction: 1, leftS: 0 });
  });

  it("leaves the board alone if it is cancelled before it begins", async () => {
    const rig = await newRig();
    const said = rig.session.log.text();
    const cancel = { aborted: true };
    const played = streamCommands(rig.session, makeStream(wavyRows(100, 20)), { clock: rig.world, cancel });
    expect(await rig.world.run(played)).toMatchObject({ complete: false, end: { commandIndex: -1 } });
    await rig.world.advance(1);
    expect(rig.session.log.text()).toBe(said);
  });
});

describe("a board that fails in mid-stream", () => {
  it("names the command that it refused", async () => {
    const rig = await newRig();
    const rows = [...wavyRows(20, 20), { line: "SM,0,1,1", durationS: 0.02, steps: [1, 1] as const, run: 0 }];
    const refused = outcome(play(rig, makeStream([...rows, ...wavyRows(20, 20)]), SHALLOW));
    expect(await refused).toMatch(/^board-error: The board refused SM,0,1,1/);
  });

  it("is detected as silent within 3 s", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    const played = outcome(streamer.play(makeStream(wavyRows(500, 20))));
    await rig.world.advance(1);
    rig.board.setMute(true);
    expect(await rig.world.run(played, 3)).toMatch(/^board-timeout/);
  });

  it("is detected as gone at once", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    const played = outcome(streamer.play(makeStream(wavyRows(500, 20))));
    await rig.world.advance(1);
    rig.board.unplug();
    expect(await rig.world.run(played, 0.1)).toMatch(/^disconnected/);
  });

  it("tolerates lost replies, and counts them", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    const played = streamer.play(makeStream(wavyRows(500, 20)));
    await rig.world.advance(1);
    rig.board.loseReplies(2);
    const report = await rig.world.run(played);
    expect(report.exact).toBe(true);
    expect(rig.session.lostReplyCount).toBeGreaterThanOrEqual(1);
    expect(rig.board.statistics().underrunCount).toBe(0);
  });

  it("is detected by its counters if it moved differently from its commands", async () => {
    const rig = await newRig();
    const streamer = new Streamer(rig.session, { clock: rig.world, ...SHALLOW });
    const played = streamer.play(makeStream(wavyRows(100, 20)));
    await rig.world.advance(1);
    rig.session.write([{ line: "CS" }]);
    expect(await rig.world.run(played)).toMatchObject({ complete: true, exact: false });
  });
});
