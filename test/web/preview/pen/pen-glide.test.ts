/** The shown pen against the virtual board, and what the glide promises for any reports. */
import * as fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { ReportedProgress } from "../../../../host/plotter/plotter-port.js";
import { AHEAD_STEP_MS } from "../../../../src/internal.js";
import { PenGlide, type PenReport } from "../../../../web/preview/pen/pen-glide.js";
import { plotting, seeded, type LivePlot } from "../../../support/plots/live-plot.js";
import { cases } from "../../../support/runs/full-run.js";

const FRAME_MS = 1_000 / 60;
/** The host sends reports at most so often. */
const EVERY_MS = 100;

interface Sample {
  readonly atMs: number;
  readonly shown: { readonly xMm: number; readonly yMm: number; readonly planS: number | null };
  readonly board: { readonly xMm: number; readonly yMm: number; readonly penUp: boolean };
  readonly awayMm: number;
  /** Board's speed, mm/s. */
  readonly speedMmPerS: number;
}

/** A page that watches a plot over a connection whose messages take 1 to 6 ms. */
function watchPlot({ world, board, run }: LivePlot, seed = 1) {
  const glide = new PenGlide();
  const random = seeded(seed);
  let waiting: { report: ReportedProgress; sinceS: number } | null = null;
  let sentS = -Infinity;
  const send = (): void => {
    if (!waiting) return;
    const { report, sinceS } = waiting;
    waiting = null;
    sentS = world.nowS();
    const heldBackMs = 1_000 * (world.nowS() - sinceS);
    world.after(0.001 + 0.005 * random(), () =>
      glide.report({ ...report, heldBackMs }, 1_000 * world.nowS()),
    );
  };
  run.onProgress((report) => {
    if (!waiting) world.after(Math.max(0, sentS + EVERY_MS / 1_000 - world.nowS()), send);
    waiting = { report, sinceS: world.nowS() };
  });
  const samples: Sample[] = [];
  const frames = async (count: number, isOver = () => false): Promise<void> => {
    for (let i = 0; i < count && !isOver(); i++) {
      await world.advance(FRAME_MS / 1_000);
      const shown = glide.at(1_000 * world.nowS());
      if (!shown) continue;
      const at = board.state();
      const before = samples.at(-1)?.board ?? at;
      samples.push({
        atMs: 1_000 * world.nowS(),
        shown,
        board: at,
        awayMm: Math.hypot(shown.xMm - at.xMm, shown.yMm - at.yMm),
        speedMmPerS: (1_000 * Math.hypot(at.xMm - before.xMm, at.yMm - before.yMm)) / FRAME_MS,
      });
    }
  };
  return { glide, samples, frames };
}

const p95 = (values: readonly number[]): number =>
  [...values].sort((a, b) => a - b)[Math.floor(0.95 * values.length)];

/** mm by which the shown pen went against the board's motion, summed over all frames. */
function backwardMm(samples: readonly Sample[]): number {
  let sum = 0;
  for (let i = 2; i < samples.length; i++) {
    const [a, b, c] = [samples[i - 2], samples[i - 1], samples[i]];
    const [vx, vy] = [c.board.xMm - a.board.xMm, c.board.yMm - a.board.yMm];
    const length = Math.hypot(vx, vy);
    if (length < 0.05) continue;
    const along = ((c.shown.xMm - b.shown.xMm) * vx + (c.shown.yMm - b.shown.yMm) * vy) / length;
    sum += Math.max(0, -along - 0.02);
  }
  return sum;
}

describe("the gliding pen", { timeout: 60_000 }, () => {
  it.each(["junction", "scurve"] as const)(
    "is within 0.5 mm of the board while it draws, and within 10 ms of its motion on travel (%s)",
    async (mode) => {
      const plot = await plotting(mode);
      const { samples, frames } = watchPlot(plot);
      let isOver = false;
      void plot.run.finished.then(() => (isOver = true));
      await frames(6_000, () => isOver);
      const drawing = samples.filter(({ board }) => !board.penUp);
      const travel = samples.filter(({ board, speedMmPerS }) => board.penUp && speedMmPerS > 20);
      expect(drawing.length).toBeGreaterThan(100);
      expect(travel.length).toBeGreaterThan(20);
      expect(p95(drawing.map(({ awayMm }) => awayMm))).toBeLessThan(0.5);
      expect(p95(travel.map(({ awayMm, speedMmPerS }) => (1_000 * awayMm) / speedMmPerS))).toBeLessThan(10);
      expect(backwardMm(samples)).toBeLessThan(0.2);
    },
  );

  it("slows down, rests, and goes on with the board when the plot is paused, changed and resumed", async () => {
    const plot = await plotting("junction");
    const { glide, samples, frames } = watchPlot(plot);
    await frames(120);
    void plot.run.change({ speedPct: 40 });
    await frames(90);
    const paused = plot.run.pause();
    await frames(90);
    await paused;
    const at = plot.board.state();
    const shown = glide.at(1_000 * plot.world.nowS())!;
    expect(Math.hypot(shown.xMm - at.xMm, shown.yMm - at.yMm)).toBeLessThan(0.1);
    expect(shown).toMatchObject({ penDown: false, isMoving: false });
    void plot.run.resume();
    await frames(120);
    expect(Math.max(...samples.map(({ awayMm }) => awayMm))).toBeLessThan(1);
    expect(backwardMm(samples)).toBeLessThan(0.5);
  });

  it("comes to where the board is after an emergency stop, and does not jump", async () => {
    const plot = await plotting("junction");
    const { glide, samples, frames } = watchPlot(plot);
    await frames(140);
    let isStopped = false;
    void plot.run.emergencyStop().then(() => (isStopped = true));
    await frames(300, () => isStopped);
    expect(isStopped).toBe(true);
    const { xMm, yMm } = plot.board.state();
    glide.put({ xMm, yMm, penUp: true, penMoving: false }, 1_000 * plot.world.nowS());
    await frames(60);
    expect(samples.at(-1)!.awayMm).toBeLessThan(0.02);
    for (let i = 1; i < samples.length; i++) {
      const [{ shown: a }, { shown: b, board, speedMmPerS }] = [samples[i - 1], samples[i]];
      const limitMm = Math.max(board.penUp ? 6 : 2, 1.5 * speedMmPerS * (FRAME_MS / 1_000));
      expect(Math.hypot(b.xMm - a.xMm, b.yMm - a.yMm)).toBeLessThan(limitMm);
    }
  });

  it("rests at the end of what the machine was sent when no report comes any more", () => {
    const glide = new PenGlide();
    glide.report(lineReport(0, 100, 5), 3);
    expect(glide.at(3 + 2.5 * AHEAD_STEP_MS)).toMatchObject({ xMm: 5, isMoving: true });
    for (const laterMs of [5, 50, 5_000]) {
      expect(glide.at(3 + laterMs * AHEAD_STEP_MS)).toMatchObject({ xMm: 10, isMoving: false });
    }
    glide.forget();
    expect(glide.at(10_000)).toBeNull();
  });

  it("is shown where it is after the server was started again with another clock", () => {
    const glide = new PenGlide();
    for (let k = 0; k < 50; k++) glide.report(lineReport(100 * k, 100, 10), 100 * k + 3);
    glide.report(lineReport(0, 100, 10), 60_000);
    expect(glide.at(60_100)!.xMm).toBeCloseTo(10);
  });

  it("never goes backwards or jumps on a straight line, whatever the delays of the reports", () => {
    const delays = fc.array(fc.double({ min: 0, max: 60, noNaN: true }), { minLength: 5, maxLength: 40 });
    fc.assert(
      fc.property(delays, fc.integer({ min: 1, max: 300 }), (delaysMs, speedMmPerS) => {
        const glide = new PenGlide();
        const arrivals = delaysMs.map((delay, k) => ({ atMs: k * EVERY_MS, nowMs: k * EVERY_MS + delay }));
        let [xMm, planS] = [-1, -1];
        let next = 0;
        for (let nowMs = 0; nowMs < EVERY_MS * delaysMs.length; nowMs += FRAME_MS) {
          for (; next < arrivals.length && arrivals[next].nowMs <= nowMs; next++) {
            glide.report(lineReport(arrivals[next].atMs, speedMmPerS, 20), arrivals[next].nowMs);
          }
          const shown = glide.at(nowMs);
          if (!shown) continue;
          expect(shown.xMm).toBeGreaterThanOrEqual(xMm - 1e-9);
          expect(shown.planS).toBeGreaterThanOrEqual(planS);
          // Twice the motion of a frame: the second part is the correction of a delay that was too long.
          if (xMm >= 0) expect(shown.xMm - xMm).toBeLessThan((2.5 * speedMmPerS * FRAME_MS) / 1_000);
          [xMm, planS] = [shown.xMm, shown.planS!];
        }
      }),
      { numRuns: cases(1_000, 100) },
    );
  });
});

/** A report of a pen that draws along x, with `count` moments ahead. */
function lineReport(atMs: number, speedMmPerS: number, count: number): PenReport {
  const momentAt = (ms: number) => ({
    planS: ms / 1_000,
    xMm: (speedMmPerS * ms) / 1_000,
    yMm: 0,
    penUp: false,
    penMoving: false,
  });
  const ahead = Array.from({ length: count }, (_, k) => momentAt(atMs + (k + 1) * AHEAD_STEP_MS));
  return { ...momentAt(atMs), atMs, heldBackMs: 0, ahead };
}
