/** The jobs of the ringing sheets, storing the measured springs, and the gain. */
import { describe, expect, it } from "vitest";
import { importSvg, machineById, MACHINES, planJob, prepare } from "../../../src/index.js";
import { boxOfPoints, machineOf, penError, prepareSettingsOf, type Springs } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, newJobSchema, type PlotSettings } from "../../../src/schema/index.js";
import { frequencyOf } from "../../../web/ringing/count-axis.js";
import { measuredMachine } from "../../../web/ringing/use-store-springs.js";
import { gainsOf } from "../../../web/ringing/ringing-gain.js";
import { checkJobs, sheetJob, type SheetJob } from "../../../web/ringing/ringing-job.js";

const SPRINGS: Springs = { xHz: 15, yHz: 25, damping: 0.05 };
const strokesOf = async ({ drawing, settings }: SheetJob) =>
  prepare(await importSvg(drawing), prepareSettingsOf(settings));
const on = (machine: string, paper: PlotSettings["prepare"]["paper"]): PlotSettings => ({
  ...DEFAULT_PLOT_SETTINGS,
  machine,
  prepare: { ...DEFAULT_PLOT_SETTINGS.prepare, paper },
});
const A4 = { widthMm: 297, heightMm: 210 };

describe("the first sheet", () => {
  it("is one job at true size, centred on the paper and within the reach of every machine with room for it", async () => {
    let count = 0;
    for (const { id, widthMm, heightMm } of MACHINES) {
      const job = sheetJob(on(id, A4), "sheet");
      if (job === null) continue;
      count++;
      expect(newJobSchema.safeParse(job).success).toBe(true);
      const { strokes, warnings } = await strokesOf(job);
      expect(warnings).toEqual([]);
      const { x0, y0, x1, y1 } = boxOfPoints(strokes.xy);
      expect([x1 - x0, y1 - y0]).toEqual([expect.closeTo(99, 6), expect.closeTo(99, 6)]);
      expect(Math.min(x0, y0)).toBeGreaterThanOrEqual(0);
      expect(x1).toBeLessThanOrEqual(Math.min(widthMm, A4.widthMm));
      expect(y1).toBeLessThanOrEqual(Math.min(heightMm, A4.heightMm));
    }
    expect(count).toBeGreaterThan(8);
  });

  it("has no lines that overlap", async () => {
    const { xy, offsets } = (await strokesOf(sheetJob(DEFAULT_PLOT_SETTINGS, "sheet")!)).strokes;
    const seen = new Set<string>();
    for (let stroke = 0; stroke + 1 < offsets.length; stroke++) {
      const columns = new Set<string>();
      for (let i = offsets[stroke]; i < offsets[stroke + 1]; i++) columns.add(`${xy[2 * i].toFixed(3)}`);
      for (const column of columns) expect(seen.has(column)).toBe(false);
      for (const column of columns) seen.add(column);
    }
    expect(seen.size).toBe(12);
  });

  it("needs paper of sufficient size", () => {
    expect(sheetJob(on("axidraw-v3", { widthMm: 90, heightMm: 140 }), "sheet")).toBeNull();
  });
});

describe("the second sheet", () => {
  it("has six lines of the same drawing side by side, shaped for different frequencies", async () => {
    const jobs = checkJobs(DEFAULT_PLOT_SETTINGS, SPRINGS, ({ factor }) => `× ${factor}`);
    expect(jobs.map(({ settings }) => machineOf(settings).springs?.xHz ?? null)).toEqual([
      null,
      ...[12, 13.5, 15, 16.5, 18.75].map((hz) => expect.closeTo(hz, 6)),
    ]);
    const boxes = await Promise.all(jobs.map(async (job) => boxOfPoints((await strokesOf(job)).strokes.xy)));
    boxes.slice(1).forEach((box, i) => {
      expect(box.x0 - boxes[i].x0).toBeCloseTo(12, 6);
      expect(box.y0 - boxes[i].y0).toBeCloseTo(-12, 6);
    });
  });

  it("shows the right frequency: with a simulated pen, that line is the straightest", async () => {
    const jobs = checkJobs(DEFAULT_PLOT_SETTINGS, SPRINGS, () => "check");
    const errors = await Promise.all(
      jobs.map(async (job) => {
        const { strokes } = await strokesOf(job);
        const { trajectory } = planJob({ strokes }, job.settings, machineOf(job.settings));
        return penError(strokes, trajectory, SPRINGS).rmsMm;
      }),
    );
    expect(errors.indexOf(Math.min(...errors))).toBe(3);
    expect(errors[0]).toBeGreaterThan(3 * errors[3]);
  });
});

describe("the result of counting", () => {
  it("is the same from a count over 10 mm and from a ripple's length", () => {
    expect(frequencyOf({ measure: "count", value: 3 }, 50)).toBe(15);
    expect(frequencyOf({ measure: "length", value: 2 }, 50)).toBe(25);
    expect(frequencyOf({ measure: "count", value: null }, 50)).toBeNull();
    expect(() => frequencyOf({ measure: "length", value: 0.01 }, 50)).toThrow(/count again/);
  });

  it("is stored in a copy of a built-in machine, and in a custom machine itself", () => {
    const copy = measuredMachine(
      machineById("axidraw-v3"),
      { ...SPRINGS, xHz: 15.04 },
      [],
      (name) => `${name}!`,
    );
    expect(copy).toMatchObject({ id: "axidraw-v3-2", name: "AxiDraw V3!", springs: SPRINGS });
    const again = measuredMachine(copy, { ...SPRINGS, xHz: 16 }, [copy], (name) => `${name}!`);
    expect(again).toEqual({ ...copy, springs: { ...SPRINGS, xHz: 16 } });
  });

  it("saves time, and makes Fine more exact", () => {
    const [before, fine, normal, fast] = gainsOf(machineById("axidraw-v3"), SPRINGS);
    expect(before.quality).toBe("before");
    expect(fast.drawS).toBeLessThan(0.75 * before.drawS);
    expect(normal.drawS).toBeLessThan(fine.drawS);
    expect(fine.drawS).toBeLessThan(before.drawS);
    expect(fine.maxMm).toBeLessThan(0.7 * before.maxMm);
    expect(fast.maxMm).toBeLessThan(1.1 * before.maxMm);
  });
});
