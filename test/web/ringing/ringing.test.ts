/** The jobs of the ringing sheets, storing the measured springs, and the gain. */
import { describe, expect, it } from "vitest";
import { importSvg, machineById, MACHINES, planJob, prepare } from "../../../src/index.js";
import { boxOfPoints, machineOf, penError, prepareSettingsOf, type Springs } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS, newJobSchema, type PlotSettings } from "../../../src/schema/index.js";
import { readingOf } from "../../../web/ringing/count-axis.js";
import { isStored } from "../../../web/ringing/use-store-springs.js";
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
    const fits: string[] = [];
    for (const { id, widthMm, heightMm } of MACHINES) {
      const job = sheetJob(on(id, A4), "sheet");
      if (job === null) continue;
      fits.push(id);
      expect(newJobSchema.safeParse(job).success).toBe(true);
      const { strokes, warnings } = await strokesOf(job);
      expect(warnings).toEqual([]);
      const { x0, y0, x1, y1 } = boxOfPoints(strokes.xy);
      expect([x1 - x0, y1 - y0]).toEqual([expect.closeTo(60, 6), expect.closeTo(40, 6)]);
      expect(x0 + x1).toBeCloseTo(Math.min(widthMm, A4.widthMm), 6);
      expect(y0 + y1).toBeCloseTo(Math.min(heightMm, A4.heightMm), 6);
    }
    // The arm of an EggBot moves by 31 mm.
    expect(MACHINES.filter(({ id }) => !fits.includes(id)).map(({ id }) => id)).toEqual(["eggbot"]);
  });

  it("has no lines that come near each other, even with the widest ripples", async () => {
    const { xy, offsets } = (await strokesOf(sheetJob(DEFAULT_PLOT_SETTINGS, "sheet")!)).strokes;
    const boxes = Array.from({ length: offsets.length - 1 }, (_, i) =>
      boxOfPoints(xy.subarray(2 * offsets[i], 2 * offsets[i + 1])),
    );
    boxes.forEach((a, i) =>
      boxes.slice(i + 1).forEach((b) => {
        const [dx, dy] = [
          Math.max(a.x0, b.x0) - Math.min(a.x1, b.x1),
          Math.max(a.y0, b.y0) - Math.min(a.y1, b.y1),
        ];
        expect(Math.max(dx, dy)).toBeGreaterThan(2);
      }),
    );
  });

  it("needs paper of sufficient size", () => {
    expect(sheetJob(on("axidraw-v3", { widthMm: 59, heightMm: 50 }), "sheet")).toBeNull();
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
  it("needs the number of ripples and their length", () => {
    expect(readingOf({ ripples: 3, lengthMm: 18.5 })).toEqual({ ripples: 3, lengthMm: 18.5 });
    expect(readingOf({ ripples: 3, lengthMm: null })).toBeNull();
    expect(readingOf({ ripples: null, lengthMm: 18.5 })).toBeNull();
  });

  it("is stored only if frequencies and damping are", () => {
    expect(isStored(SPRINGS, { ...SPRINGS, xHz: 15.04 })).toBe(true);
    expect(isStored(SPRINGS, { ...SPRINGS, xHz: 15.1 })).toBe(false);
    expect(isStored({ ...SPRINGS, damping: 0.08 }, SPRINGS)).toBe(false);
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
