/** Layers and elements that are drawn at a share of the usual speed: from the file to the plan, and exported. */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importDrawing,
  importSvg,
  machineById,
  planJob,
  prepare,
  toSvg,
  type Drawing,
  type MachineProfile,
  type MotionSettings,
  type PrepareSettings,
  type StrokeSet,
} from "../../../src/index.js";
import { toJson } from "../../../src/internal.js";
import { codedLayerNames } from "../../../src/export/coded-names.js";
import { GRBL } from "../../support/machines/machine.js";
import { NO_PENS } from "../../../src/prepare/layers/pens.js";

const svg = (content: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="100mm" viewBox="0 0 200 100" fill="none" stroke="#000">${content}</svg>`;
const SETTINGS: PrepareSettings = { ...DEFAULT_PREPARE, order: "none", fit: false, marginMm: 0 };
const strokesOf = (drawing: Drawing, settings = SETTINGS): StrokeSet => prepare(drawing, settings).strokes;
const factorsOf = (strokes: StrokeSet): number[] => [...(strokes.speedFactor ?? [])];

/** Largest speed of each stroke, mm/s. */
function speedsOf(
  strokes: StrokeSet,
  motion: MotionSettings = DEFAULT_MOTION,
  machine: MachineProfile = machineById("axidraw-v3"),
): number[] {
  const job = planJob({ strokes }, { motion, pen: DEFAULT_PEN }, machine);
  const t = job.trajectory;
  const tops: number[] = [];
  for (let run = 0; run < t.runs.count; run++) {
    if (t.runs.stroke[run] < 0) continue;
    let top = 0;
    for (let k = t.runs.firstBlock[run]; k < t.runs.firstBlock[run + 1]; k++) {
      top = Math.max(top, Math.hypot(t.vx[k], t.vy[k]));
    }
    tops.push(Math.round(top));
  }
  return tops;
}

describe("data-plotwright-speed", async () => {
  const drawing = await importSvg(
    svg(`<path d="M10 10h100"/>
      <g data-plotwright-speed="0.5"><path d="M10 20h100"/><path d="M10 30h100" data-plotwright-speed="0.2"/>
        <g><path d="M10 40h100" data-plotwright-speed="1"/><path d="M10 50h100"/></g></g>`),
  );

  it("slows an element or a whole group; an inner value replaces the group's", () => {
    expect(drawing.warnings).toEqual([]);
    expect([...(drawing.paths.speedFactor ?? [])]).toEqual([1, 0.5, 0.2, 1, 0.5]);
    const strokes = strokesOf(drawing, { ...SETTINGS, layers: "all" });
    // The strokes of one speed follow each other.
    expect(factorsOf(strokes)).toEqual([1, 1, 0.5, 0.5, 0.2]);
    expect(speedsOf(strokes)).toEqual([50, 50, 25, 25, 10]);
  });

  it("changes the time of the plan", async () => {
    const one = async (attribute: string) =>
      strokesOf(await importSvg(svg(`<path d="M10 10h100"${attribute}/>`)));
    const drawS = (strokes: StrokeSet): number => {
      const job = planJob(
        { strokes },
        { motion: DEFAULT_MOTION, pen: DEFAULT_PEN },
        machineById("axidraw-v3"),
      );
      return job.trajectory.totalS;
    };
    // 100 mm at 50 mm/s and 500 mm/s² take 2.1 s, at 25 mm/s 4.05 s.
    expect(drawS(await one(' data-plotwright-speed="0.5"')) - drawS(await one(""))).toBeCloseTo(1.95, 6);
  });

  it.each(["fast", "", "0", "2", "-1"])("%j is ignored, with a warning that names it", async (value) => {
    const { warnings, paths } = await importSvg(
      svg(`\n<path d="M10 10h100" data-plotwright-speed="${value}"/>`),
    );
    expect(paths.speedFactor).toBeUndefined();
    expect(warnings).toHaveLength(1);
    expect(warnings[0].code).toBe("speed-factor");
    expect(warnings[0].message).toContain(`"${value}" at line 2`);
  });

  it("keeps strokes of different speeds apart where their ends meet", async () => {
    const meeting = async (attribute: string) =>
      strokesOf(await importSvg(svg(`<path d="M10 10h50"/><path d="M60 10h50"${attribute}/>`)), {
        ...SETTINGS,
        joinMm: 0.5,
      });
    expect((await meeting("")).offsets).toHaveLength(2);
    expect(factorsOf(await meeting(' data-plotwright-speed="0.5"'))).toEqual([1, 0.5]);
  });

  it("stays with each stroke where a layer is split to take up ink", () => {
    const strokes = strokesOf(drawing, { ...SETTINGS, layers: "all", reinkMm: 80 });
    const slowMm = Array.from(strokes.speedFactor ?? [], (factor, i) => {
      const [a, b] = [strokes.offsets[i], strokes.offsets[i + 1] - 1];
      return factor === 0.2 ? Math.abs(strokes.xy[2 * b] - strokes.xy[2 * a]) : 0;
    });
    expect(slowMm.reduce((sum, mm) => sum + mm, 0)).toBeCloseTo(100, 6);
  });

  it("is read back from JSON and SVG", async () => {
    const strokes = strokesOf(drawing, { ...SETTINGS, layers: "all" });
    const size = { widthMm: 200, heightMm: 100 };
    const texts = { "a.json": JSON.stringify(toJson(strokes, size)), "a.svg": toSvg(strokes, size) };
    for (const [name, text] of Object.entries(texts)) {
      const back = await importDrawing(name, text);
      expect(factorsOf(strokesOf(back, { ...SETTINGS, layers: "all" }))).toEqual(factorsOf(strokes));
    }
  });

  it("is named in an error if it is wrong in JSON", async () => {
    const text = '{"widthMm":100,"heightMm":100,"layers":[{"strokes":[[1,1,9,9]],"speedFactors":[7]}]}';
    const { warnings } = await importDrawing("a.json", text);
    expect(warnings[0].message).toContain('"7" of stroke 1 of layer 1');
  });

  it("slows a controller that plans by itself", () => {
    const strokes = strokesOf(drawing, { ...SETTINGS, layers: "all" });
    expect(speedsOf(strokes, DEFAULT_MOTION, GRBL)).toEqual([50, 50, 25, 25, 10]);
  });
});

describe("the layer code +v", async () => {
  const drawing = await importSvg(
    svg(`<g id="a" data-name="1 outline"><path d="M10 10h100"/></g>
      <g id="b" data-name="2+v50 shade"><path d="M10 20h100"/></g>
      <g id="c" data-name="3+s25+v50 fine"><path d="M10 30h100"/></g>`),
  );
  const strokes = strokesOf(drawing, { ...SETTINGS, layers: "group" });

  it("draws a layer at a share of the speed that it would have", () => {
    const [plain, half, coded] = speedsOf(strokes);
    expect([plain, half]).toEqual([50, 25]);
    // +s25 is 50.2 mm/s.
    expect(coded).toBe(25);
  });

  it("is written with the other codes", () => {
    const names = codedLayerNames(strokes, { ...NO_PENS, motion: DEFAULT_MOTION, pen: DEFAULT_PEN });
    expect(names).toEqual(["1 outline", "2+v50 shade", "3+s25+v50 fine"]);
  });

  it("does not override the settings of the layer", () => {
    const motion: MotionSettings = { ...DEFAULT_MOTION, layers: { b: { speedFactor: 0.8 } } };
    expect(speedsOf(strokes, motion)[1]).toBe(40);
  });
});
