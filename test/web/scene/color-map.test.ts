import { describe, expect, it } from "vitest";
import { listColor, rampColor } from "../../../src/internal.js";
import { bytesFromHex, rampBytes, RAMP_SIZE } from "../../../web/scene/color-map.js";

/** Relative luminance and contrast as WCAG 2.2 defines them. */
const luminance = (hex: string): number => {
  const channel = (at: number): number => {
    const c = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  };
  return 0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5);
};
/** Lightness in OKLab, 0 … 1. */
const lightness = (hex: string): number => {
  const [r, g, b] = [1, 3, 5].map((at) => {
    const c = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return 0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s;
};
const contrastOnPaper = (hex: string): number => (luminance("#fefdfb") + 0.05) / (luminance(hex) + 0.05);

describe("the colour ramp", () => {
  const colors = Array.from({ length: RAMP_SIZE }, (_, i) => rampColor(i / (RAMP_SIZE - 1)));

  it("only gets lighter from slow to fast, so that it can be read in grey", () => {
    for (let i = 8; i < colors.length; i += 8) {
      expect(luminance(colors[i])).toBeGreaterThan(luminance(colors[i - 8]));
    }
  });

  it("gets lighter in even steps: each is within 10 % of the mean", () => {
    const steps = 16;
    const at = (k: number): number => lightness(rampColor(k / steps));
    const mean = (at(steps) - at(0)) / steps;
    expect(mean).toBeGreaterThan(0.025);
    for (let k = 1; k <= steps; k++) {
      expect(Math.abs((at(k) - at(k - 1)) / mean - 1), `step ${k}`).toBeLessThan(0.1);
    }
  });

  it("stands out on white paper at every speed", () => {
    for (const color of colors) expect(contrastOnPaper(color)).toBeGreaterThan(2.3);
  });

  it("runs from indigo through magenta to orange", () => {
    expect([0, 0.5, 1].map(rampColor)).toEqual(["#0a056c", "#9b2e72", "#e98d0e"]);
  });

  it("has neighbours that differ by little, and ends that differ by much", () => {
    const bytes = rampBytes();
    for (let i = 4; i < bytes.length; i += 4) {
      for (let c = 0; c < 3; c++) expect(Math.abs(bytes[i + c] - bytes[i + c - 4])).toBeLessThan(12);
    }
    expect(luminance(colors.at(-1)!) - luminance(colors[0])).toBeGreaterThan(0.35);
  });

  it("is the same in the legend as on the paper", () => {
    const bytes = rampBytes();
    const last = bytes.length - 4;
    expect(bytesFromHex(rampColor(1))).toEqual([...bytes.slice(last, last + 3)]);
    expect(rampColor(-3)).toBe(rampColor(0));
    expect(rampColor(7)).toBe(rampColor(1));
  });
});

describe("layer colours", () => {
  it("differ for the first dozen layers", () => {
    const colors = Array.from({ length: 12 }, (_, i) => listColor(i));
    expect(new Set(colors).size).toBe(12);
    for (const color of colors) expect(color).toMatch(/^#[0-9a-f]{6}$/);
  });
});
