import { describe, expect, it } from "vitest";
import { DEFAULT_PLOT_SETTINGS } from "../../src/schema/index.js";
import { legendEntries, layerLooks } from "../../web/preview/looks.js";
import type { Planned } from "../../web/worker/protocol.js";

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

describe("the looks", () => {
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

  it("the legend names each only once", () => {
    const looked = {
      planned: planned([RED, RED]),
      settings: { ...settings, layerPens: { l0: "p", l1: "p" } },
    };
    expect(legendEntries(looked, "pen", () => "Fine")).toEqual([{ color: "#00a000", label: "Fine" }]);
    expect(legendEntries(looked, "layer", ({ name }) => name)).toHaveLength(2);
  });
});
