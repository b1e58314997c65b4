import { describe, expect, it } from "vitest";
import { drawBackdrop, type Desk, type DeskColors } from "../../../web/preview/backdrop.js";

/** Records only texts and filled boxes. */
function drawn(desk: Desk): { words: string[]; fills: number[][] } {
  const words: string[] = [];
  const fills: number[][] = [];
  const context = new Proxy({} as CanvasRenderingContext2D, {
    get: (_target, name) =>
      name === "fillText"
        ? (text: string) => words.push(text)
        : name === "fillRect"
          ? (...box: number[]) => fills.push(box)
          : () => undefined,
    set: () => true,
  });
  drawBackdrop(context, { scale: 2, offsetX: 10, offsetY: 20 }, desk, {} as DeskColors);
  return { words, fills };
}

const margins = { topMm: 15, rightMm: 15, bottomMm: 15, leftMm: 15 };
const reach = { width: 300, height: 218, label: "Reach of the AxiDraw V3: 300 × 218 mm" };

describe("the machine's reach under the drawing", () => {
  it("is labelled, whether or not it covers the paper", () => {
    const within = drawn({ paperMm: { width: 297, height: 210 }, margins, reach, unitMm: 1 });
    expect(within.words).toEqual([reach.label]);
    const beyond = drawn({ paperMm: { width: 420, height: 297 }, margins, reach, unitMm: 25.4 });
    expect(beyond.words).toEqual([reach.label]);
  });

  it("shades the part of the paper beyond it", () => {
    const { fills } = drawn({ paperMm: { width: 210, height: 297 }, margins, reach, unitMm: 1 });
    expect(fills.at(-1)).toEqual([10, 20 + 2 * 218, 2 * 210, 2 * (297 - 218)]);
  });
});
