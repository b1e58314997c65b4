import { describe, expect, it } from "vitest";
import type { Job, JobPens } from "../../../src/schema/index.js";
import { rowsOf } from "../../../web/queue/copies.js";
import { queueAxis, type QueueAxis } from "../../../web/queue/queue-time.js";
import { makeJob } from "../../support/jobs/jobs-on-page.js";
import { makeJob as makeMeasuredJob } from "../../support/jobs/jobs.js";

const RED = { name: "Red", color: "#c8102e" };
const BLACK = { name: "Black", color: "#222222" };
const moonrise = makeJob("moonrise", { name: "Moonrise", expectedS: 3_600 });
const tide = makeJob("tide", { name: "Tide", expectedS: 600 });
const inState = (state: Job["state"], more: Partial<Job> = {}): Job =>
  makeJob("active", { state, expectedS: 900, remainingS: 300, ...more });
const withPens = (id: string, pens: JobPens, more: Partial<Job> = {}): Job => {
  const job = makeMeasuredJob(id, { name: id, expectedS: 100, ...more });
  return { ...job, stats: { ...job.stats!, durationS: 100, pens } };
};
/** As the panel shows it: from, to, whether they are certain, and what a person must do before. */
const shown = ({ rows }: QueueAxis) =>
  rows.map(({ fromS, toS, isStartSure, isEndSure, breaks }) => [
    fromS,
    toS,
    isStartSure,
    isEndSure,
    breaks.map(({ kind }) => kind).join(),
  ]);
const axisOf = (active: readonly Job[], waiting: readonly Job[], runsOn = true): QueueAxis =>
  queueAxis(active, rowsOf(waiting), { runsOn, seesAll: true });

describe("the axis of a queue", () => {
  it("begins now if nothing is plotted, and each plot begins where the one before ends", () => {
    const axis = axisOf([], [moonrise, tide]);
    expect(shown(axis)).toEqual([
      [0, 3_600, true, true, ""],
      [3_600, 4_200, true, true, ""],
    ]);
    expect(axis).toMatchObject({ totalS: 4_200, isTotalKnown: true, endS: 4_200, isEndSure: true });
  });

  it("begins at the end of the running plot", () => {
    const axis = axisOf([inState("plotting")], [moonrise]);
    expect(shown(axis)).toEqual([[300, 3_900, true, true, ""]]);
    expect(axis).toMatchObject({ totalS: 3_900, endS: 3_900, isEndSure: true });
  });

  it("has only earliest times after new paper, which a person must put in", () => {
    expect(shown(axisOf([], [moonrise, tide], false))).toEqual([
      [0, 3_600, true, true, ""],
      [3_600, 4_200, false, false, "paper"],
    ]);
    expect(shown(axisOf([inState("plotting")], [tide], false))).toEqual([[300, 900, false, false, "paper"]]);
  });

  it("has new paper between the sheets of a drawing that has several, also if the next plot starts by itself", () => {
    const { settings } = tide;
    const sheet = (id: string, tile: number): Job => ({
      ...makeJob(id, { name: id, expectedS: 600 }),
      settings: { ...settings, prepare: { ...settings.prepare, tileColumns: 2, tile } },
    });
    const [left, right] = [sheet("left", 1), sheet("right", 2)];
    expect(shown(axisOf([], [moonrise, left, right, tide]))).toEqual([
      [0, 3_600, true, true, ""],
      [3_600, 4_200, true, true, ""],
      [4_200, 4_800, false, false, "paper"],
      [4_800, 5_400, false, false, ""],
    ]);
    expect(shown(axisOf([], [left, { ...left, id: "copy" }]))).toEqual([[0, 1_200, true, false, ""]]);
  });

  it("counts copies together, and their papers", () => {
    const copies = [moonrise, { ...moonrise, id: "second" }];
    expect(shown(axisOf([], [...copies, tide], false))).toEqual([
      [0, 7_200, true, false, ""],
      [7_200, 7_800, false, false, "paper"],
    ]);
    expect(shown(axisOf([], [...copies, tide]))[0]).toEqual([0, 7_200, true, true, ""]);
  });

  it.each(["paused", "interrupted"] as const)("knows no time of day while a plot is %s", (state) => {
    const axis = axisOf([inState(state)], [moonrise, tide]);
    expect(shown(axis).map(([from, to]) => [from, to])).toEqual([
      [null, null],
      [null, null],
    ]);
    expect(axis).toMatchObject({ totalS: 4_500, endS: null });
  });

  it("knows nothing behind a plot that is still being planned, and says that the total is more", () => {
    const axis = axisOf([], [moonrise, makeJob("new"), tide]);
    expect(shown(axis).map(([from, to]) => [from, to])).toEqual([
      [0, 3_600],
      [3_600, null],
      [null, null],
    ]);
    expect(axis).toMatchObject({ totalS: 4_200, isTotalKnown: false, endS: null });
  });

  it("has only earliest times once a plot waits for a pen", () => {
    const stops = [{ ...RED, strokeIndex: 4, atS: 40 }];
    const twoPens = withPens("two pens", { first: BLACK, last: RED, stops });
    expect(shown(axisOf([], [twoPens, tide]))).toEqual([
      [0, 100, true, false, ""],
      [100, 700, false, false, ""],
    ]);
    // The running plot has passed its stop at 50 %, but not at 20 %.
    const at = (progress: number): Job => ({ ...twoPens, state: "plotting", progress, remainingS: 50 });
    expect(shown(axisOf([at(0.5)], [tide]))).toEqual([[50, 650, true, true, ""]]);
    expect(shown(axisOf([at(0.2)], [tide]))).toEqual([[50, 650, false, false, ""]]);
  });

  it("names the pen that a plot waits for, or begins with although nothing waits for it", () => {
    const black = withPens("black", { first: BLACK, last: BLACK, stops: [] });
    const red = withPens("red", { first: RED, last: RED, stops: [] });
    const asks = withPens("asks", { first: RED, last: RED, stops: [{ ...RED, strokeIndex: 0, atS: 0 }] });
    expect(axisOf([], [black, red]).rows[1].breaks).toEqual([{ kind: "pen", ...RED, isStop: false }]);
    expect(axisOf([], [black, red]).rows[1].isStartSure).toBe(true);
    expect(axisOf([], [black, asks]).rows[1].breaks).toEqual([{ kind: "pen", ...RED, isStop: true }]);
    expect(axisOf([], [black, asks]).rows[1].isStartSure).toBe(false);
    expect(axisOf([], [red, red]).rows[1]?.breaks ?? []).toEqual([]);
    // It is not known which pen is in the holder before the first plot.
    expect(axisOf([], [red]).rows[0].breaks).toEqual([]);
  });

  it("knows no time of day for a device that does not see the jobs of others", () => {
    const axis = queueAxis([], rowsOf([moonrise]), { runsOn: true, seesAll: false });
    expect(shown(axis).map(([from, to]) => [from, to])).toEqual([[null, null]]);
    expect(axis).toMatchObject({ totalS: 3_600, endS: null });
  });

  it("waits at the place where a plot was asked to start", () => {
    const placed = { ...tide, place: { strokeIndex: 3, alongMm: 0 } };
    expect(shown(axisOf([], [placed]))).toEqual([[0, 600, false, false, "place"]]);
  });
});
