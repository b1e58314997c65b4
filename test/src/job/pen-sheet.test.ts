/** The pen sheet, drawn by a simulated servo and read as a person would read it off the paper. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importSvg,
  machineById,
  planJob,
  prepare,
} from "../../../src/index.js";
import {
  PEN_SHEET_HEIGHT_MM,
  PEN_SHEET_MOTION,
  PEN_SHEET_WAITS_MS,
  PEN_SHEET_WIDTH_MM,
  penOfSheet,
  penSheet,
} from "../../../src/internal.js";
import { streamOf } from "../../../src/drivers/ebb/compile/command-stream.js";
import { penMovesOf } from "../../../src/plan/pen/pen-moves.js";
import { liftTime, timedPen } from "../../../src/plan/pen/pen-times.js";
import { tipMarks } from "../../support/drawings/tip-marks.js";

const machine = machineById("axidraw-v3");
const pen = penOfSheet(DEFAULT_PEN);
const prepared = prepare(await importSvg(penSheet()), { ...DEFAULT_PREPARE, fit: false, order: "none" });

describe("the pen sheet", () => {
  it("has one line for each wait, below its number, on a page of the stated size", () => {
    const { strokes, size } = prepared;
    const lines = PEN_SHEET_WAITS_MS.length;
    const counts = strokes.layers.map((_, layer) => strokes.layer.filter((one) => one === layer).length);
    expect(counts.slice(1)).toEqual(Array.from({ length: lines }, () => 12));
    expect(counts[0]).toBeGreaterThan(lines);
    expect(size.widthMm).toBeLessThanOrEqual(PEN_SHEET_WIDTH_MM);
    expect(size.heightMm).toBeLessThanOrEqual(PEN_SHEET_HEIGHT_MM);
  });

  it("waits in each line as long as its number says, and for the numbers longest", () => {
    const { trajectory } = planJob(prepared, { motion: PEN_SHEET_MOTION, pen }, machine);
    const lifts = penMovesOf(trajectory).filter(({ up }) => up);
    const usualMs = 1_000 * liftTime(timedPen(DEFAULT_PEN, machine), DEFAULT_PEN.upPct);
    for (const [i, waitMs] of PEN_SHEET_WAITS_MS.entries()) {
      const last = lifts[lifts.length - 1 - 12 * (PEN_SHEET_WAITS_MS.length - 1 - i)];
      expect(1_000 * last.waitS).toBeCloseTo(Math.ceil(usualMs + waitMs), 6);
    }
    expect(1_000 * lifts[0].waitS).toBeCloseTo(Math.ceil(usualMs + PEN_SHEET_WAITS_MS[0]), 6);
  });

  it("shows which waits are right: the first lines have neither tails nor late starts, the last ones have", () => {
    const marksOf = (waitMs: number) => {
      const own = { ...pen, extraLiftMs: waitMs, extraDropMs: waitMs, layers: {} };
      const job = planJob(prepared, { motion: PEN_SHEET_MOTION, pen: own }, machine, { firmware: "3.0.3" });
      const stream = streamOf(job.commands());
      // A servo that takes 60 ms longer than an AxiDraw's.
      return tipMarks(
        job.trajectory,
        stream,
        machine,
        { ...own, extraLiftMs: 0, extraDropMs: 0 },
        { speed: 0.6, phaseMs: 23, contact: 0.5 },
      );
    };
    const isRight = (waitMs: number): boolean => {
      const { strayMm, lateMm, brokenCount } = marksOf(waitMs);
      return strayMm < 0.15 && lateMm < 0.15 && brokenCount === 0;
    };
    const right = PEN_SHEET_WAITS_MS.filter((_, i) => i % 2 === 0).map(isRight);
    expect(right[0]).toBe(true);
    expect(right.at(-1)).toBe(false);
    // Once a line is wrong, so are all below it.
    expect(right).toEqual([...right].sort((a, b) => Number(b) - Number(a)));
  });
});
