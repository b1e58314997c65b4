import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importDrawing,
  importSvg,
  plan,
  prepare,
  toSvg,
  type StrokeSet,
} from "../../../src/index.js";
import { NO_PENS, prepareSettingsOf, svgOptionsOf, toJson, trajectoryToSvg } from "../../../src/internal.js";
import { drawingOf } from "../../support/drawings/drawings.js";
import { strokeSetOf, type Point } from "../../support/drawings/arbitraries.js";
import { NearStroke } from "../../support/trajectories/trajectory-checks.js";

const PAPER = { widthMm: 210, heightMm: 297 };
const SETTINGS = {
  ...DEFAULT_PREPARE,
  paper: PAPER,
  landscape: false,
  marginMm: 0,
  fit: false,
  joinMm: 0,
  order: "none" as const,
};

const drawing = drawingOf(
  [
    { d: "M10 10L20 10L20 20Z", group: 0, stroke: "#ff0000" },
    { d: "M30 30L30 30", group: 0, stroke: "#ff0000" },
    { d: "M1.2345 100C40 40 80 80 100 10", group: 1 },
  ],
  { groups: ['1 <red> & "hot"', "curve\u0000s"] },
);

/** Rounded to what the file holds. */
const rounded = (set: StrokeSet): number[] => Array.from(set.xy, (v) => Math.round(v * 1000) / 1000);

describe("toSvg", () => {
  it("writes what the importer reads back as the same strokes in the same layers", async () => {
    const { strokes } = prepare(drawing, SETTINGS);
    const back = await importSvg(toSvg(strokes, PAPER));
    const again = prepare(back, SETTINGS).strokes;
    expect(rounded(again)).toEqual(rounded(strokes));
    expect([...again.offsets]).toEqual([...strokes.offsets]);
    expect([...again.layer]).toEqual([...strokes.layer]);
    expect(again.layers.map((layer) => layer.name)).toEqual(['1 <red> & "hot"', "curves"]);
    expect(again.layers[0].color).toBe("#ff0000");
    expect([back.widthMm, back.heightMm]).toEqual([210, 297]);
  });

  it("names layers as requested, so that codes can be written", () => {
    const { strokes } = prepare(drawing, SETTINGS);
    const svg = toSvg(strokes, { ...PAPER, layerNames: ["!1+h30 red"] });
    expect(svg).toContain('inkscape:label="!1+h30 red"');
    expect(svg).toContain('inkscape:label="curves"');
  });

  it("writes what is on paper, in the pens' colours and widths, without their corrections", async () => {
    const pen = { id: "p", name: "Gold", color: "#ccaa00", widthMm: 1.2, offsetXMm: 2, offsetYMm: -1 };
    const job = { ...NO_PENS, pens: [pen], layerPens: { g0: "p" }, motion: DEFAULT_MOTION, pen: DEFAULT_PEN };
    const askew = prepare(drawing, prepareSettingsOf({ ...job, prepare: SETTINGS }));
    const back = prepare(await importSvg(toSvg(askew.strokes, svgOptionsOf(askew, job))), SETTINGS).strokes;
    expect(rounded(back)).toEqual(rounded(prepare(drawing, SETTINGS).strokes));
    expect(back.layers[0]).toMatchObject({ name: '1 <red> & "hot"', color: "#ccaa00" });
    expect(toJson(askew.strokes, PAPER)).toEqual(toJson(prepare(drawing, SETTINGS).strokes, PAPER));
  });

  it("writes an empty page for no strokes", async () => {
    expect((await importSvg(toSvg(strokeSetOf([]), PAPER))).paths.count).toBe(0);
  });
});

describe("toJson", () => {
  it("lists the strokes of each layer in mm", () => {
    const json = toJson(prepare(drawing, SETTINGS).strokes, PAPER);
    expect(json.layers.map((layer) => layer.strokesMm.length)).toEqual([2, 1]);
    expect(json.layers[0].strokesMm[0]).toEqual([10, 10, 20, 10, 20, 20, 10, 10]);
    expect(json.layers[0].strokesMm[1]).toEqual([30, 30]);
    expect(JSON.parse(JSON.stringify(json))).toEqual(json);
  });

  it("is read back as the same strokes in the same layers", async () => {
    const { strokes } = prepare(drawing, SETTINGS);
    const back = prepare(
      await importDrawing("plot.json", JSON.stringify(toJson(strokes, PAPER))),
      SETTINGS,
    ).strokes;
    expect(rounded(back)).toEqual(rounded(strokes));
    expect([...back.layer]).toEqual([...strokes.layer]);
    expect(back.layers.map(({ id }) => id)).toEqual(strokes.layers.map(({ id }) => id));
  });
});

describe("trajectoryToSvg", () => {
  const { strokes } = prepare(drawing, SETTINGS);
  const trajectory = plan(strokes, DEFAULT_MOTION, DEFAULT_PEN);
  const svg = trajectoryToSvg(trajectory, PAPER);

  it("draws in the colours of its legend, slow at the ends and fast between", () => {
    const colors = [...svg.matchAll(/data-band="(\d+)" stroke="(#[0-9a-f]{6})"/g)];
    const legend = [...svg.matchAll(/<rect x=[^>]*fill="(#[0-9a-f]{6})"/g)].map((m) => m[1]);
    expect(legend).toHaveLength(24);
    expect(new Set(legend).size).toBe(24);
    for (const [, band, color] of colors) expect(legend[Number(band)]).toBe(color);
    const bands = colors.map((m) => Number(m[1]));
    expect(Math.min(...bands)).toBe(0);
    expect(Math.max(...bands)).toBe(23);
  });

  it("shows the top speed in mm/s", () => {
    expect(svg).toContain(">50 mm/s</text>");
  });

  it("covers every stroke's points and shows travel", () => {
    const exact = plan(strokes, { ...DEFAULT_MOTION, mode: "junction", fit: null }, DEFAULT_PEN);
    const reached = [...trajectoryToSvg(exact, PAPER).matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g)].map(
      (m): Point => [Number(m[1]), Number(m[2])],
    );
    // On a smooth line the planner's points lie between those of the drawing.
    const drawn = new NearStroke(strokeSetOf([reached]), 0);
    for (let k = 0; k < strokes.xy.length; k += 2) {
      const near = drawn.distance(strokes.xy[k], strokes.xy[k + 1]) < 0.06;
      expect(near, `${strokes.xy[k]}, ${strokes.xy[k + 1]}`).toBe(true);
    }
    expect(svg).toContain('class="travel"');
  });

  it("has no NaN, even for an empty drawing", () => {
    expect(svg).not.toContain("NaN");
    expect(trajectoryToSvg(plan(strokeSetOf([]), DEFAULT_MOTION, DEFAULT_PEN), PAPER)).not.toContain("NaN");
  });
});
