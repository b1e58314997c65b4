import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { drawBackdrop, type Desk, type DeskColors } from "../../../web/preview/backdrop.js";

/** Records only texts, their places, and filled boxes. */
function drawn(sheet: Omit<Desk, "turn">, turn = 0, heightPx = 2000) {
  const words: string[] = [];
  const places: { y: number; align: CanvasTextAlign }[] = [];
  let align: CanvasTextAlign = "left";
  const fills: number[][] = [];
  const context = new Proxy({} as CanvasRenderingContext2D, {
    get: (_target, name) =>
      name === "fillText"
        ? (text: string, _x: number, y: number) => {
            words.push(text);
            places.push({ y, align });
          }
        : name === "fillRect"
          ? (...box: number[]) => fills.push(box)
          : () => undefined,
    set: (_target, name, value: CanvasTextAlign) => {
      if (name === "textAlign") align = value;
      return true;
    },
  });
  const desk = { ...sheet, turn };
  drawBackdrop(context, { scale: 2, offsetX: 10, offsetY: 20, turn }, desk, {} as DeskColors, heightPx);
  return { words, fills, places };
}

const margins = { topMm: 15, rightMm: 15, bottomMm: 15, leftMm: 15 };
const reach = { width: 300, height: 218, label: "Reach of the AxiDraw V3: 300 × 218 mm" };

/** By WCAG 2. */
const luminance = (hex: string): number => {
  const [r, g, b] = [1, 3, 5]
    .map((at) => Number.parseInt(hex.slice(at, at + 2), 16) / 255)
    .map((share) => (share <= 0.03928 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const contrast = (light: string, dark: string): number =>
  (luminance(light) + 0.05) / (luminance(dark) + 0.05);

describe("a sheet of which only a part is drawn", () => {
  const tokens = readFileSync(new URL("../../../web/ui/tokens.css", import.meta.url), "utf8");
  const valuesOf = (name: string): string[] =>
    Array.from(tokens.matchAll(new RegExp(`--desk-${name}: (#\\w{6});`, "g")), ([, hex]) => hex);
  const papers = valuesOf("paper");
  const rest = valuesOf("ghost");

  it("has the rest visible in the dark theme: a contrast of at least 3 : 1 to the dimmed sheet", () => {
    // Light, then dark by the system's setting and by the user's.
    expect([papers.length, rest.length]).toEqual([3, 3]);
    for (const k of [1, 2]) expect(contrast(papers[k], rest[k])).toBeGreaterThan(3);
    expect([papers[1], rest[1]]).toEqual([papers[2], rest[2]]);
  });

  it("has the rest paler than any ink in the light theme", () => {
    expect(contrast(papers[0], rest[0])).toBeGreaterThan(1.3);
    expect(contrast(papers[0], rest[0])).toBeLessThan(2);
  });
});

describe("the machine's reach under the drawing", () => {
  it("is labelled, whether or not it covers the paper", () => {
    const within = drawn({ paperMm: { width: 297, height: 210 }, margins, reach, unitMm: 1 });
    expect(within.words).toEqual([reach.label]);
    const beyond = drawn({ paperMm: { width: 420, height: 297 }, margins, reach, unitMm: 25.4 });
    expect(beyond.words).toEqual([reach.label]);
  });

  it("has its label whole, above its edge where there is no room below", () => {
    const desk = { paperMm: { width: 297, height: 210 }, margins, reach, unitMm: 1 };
    const edge = 20 + 2 * reach.height;
    for (const roomPx of [30, 10]) {
      const [{ y }] = drawn(desk, 0, edge + roomPx).places;
      expect([roomPx, y > edge]).toEqual([roomPx, roomPx === 30]);
      expect(y).toBeLessThanOrEqual(edge + roomPx - 4);
    }
  });

  it("shades the part of the paper beyond it", () => {
    const { fills } = drawn({ paperMm: { width: 210, height: 297 }, margins, reach, unitMm: 1 });
    expect(fills.at(-1)).toEqual([10, 20 + 2 * 218, 2 * 210, 2 * (297 - 218)]);
  });

  it("shades that part of a turned desk too, and names the corner at home", () => {
    const paper = { paperMm: { width: 210, height: 297 }, margins, reach, unitMm: 1 };
    const { fills, words } = drawn(paper, 1);
    expect(fills[0]).toEqual([10 - 2 * 297, 20, 2 * 297, 2 * 210]);
    expect(fills.at(-1)).toEqual([10 - 2 * 297, 20, 2 * (297 - 218), 2 * 210]);
    expect(words).toEqual([reach.label, "Home, top left"]);
  });

  it("has its label and the name of the corner at home apart, however the desk is turned", () => {
    const paper = { paperMm: { width: 297, height: 210 }, margins, reach, unitMm: 1 };
    for (const turn of [1, 2, 3]) {
      const [label, home] = drawn(paper, turn).places;
      const isApart = label.y !== home.y || label.align !== home.align;
      expect([turn, isApart]).toEqual([turn, true]);
    }
  });
});
