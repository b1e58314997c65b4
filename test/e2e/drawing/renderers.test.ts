/**
 * The strokes' pixels in Chromium: in one part and in many, near and far, with the graphics card and in
 * software.
 */
import path from "node:path";
import type { Browser, Page } from "playwright-core";
import { build } from "vite";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ROOT } from "../../../scripts/setup.mjs";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, stateAt, type StrokeSet } from "../../../src/index.js";
import type { Frame } from "../../../web/scene/renderer.js";
import { buildScene } from "../../../web/scene/scene.js";
import { launchBrowser } from "../../support/browser/browser.js";
import type * as PageCode from "../../support/browser/renderers-page.js";
import type { RendererName, SentScene } from "../../support/browser/renderers-page.js";

/** Crossing waves of two layers: every pixel of their middle is drawn many times. */
const waves = (): StrokeSet => {
  const strokes = Array.from({ length: 24 }, (_, s) =>
    Array.from({ length: 160 }, (_, i) => {
      const along = 5 + i / 2;
      const across = 10 + s * 3 + 2 * Math.sin(i / 6);
      return s % 2 === 0 ? [along, across] : [across, along];
    }),
  );
  return {
    xy: Float64Array.from(strokes.flat(2)),
    offsets: Uint32Array.from({ length: 25 }, (_, s) => s * 160),
    layer: Uint16Array.from({ length: 24 }, (_, s) => s % 2),
    layers: ["a", "b"].map((id) => ({ id, name: id, color: null })),
  };
};
const { draw, travel, totalS } = (() => {
  const strokes = waves();
  return buildScene(plan(strokes, DEFAULT_MOTION, DEFAULT_PEN), strokes.layer);
})();
const base64 = (bytes: ArrayBuffer): string => Buffer.from(bytes).toString("base64");
const scene: SentScene = { draw: base64(draw.bytes), travel: base64(travel.bytes), totalS };

/** One straight line, of which most is a single piece, and where the pen is halfway. */
const longLine = (() => {
  const strokes: StrokeSet = {
    xy: Float64Array.from([5, 10, 85, 10]),
    offsets: Uint32Array.from([0, 2]),
    layer: Uint16Array.of(0),
    layers: [{ id: "a", name: "a", color: null }],
  };
  const trajectory = plan(strokes, DEFAULT_MOTION, DEFAULT_PEN);
  const built = buildScene(trajectory, strokes.layer);
  const sent = { draw: base64(built.draw.bytes), travel: base64(built.travel.bytes), totalS: built.totalS };
  const startS = trajectory.runs.startS[trajectory.runs.stroke.indexOf(0)];
  const untilS = startS + 1;
  return { sent, untilS, penX: stateAt(trajectory, untilS).x };
})();

/** A straight line and a circle, both slow at their ends: there they have the most pieces. */
const LINE_AND_CIRCLE: readonly (readonly [string, readonly (readonly [number, number])[]])[] = [
  [
    "a straight line",
    [
      [5, 10.1],
      [85, 10.3],
    ],
  ],
  [
    "a circle",
    Array.from({ length: 361 }, (_, k) => {
      const angle = (k * Math.PI) / 180;
      return [40 + 25 * Math.cos(angle), 40 + 25 * Math.sin(angle)] as const;
    }),
  ],
];

/** The scene of one black stroke, how long it is, and places on it, mm. */
const strokeOf = (points: readonly (readonly [number, number])[]) => {
  const strokes: StrokeSet = {
    xy: Float64Array.from(points.flat()),
    offsets: Uint32Array.from([0, points.length]),
    layer: Uint16Array.of(0),
    layers: [{ id: "a", name: "a", color: null }],
  };
  const trajectory = plan(strokes, DEFAULT_MOTION, DEFAULT_PEN);
  const built = buildScene(trajectory, strokes.layer);
  const sent = { draw: base64(built.draw.bytes), travel: base64(built.travel.bytes), totalS: built.totalS };
  let lengthMm = 0;
  for (let i = 1; i < points.length; i++)
    lengthMm += Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
  const { runs, startS, durationS } = trajectory;
  const run = runs.stroke.indexOf(0);
  const [from, to] = [startS[runs.firstBlock[run]], runs.firstBlock[run + 1] - 1];
  const endS = startS[to] + durationS[to];
  const places = Array.from({ length: 2_000 }, (_, k) =>
    stateAt(trajectory, from + ((k + 0.5) / 2_000) * (endS - from)),
  );
  return { sent, lengthMm, places };
};

const WHOLE: Frame = {
  view: { scale: 3, offsetX: 0.4, offsetY: -3.3 },
  width: 270,
  height: 250,
  ratio: 1,
  colorBy: "value",
  showTravel: false,
  layerColors: ["#c02020", "#1050b0"],
  layerWidthsMm: [0.35, 0.35],
  ghostColor: "#dcdad4",
  untilS: null,
};
const FRAMES: readonly (readonly [string, Frame])[] = [
  ["coloured by speed", WHOLE],
  ["half drawn, with the pen-up moves", { ...WHOLE, colorBy: "time", showTravel: true, untilS: totalS / 2 }],
  ["in pens of different widths", { ...WHOLE, colorBy: "layer", layerWidthsMm: [0.3, 1.2] }],
  [
    "on a turned desk",
    { ...WHOLE, view: { scale: 3, offsetX: 260.3, offsetY: 0.4, turn: 1 }, untilS: totalS / 2 },
  ],
  ["in lines thin enough for a dense drawing", { ...WHOLE, layerWidthsMm: [0.1, 0.1], lineGapMm: 0.3 }],
  [
    "close up, on a fine screen",
    {
      ...WHOLE,
      ratio: 2,
      colorBy: "layer",
      width: 130,
      height: 120,
      view: { scale: 24, offsetX: -700, offsetY: -500 },
    },
  ],
];

let browser: Browser;
let page: Page;

beforeAll(async () => {
  const built = await build({
    configFile: false,
    logLevel: "silent",
    build: {
      write: false,
      lib: {
        entry: path.join(ROOT, "test/support/browser/renderers-page.ts"),
        formats: ["iife"],
        name: "renderers",
      },
    },
  });
  const [{ output }] = built as { output: { code: string }[] }[] as [{ output: { code: string }[] }];
  browser = await launchBrowser();
  page = await browser.newPage();
  await page.addScriptTag({ content: output[0].code });
});

afterAll(async () => browser.close());

const pixelsOf = async (name: RendererName, frame: Frame, part: number, drawn = scene): Promise<Buffer> =>
  Buffer.from(
    await page.evaluate(
      async ([which, sent, of, size]) => {
        const { pixelsOf: draw } = (window as unknown as { renderers: typeof PageCode }).renderers;
        return draw(which, sent, of, size);
      },
      [name, drawn, frame, part] as const,
    ),
    "base64",
  );

const inkCount = (pixels: Buffer): number => pixels.filter((value) => value < 200).length;

describe.each(["gl", "soft"] as const)("the picture by the %s renderer", (name) => {
  it.each(FRAMES)("%s is the same to the pixel in one part and in many", async (_what, frame) => {
    const atOnce = await pixelsOf(name, frame, 1e9);
    expect(inkCount(atOnce)).toBeGreaterThan(5_000);
    expect(Buffer.compare(await pixelsOf(name, frame, 97), atOnce)).toBe(0);
  });

  it.each(LINE_AND_CIRCLE)(
    "has as much ink as %s has paper under it, and no gap in it",
    async (_what, points) => {
      const { sent, lengthMm, places } = strokeOf(points);
      for (const [scale, widthMm] of [
        [3, 0.4],
        [4.3, 0.35],
        [8, 0.7],
      ]) {
        const [width, height] = [90 * scale, 70 * scale].map(Math.round) as [number, number];
        const frame: Frame = {
          ...WHOLE,
          view: { scale, offsetX: 0.3, offsetY: 0.6 },
          width,
          height,
          colorBy: "layer",
          layerColors: ["#000000"],
          layerWidthsMm: [widthMm],
        };
        const pixels = await pixelsOf(name, frame, 1e9, sent);
        const inkAt = (x: number, y: number): number => 1 - pixels[4 * (y * width + x)] / 255;
        let ink = 0;
        for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) ink += inkAt(x, y);
        const areaPx = lengthMm * scale * widthMm * scale;
        expect(ink / areaPx).toBeGreaterThan(0.97);
        expect(ink / areaPx).toBeLessThan(1.04);
        // Of the pixels around each place on the line, one at least is mostly covered.
        const palest = Math.min(
          ...places.map(({ x, y }) => {
            const [left, top] = [Math.floor(x * scale - 0.2), Math.floor(y * scale + 0.1)];
            return Math.max(
              inkAt(left, top),
              inkAt(left + 1, top),
              inkAt(left, top + 1),
              inkAt(left + 1, top + 1),
            );
          }),
        );
        expect(palest).toBeGreaterThan(0.45);
      }
    },
  );

  it("has a long line drawn up to the pen, and pale behind it", async () => {
    const { sent, untilS, penX } = longLine;
    expect(penX).toBeGreaterThan(20);
    expect(penX).toBeLessThan(70);
    const frame: Frame = {
      ...WHOLE,
      // The line runs through the middle of the pixels of row 30.
      view: { scale: 3, offsetX: 0, offsetY: 0.5 },
      height: 60,
      colorBy: "layer",
      untilS,
    };
    const pixels = await pixelsOf(name, frame, 1e9, sent);
    /** Whether the pixels of that row have the first layer’s red. */
    const isDrawn = Array.from({ length: 270 }, (_, x) => {
      const at = (30 * 270 + x) * 4;
      return pixels[at] > 150 && pixels[at + 1] < 100;
    });
    const lastDrawn = isDrawn.lastIndexOf(true);
    expect(lastDrawn / 3).toBeGreaterThan(penX - 1);
    expect(lastDrawn / 3).toBeLessThan(penX + 1);
    expect(isDrawn.indexOf(true) / 3).toBeLessThan(6);
    /** What is left is pale, not absent. */
    const behind = (30 * 270 + Math.round(80 * 3)) * 4;
    expect([...pixels.subarray(behind, behind + 3)].every((value) => value > 200 && value < 245)).toBe(true);
  });
});

describe("without a graphics card", () => {
  it.each(FRAMES)("a picture %s equals the card's", async (_what, frame) => {
    const [gl, soft] = [await pixelsOf("gl", frame, 1e9), await pixelsOf("soft", frame, 1e9)];
    expect(soft).toHaveLength(gl.length);
    const apart = Array.from(gl, (value, i) => Math.abs(value - soft[i]));
    expect(apart.reduce((sum, d) => sum + d, 0) / apart.length).toBeLessThan(0.5);
    expect(apart.filter((d) => d > 24).length / apart.length).toBeLessThan(0.002);
  });

  it("the picture of a turned desk is the picture, turned", async () => {
    const [width, height] = [270, 250];
    const upright: Frame = { ...WHOLE, colorBy: "layer", view: { scale: 3, offsetX: 4, offsetY: 7 } };
    const view = { scale: 3, offsetX: height - 7, offsetY: 4, turn: 1 };
    const turned: Frame = { ...upright, width: height, height: width, view };
    const [before, after] = [await pixelsOf("soft", upright, 1e9), await pixelsOf("soft", turned, 1e9)];
    const back = Uint8Array.from(before, (_, k) => {
      const x = (k >> 2) % width;
      const y = Math.floor((k >> 2) / width);
      return after[(x * height + (height - 1 - y)) * 4 + (k & 3)];
    });
    expect(inkCount(before)).toBeGreaterThan(5_000);
    const apart = Array.from(back, (value, i) => Math.abs(value - before[i]));
    expect(apart.reduce((sum, d) => sum + d, 0) / apart.length).toBeLessThan(0.5);
    expect(apart.filter((d) => d > 24).length / apart.length).toBeLessThan(0.002);
  });

  it("content outside a view does not change the view", async () => {
    const near: Frame = {
      ...WHOLE,
      width: 120,
      height: 100,
      view: { scale: 9, offsetX: -240, offsetY: -210 },
    };
    const wide: Frame = { ...near, width: 520, height: 500, view: { scale: 9, offsetX: -40, offsetY: -10 } };
    const [seen, around] = [await pixelsOf("soft", near, 1e9), await pixelsOf("soft", wide, 1e9)];
    const cut = Uint8Array.from(seen, (_, k) => {
      const x = (k >> 2) % 120;
      const y = Math.floor((k >> 2) / 120);
      return around[((y + 200) * 520 + x + 200) * 4 + (k & 3)];
    });
    expect(inkCount(seen)).toBeGreaterThan(1_000);
    expect(Buffer.compare(seen, cut)).toBe(0);
  });
});
