/** The library's short forms: from text, and from lines that a program has computed. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importSvg,
  machineById,
  plan,
  planJob,
  planSvg,
  prepare,
  strokesOf,
  trajectoryStats,
} from "../../../src/index.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";

const svg = (path: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60"><path d="${path}" stroke="#000"/></svg>`;
const SVG = svg("M10 30H90M20 10V50");

describe("without settings", () => {
  it("prepare and plan use the defaults", async () => {
    const drawing = await importSvg(SVG);
    expect(prepare(drawing)).toEqual(prepare(drawing, DEFAULT_PREPARE));
    const { strokes } = prepare(drawing);
    expect(plan(strokes).totalS).toBe(plan(strokes, DEFAULT_MOTION, DEFAULT_PEN).totalS);
  });

  it("planSvg gives the same plan as the single steps", async () => {
    const planned = await planSvg(SVG);
    const prepared = prepare(await importSvg(SVG), DEFAULT_PREPARE);
    const steps = planJob(prepared, DEFAULT_PLOT_SETTINGS, machineById("axidraw-v3"));
    expect(planned.commands()).toEqual(steps.commands());
    expect(planned.warnings).toEqual([]);
  });
});

describe("planSvg", () => {
  it("takes a job's whole settings, with a custom machine", async () => {
    const mine = { ...machineById("axidraw-v3"), id: "mine", widthMm: 20 };
    const settings = { ...DEFAULT_PLOT_SETTINGS, machine: "mine", customMachine: mine };
    await expect(planSvg(SVG, settings)).rejects.toThrow(
      expect.objectContaining({ code: "out-of-bounds" }) as Error,
    );
    const firmware = "3.0.3";
    expect((await planSvg(SVG, DEFAULT_PLOT_SETTINGS, { firmware })).commands().count).toBeGreaterThan(4);
  });

  it("reports that there is nothing to draw", async () => {
    await expect(planSvg(svg(""))).rejects.toThrow(expect.objectContaining({ code: "bad-file" }) as Error);
  });
});

describe("strokesOf", () => {
  it("keeps lines, their order, and dots", () => {
    const strokes = strokesOf([
      [
        [0, 0],
        [30, 40],
      ],
      [[5, 5]],
    ]);
    expect([...strokes.xy]).toEqual([0, 0, 30, 40, 5, 5]);
    expect([...strokes.offsets]).toEqual([0, 2, 3]);
    const stats = trajectoryStats(plan(strokes));
    expect([stats.drawMm, stats.penLiftCount]).toEqual([50, 2]);
    expect(strokesOf([]).offsets).toEqual(new Uint32Array(1));
  });

  it("names the line with the fault", () => {
    expect(() => strokesOf([[[0, 0]], []])).toThrow(/line 1 has no points/);
    expect(() => strokesOf([[[0, NaN]]])).toThrow(/line 0 has the point 0, NaN/);
  });
});
