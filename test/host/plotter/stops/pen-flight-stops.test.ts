/**
 * Holds and emergency stops while the pen moves in flight: the marks that they leave on the paper if the servo deviates
 * from the planner's assumptions.
 */
import { describe, expect, it } from "vitest";
import { asciiBytes } from "../../../../src/drivers/line-splitter.js";
import type { PenOverlap } from "../../../../src/internal.js";
import {
  flyingPlot,
  instant,
  marksOn,
  SERVOS,
  STATED_SERVO,
  virtualServo,
  type FlyingServo,
} from "../../../support/machines/flying-pens.js";
import { cases, IS_FULL } from "../../../support/runs/full-run.js";
import { seeded } from "../../../support/plots/live-plot.js";
import { ManualClock } from "../../../support/clocks/manual-clock.js";

/** Invisible, mm: a gap or a doubled stretch that a stop adds. */
const UNSEEN_MM = 0.05;
/** How far from a stroke there may be a mark, mm, and what rounding adds. */
const BESIDE_MM = { off: 0.05, safe: 0.15, fast: 0.15 };
/** Motion in flight when a hold is asked for. */
const WINDOW_S = 0.3;

const CASES: readonly (readonly [PenOverlap, string, readonly FlyingServo[]])[] = [
  ["safe", "2.8.1", SERVOS],
  ["safe", "3.0.3", SERVOS],
  ["fast", "2.8.1", SERVOS],
  ["fast", "3.0.3", SERVOS],
];
/** `npm test` has each overlap and each firmware once, the full run each with each. */
const TRIED = IS_FULL ? CASES : CASES.slice(1, 3);

/** Without a stop. */
async function undisturbed(overlap: PenOverlap, firmware: string, servo: FlyingServo) {
  const world = new ManualClock();
  const { board, run } = await flyingPlot(world, overlap, firmware, servo);
  await world.run(run.finished);
  return marksOn(board.drawn());
}

describe.each(TRIED)("a pen in flight, %s, on firmware %s", (overlap, firmware, servos) => {
  it.each([
    ["a hold", cases(50, 4), WINDOW_S],
    ["an emergency stop", cases(25, 4), 0],
  ] as const)(
    "%s at any instant of a pen's flight leaves no gap, no doubled stretch and no mark between strokes",
    async (what, count, leadS) => {
      const random = seeded(31 * (1 + CASES.findIndex(([a, b]) => a === overlap && b === firmware)) + leadS);
      const max = { gapMm: 0, overlapMm: 0, awayMm: 0 };
      for (const [index, servo] of servos.entries()) {
        const whole = await undisturbed(overlap, firmware, servo);
        for (let i = index; i < count; i += servos.length) {
          const world = new ManualClock();
          const { board, run, trajectory } = await flyingPlot(world, overlap, firmware, servo);
          await world.advance(Math.max(0, instant(trajectory, random) - leadS));
          await world.run(what === "a hold" ? run.pause() : run.emergencyStop());
          expect(board.state()).toMatchObject({ penUp: true, isBusy: false });
          await world.advance(0.2);
          expect(board.state().penPct).toBe(60);
          await world.run(run.resume());
          expect(await world.run(run.finished)).toEqual({ kind: "done" });
          expect(board.state()).toMatchObject({ steps1: 0, steps2: 0, penUp: true });
          const { gapMm, overlapMm, awayMm } = marksOn(board.drawn());
          max.gapMm = Math.max(max.gapMm, gapMm - whole.gapMm);
          max.overlapMm = Math.max(max.overlapMm, overlapMm - whole.overlapMm);
          max.awayMm = Math.max(max.awayMm, awayMm);
        }
      }
      if (count > 10) console.info(overlap, firmware, what, max);
      expect(max.gapMm).toBeLessThan(UNSEEN_MM);
      expect(max.overlapMm).toBeLessThan(UNSEEN_MM);
      expect(max.awayMm).toBeLessThan(BESIDE_MM[overlap] + UNSEEN_MM / 2);
    },
  );
});

describe.each(CASES)("an unplugged cable during %s on firmware %s", (overlap, firmware, servos) => {
  it("leaves no mark beside a stroke, at any instant", async () => {
    const away: [unpluggedS: number, awayMm: number][] = [];
    for (let afterS = 1; afterS < 5; afterS += IS_FULL ? 0.01 : 0.05) {
      const world = new ManualClock();
      const { board, run } = await flyingPlot(world, overlap, firmware, servos[away.length % servos.length]);
      run.finished.catch(() => undefined);
      await world.advance(afterS);
      board.unplug();
      // It performs what it has read. Then the pen is lifted, so that the board records where it was down.
      await world.advance(1);
      board.receive(asciiBytes("SP,1,0\r"));
      await world.advance(1);
      away.push([afterS, marksOn(board.drawn()).awayMm]);
    }
    expect(away.length).toBeGreaterThan(75);
    expect(away.filter(([, awayMm]) => awayMm > BESIDE_MM[overlap])).toEqual([]);
  });
});

it("an emergency stop lifts the pen itself, before anything is asked of the board", async () => {
  const world = new ManualClock();
  const { run, machine } = await flyingPlot(world, "fast", "3.0.3", STATED_SERVO);
  await world.advance(3);
  await world.run(run.emergencyStop());
  const sent = machine
    .log()
    .split("\n")
    .flatMap((line) => line.split(" > ")[1] ?? []);
  const stop = sent.lastIndexOf("ES");
  expect(sent.slice(stop - 1, stop + 2)).toEqual(["QU,6", "ES", "SP,1,0"]);
});

it.each((["safe", "fast"] as const).flatMap((overlap) => SERVOS.map((servo) => [overlap, servo] as const)))(
  "a pen is never reported as down while its tip is not on the paper, nor as up while it is: %s, %o",
  async (overlap, servo) => {
    const world = new ManualClock();
    const { board, run, reports } = await flyingPlot(world, overlap, "3.0.3", servo);
    const { contactPct = 0 } = virtualServo(servo);
    const seen = new Set<string>();
    const wrong: unknown[] = [];
    run.onProgress(({ penUp, penMoving, planS }) => {
      const touches = board.state().penPct <= contactPct;
      seen.add(`${penMoving ? "going " : ""}${penUp ? "up" : "down"}`);
      if (!penMoving && touches === penUp) wrong.push({ planS, penUp, penPct: board.state().penPct });
    });
    await world.advance(4);
    await world.run(run.pause());
    await world.run(run.resume());
    expect(await world.run(run.finished)).toEqual({ kind: "done" });
    expect(wrong).toEqual([]);
    expect([...seen].sort()).toEqual(["down", "going down", "going up", "up"]);
    expect(reports.length).toBeGreaterThan(100);
  },
);
