import { describe, expect, it } from "vitest";
import { DEFAULT_PREPARE, type PrepareSettings } from "../../../src/settings/prepare.js";
import { cutOffLines } from "../../../src/prepare/cut-off.js";
import { layOutDrawing } from "../../../src/prepare/layout.js";
import { drawingOf } from "../../support/drawings/drawings.js";

/** Paper of 100 mm with margins of 10, true size. */
const BASE: PrepareSettings = {
  ...DEFAULT_PREPARE,
  paper: { widthMm: 100, heightMm: 100 },
  marginMm: 10,
  fit: false,
  clipToMargins: true,
};
const cutOf = (drawing: ReturnType<typeof drawingOf>, settings: Partial<PrepareSettings> = {}) => {
  const all = { ...BASE, ...settings };
  return cutOffLines(drawing, all, layOutDrawing(drawing, all));
};

/** Inside; across the margin; outside. */
const LINES = ["M20 20L80 20", "M50 50L95 50", "M5 2L60 2"];

describe("lines that the margins cut off", () => {
  it("are lines outside the margins, and lines that cross them", () => {
    const cut = cutOf(drawingOf(LINES))!;
    expect([...cut.lines.xy]).toEqual([50, 50, 95, 50, 5, 2, 60, 2]);
    expect(cut.outsideCount).toBe(1);
    expect(cut.limit).toEqual({ x0: 10, y0: 10, x1: 90, y1: 90 });
  });

  it("are none if everything is inside, fitted, or not cut", () => {
    expect(cutOf(drawingOf(LINES.slice(0, 1)))).toBeNull();
    expect(cutOf(drawingOf(LINES), { fit: true })).toBeNull();
    expect(cutOf(drawingOf(LINES), { clipToMargins: false })).toBeNull();
  });

  it("are lines outside the paper if they are cut off there", () => {
    const cut = cutOf(drawingOf(["M50 50L95 50", "M50 60L120 60"]), {
      clipToMargins: false,
      outside: "cut",
    })!;
    expect([...cut.lines.xy]).toEqual([50, 60, 120, 60]);
  });

  it("do not count hidden layers, nor shapes that draw nothing", () => {
    const shapes = [LINES[0], { d: LINES[1], group: 1 }, { d: "M50 50" }];
    const layered = drawingOf(shapes, { groups: ["kept", "off"] });
    expect(cutOf(layered, { hiddenLayers: ["g1"] })).toBeNull();
    expect(cutOf(layered)!.outsideCount).toBe(0);
  });
});
