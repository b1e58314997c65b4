import { createElement } from "react";
import { renderToStaticMarkup } from "react-dom/server";
import { describe, expect, it } from "vitest";
import { rampColor } from "../../../src/internal.js";
import { DEFAULT_PLOT_SETTINGS } from "../../../src/schema/index.js";
import { PIECE_BYTES, PIECE_FLOATS, PIECE_SHORTS, VALUE_SHORT } from "../../../web/scene/pieces.js";
import type { Scene } from "../../../web/scene/scene.js";
import { VIEW_MODES, viewModeOf, type ModeInput, type ViewMode } from "../../../web/preview/view-modes.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import type { PageState } from "../../../web/state/store.js";
import type { Planned } from "../../../web/worker/protocol.js";

const RED = "#e00000";
/** Two layers, drawn at twice the file's size, a line every 0.4 mm. */
const planned = (colors: readonly string[] = [RED, "#0000e0"]): Planned => {
  const layers = colors.map((color, k) => ({ id: `l${k}`, name: `Layer ${k}`, color }));
  const drawn: Partial<Planned> = {
    drawnLayers: layers,
    layers: layers.map((layer, k) => ({
      ...layer,
      colorCount: 1,
      strokeWidthMm: k === 0 ? 0.5 : 0,
      visible: true,
      strokeCount: 1,
      pointCount: 2,
      drawMm: 10,
    })),
    pageToPaper: { a: 2, b: 0, c: 0, d: 2, e: 0, f: 0 },
    lineGapMm: 0.4,
  };
  return drawn as Planned;
};
const fine = { id: "p", name: "Fine", color: "#00a000", widthMm: 0.1, offsetXMm: 0, offsetYMm: 0 };
const settings = { ...DEFAULT_PLOT_SETTINGS, pens: [fine], layerPens: { l1: "p" } };

const modeOf = (viewMode: string): ViewMode =>
  viewModeOf({ view: { ...DEFAULT_VIEW, viewMode } } as PageState);
const layerLooks = (id: string, shown: ModeInput) => modeOf(id).layerLooks(shown);

describe("the view modes", () => {
  it("each have another id and label", () => {
    expect(new Set(VIEW_MODES.map(({ id }) => id)).size).toBe(VIEW_MODES.length);
    expect(new Set(VIEW_MODES.map(({ label }) => label)).size).toBe(VIEW_MODES.length);
    for (const { id } of VIEW_MODES) expect(modeOf(id).id).toBe(id);
  });

  it("begin with Ink, which is also shown if this version does not have the remembered one", () => {
    expect(modeOf(DEFAULT_VIEW.viewMode).label).toBe("Ink");
    expect(modeOf("temperature").label).toBe("Ink");
  });

  it("Ink has the file's colours, and its widths as large as they are on the paper", () => {
    const [first, second] = layerLooks("ink", { planned: planned(), settings });
    expect([first.color, second.color]).toEqual([RED, "#0000e0"]);
    expect(first.widthMm).toBeCloseTo(1);
    // The file has no width for it, so the pen's is used.
    expect(second.widthMm).toBeCloseTo(0.1);
  });

  it("Pen has the pens' colours and widths", () => {
    const [, second] = layerLooks("pen", { planned: planned(), settings });
    expect(second).toEqual({ color: "#00a000", widthMm: 0.1 });
  });

  it("Speed, Layer and Order draw no line wider than half of the gap between lines", () => {
    for (const look of ["speed", "layer", "order"] as const) {
      const widths = layerLooks(look, { planned: planned(), settings }).map(({ widthMm }) => widthMm);
      expect(widths[0]).toBeCloseTo(0.2);
      expect(widths[1]).toBeCloseTo(0.1);
    }
  });

  it("Layer keeps the layers' colours if they all differ, and uses others if two are the same", () => {
    const colorsOf = (colors?: readonly string[]) =>
      layerLooks("layer", { planned: planned(colors), settings }).map(({ color }) => color);
    expect(colorsOf()).toEqual([RED, "#0000e0"]);
    expect(new Set(colorsOf([RED, RED])).size).toBe(2);
  });

  it("have a legend that names each only once", () => {
    const shown: ModeInput = {
      planned: planned([RED, RED]),
      settings: { ...settings, layerPens: { l0: "p", l1: "p" } },
    };
    const namesIn = (id: string): string[] => {
      const html = renderToStaticMarkup(createElement(modeOf(id).Legend, shown));
      return [...html.matchAll(/<\/span>([^<]+)<\/li>/g)].map(([, name]) => name);
    };
    expect(namesIn("pen")).toEqual(["Fine, 0.1 mm"]);
    expect(namesIn("layer")).toEqual(["Layer 0", "Layer 1"]);
    expect(namesIn("ink")).toEqual([`${RED}, 1 mm`, `${RED}, 0.1 mm`]);
  });

  it("Speed has a legend over the speeds of most of the ink", () => {
    // 3 mm at rest, 50 mm at a quarter of the top speed, 50 mm at three quarters of it, 2 mm at the top.
    const lines = [
      [3, 0],
      [50, 64 / 256],
      [50, 191.5 / 256],
      [2, 1],
    ] as const;
    const bytes = new ArrayBuffer(lines.length * PIECE_BYTES);
    lines.forEach(([mm, speed], i) => {
      new Float32Array(bytes).set([0, 0, mm, 0], i * PIECE_FLOATS);
      const value = Math.round(65_535 * speed);
      new Uint16Array(bytes).set([value, value], i * PIECE_SHORTS + VALUE_SHORT);
    });
    const none = { count: 0, bytes: new ArrayBuffer(0) };
    const scene = { draw: { count: lines.length, bytes }, travel: none, totalS: 1, topDrawMmPerS: 64 };
    const shown = { planned: { ...planned(), scene: scene as unknown as Scene } as Planned, settings };
    const html = renderToStaticMarkup(createElement(modeOf("speed").Legend, shown));
    const stops = /data-stops="([^"]+)"/.exec(html)![1].replaceAll("&quot;", '"');
    const scale = JSON.parse(stops) as { mmPerS: number; color: string }[];
    expect(scale.map(({ mmPerS }) => mmPerS)).toEqual(Array.from({ length: 17 }, (_, i) => 16 + 2 * i));
    const labels = [...html.matchAll(/<span>([^<]*\d)<\/span>/g)].map(([, label]) => label);
    expect(labels).toEqual(["≤ 16", "24", "32", "40", "≥ 48"]);
    expect(scale[0].color).toBe(rampColor(0));
    expect(scale[16].color).toBe(rampColor(1));
  });
});
