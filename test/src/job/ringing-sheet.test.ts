/** The ringing sheet, read off a simulated pen as a person would read it off the paper. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_PREPARE,
  importSvg,
  machineById,
  planJob,
  prepare,
  DEFAULT_PEN,
} from "../../../src/index.js";
import {
  frequencyOfRipples,
  ringingChecks,
  RINGING_MOTION,
  RINGING_SPEEDS,
  ringingSheet,
} from "../../../src/job/ringing-sheet.js";
import { swingPen } from "../../../src/plan/simulate/spring-pen.js";

describe("the ringing sheet", async () => {
  const springs = { xHz: 14, yHz: 23, damping: 0.05 };
  const machine = { ...machineById("axidraw-v3"), springs };
  const prepared = prepare(await importSvg(ringingSheet()), {
    ...DEFAULT_PREPARE,
    fit: false,
    order: "none",
  });
  const { trajectory } = planJob(prepared, { motion: RINGING_MOTION, pen: DEFAULT_PEN }, machine);

  it("draws each figure at its speed", () => {
    const { runs, vx, vy } = trajectory;
    const speeds = Array.from(runs.stroke, (stroke, run) => {
      let top = 0;
      for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++)
        top = Math.max(top, Math.hypot(vx[k], vy[k]));
      return stroke < 0 ? [] : [top];
    }).flat();
    expect(speeds.length).toBe(3);
    speeds.forEach((speed, i) => expect(speed).toBeCloseTo(RINGING_SPEEDS[i], 1));
  });

  it("shows the frequency of x on vertical lines and that of y on horizontal ones", () => {
    const { xy, offsets } = prepared.strokes;
    for (let stroke = 0; stroke < 3; stroke++) {
      // The first corners: down, right, down. A side is 25 mm long.
      const corners = [1, 2].map((i) => ({
        x: xy[2 * (offsets[stroke] + i)],
        y: xy[2 * (offsets[stroke] + i) + 1],
      }));
      // Where the pen passes the line from one side to the other, mm along the line.
      const passes: [number[], number[]] = [[], []];
      let last: [number, number] | null = null;
      swingPen(trajectory, springs, 2e-4, (pen) => {
        if (pen.stroke !== stroke) return;
        const side: 0 | 1 = pen.alongMm > 29 && pen.alongMm < 46 ? 0 : 1;
        const isOn = side === 0 || (pen.alongMm > 54 && pen.alongMm < 71);
        if (!isOn) return void (last = null);
        const off = side === 0 ? pen.y - corners[0].y : pen.x - corners[1].x;
        const at = side === 0 ? pen.x : pen.y;
        if (last !== null && last[0] * off < 0) passes[side].push(at);
        last = [off, at];
      });
      const hzOf = (places: readonly number[]): number =>
        frequencyOfRipples(
          RINGING_SPEEDS[stroke],
          (places.length - 1) / 2,
          Math.abs(places[places.length - 1] - places[0]),
        );
      expect(hzOf(passes[0]) / springs.yHz).toBeCloseTo(1, 1);
      expect(hzOf(passes[1]) / springs.xHz).toBeCloseTo(1, 1);
    }
  });

  it("refuses a count of ripples that no machine can have", () => {
    expect(frequencyOfRipples(30, 5, 10)).toBe(15);
    expect(() => frequencyOfRipples(30, 500, 10)).toThrow(/1500 Hz.*2 to 200 Hz/);
  });

  it("has a second sheet with a figure without shaping and one for each of five factors", async () => {
    const checks = ringingChecks(springs);
    expect(checks.map(({ factor }) => factor)).toEqual([null, 0.8, 0.9, 1, 1.1, 1.25]);
    expect(checks[1].springs?.xHz).toBeCloseTo(11.2, 9);
    expect((await importSvg(checks[0].svg)).warnings).toEqual([]);
  });
});
