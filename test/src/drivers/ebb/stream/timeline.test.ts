import { describe, expect, it } from "vitest";
import { BoardTimeline } from "../../../../../src/drivers/ebb/stream/timeline.js";
import { makeStream, wavyRows } from "../../../../support/drawings/make-stream.js";
import { ManualClock } from "../../../../support/clocks/manual-clock.js";

/** A board with a queue of one that received that many commands; it has acknowledged some of them. */
async function given(durationsS: readonly number[], ackedCount: number, queueDepth = 1) {
  const clock = new ManualClock();
  const timeline = new BoardTimeline(clock, queueDepth, 2);
  const stream = makeStream(wavyRows(durationsS.length, 20));
  let startS = 0;
  for (const [i, durationS] of durationsS.entries()) {
    timeline.written(stream, i, startS, (startS += durationS));
  }
  for (let i = 0; i < ackedCount; i++) {
    // Each is acknowledged when the one before it has begun.
    if (i > queueDepth) await clock.advance(durationsS[i - queueDepth - 1]);
    timeline.acknowledged();
  }
  return { clock, timeline };
}

/** What the streamer does every few ms. */
async function pump(clock: ManualClock, timeline: BoardTimeline, forS: number): Promise<void> {
  for (let s = 0; s < forS; s += 0.004) {
    await clock.advance(0.004);
    timeline.forgetExecuted(timeline.boardS());
  }
}

describe("a board that stops answering", () => {
  it.each([
    ["short", 0.02],
    ["long", 0.12],
  ])("is never estimated to be further than its acknowledgements: %s commands", async (_, durationS) => {
    const { clock, timeline } = await given(Array<number>(12).fill(durationS), 4);
    await pump(clock, timeline, 2);
    expect(timeline.boardS()).toBeLessThanOrEqual(4 * durationS + 1e-9);
  });

  it("is never estimated to be further with a deep queue either", async () => {
    const { clock, timeline } = await given(Array<number>(12).fill(0.02), 3, 32);
    await pump(clock, timeline, 2);
    expect(timeline.boardS()).toBeLessThanOrEqual(0.06 + 1e-9);
  });

  it("is estimated to play everything that it has acknowledged", async () => {
    const { clock, timeline } = await given(Array<number>(4).fill(0.02), 4);
    await pump(clock, timeline, 2);
    expect(timeline.boardS()).toBeCloseTo(0.08);
  });
});

describe("a reply about waiting commands that is read late", () => {
  it("does not move the board's time back", async () => {
    const { clock, timeline } = await given(Array<number>(30).fill(0.02), 30, 32);
    await clock.advance(0.11);
    const askedS = clock.nowS();
    // The board answers while the sixth command runs. The host is busy meanwhile.
    await clock.advance(0.3);
    timeline.waiting(24, askedS);
    expect(timeline.boardS()).toBeCloseTo(0.41);
  });
});

describe("one miscounted acknowledgement", () => {
  it("moves the board's time by no more than a few ms", async () => {
    const durationS = 0.15;
    const { clock, timeline } = await given(Array<number>(10).fill(durationS), 2);
    await clock.advance(durationS);
    const beforeS = timeline.boardS();
    timeline.acknowledged();
    // A stray OK: as if the next one had already begun.
    timeline.acknowledged();
    expect(timeline.boardS() - beforeS).toBeLessThan(0.01);
    await clock.advance(durationS);
    expect(timeline.boardS()).toBeGreaterThan(2 * durationS - 0.01);
    // None for two commands, then one: it belonged to the second.
    const { clock: late, timeline: behind } = await given(Array<number>(10).fill(durationS), 2);
    await late.advance(3 * durationS);
    behind.acknowledged();
    behind.acknowledged();
    behind.acknowledged();
    expect(behind.boardS()).toBeGreaterThan(3 * durationS - 0.01);
  });
});
