/** The small pictures of what can be done with filled shapes. */
import { describe, expect, it } from "vitest";
import { importSvg, DEFAULT_PREPARE } from "../../../src/index.js";
import { sketchesOf } from "../../../web/worker/sketches.js";

const svg = (body: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="100mm" viewBox="0 0 200 100">${body}</svg>`;
const square = (x: number, y: number, size = 20): string =>
  `<path d="M${x} ${y}h${size}v${size}h-${size}z" fill="#123456"/>`;
const HATCH = { hatch: { ...DEFAULT_PREPARE.hatch, spacingMm: 0.4 } };
const WAYS = [{}, HATCH, { hideCovered: true }];

const lengthOf = ({ xy, offsets }: ReturnType<typeof sketchesOf>[number]): number => {
  let sum = 0;
  for (let i = 0; i + 1 < offsets.length; i++) {
    for (let p = offsets[i] + 1; p < offsets[i + 1]; p++) {
      sum += Math.hypot(xy[2 * p] - xy[2 * p - 2], xy[2 * p + 1] - xy[2 * p - 1]);
    }
  }
  return sum;
};

describe("sketches of a drawing", () => {
  it("show it with each of the settings, with lines that are far enough apart to be seen", async () => {
    const drawing = await importSvg(svg(square(80, 40) + square(90, 45)));
    const [outline, hatch, hide] = sketchesOf(drawing, DEFAULT_PREPARE, WAYS);
    expect(lengthOf(outline)).toBeCloseTo(160, 3);
    // The part of the lower square that the upper one covers is gone: 10 mm to the right and 15 mm down.
    expect(lengthOf(hide)).toBeCloseTo(160 - 25, 1);
    const spacingMm = (2 * 400) / (lengthOf(hatch) - 160);
    expect(spacingMm).toBeGreaterThan(0.8);
  });

  it("show a few shapes of many, the same part each time", async () => {
    const many = Array.from({ length: 200 }, (_, i) =>
      square(2 + 9 * (i % 20), 2 + 9 * Math.floor(i / 20), 6),
    );
    const drawing = await importSvg(svg(many.join("")));
    const boxes = sketchesOf(drawing, DEFAULT_PREPARE, WAYS).map(({ box }) => box);
    expect(boxes.length).toBe(3);
    expect(boxes[1]).toEqual(boxes[0]);
    const sideMm = boxes[0].x1 - boxes[0].x0;
    expect(sideMm).toBeGreaterThan(9);
    expect(sideMm).toBeLessThan(60);
  });

  it("are not made of a drawing without filled shapes, nor of a large one", async () => {
    expect(
      sketchesOf(await importSvg(svg('<path d="M0 0H90M0 9L9 0" stroke="red"/>')), DEFAULT_PREPARE, WAYS),
    ).toEqual([]);
    const large = await importSvg(svg(square(1, 1).repeat(4_001)));
    expect(sketchesOf(large, DEFAULT_PREPARE, WAYS)).toEqual([]);
  });
});
