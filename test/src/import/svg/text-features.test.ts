/** Features of text, in the built-in letters: capitals 0.7 em high, small letters 14/30 em. */
import { describe, expect, it } from "vitest";
import { codes, draw, pointsOf, shapes } from "../../../support/import/shapes.js";

const text = (body: string, attributes = ""): string =>
  `<text x="10" y="50" font-size="10" stroke="none" fill="red" ${attributes}>${body}</text>`;

/** x0, y0, x1, y1 of everything drawn, in tenths of a mm. */
function extent(body: string): number[] {
  const drawing = draw(body);
  const points = Array.from({ length: drawing.paths.count }, (_, i) => pointsOf(drawing, i)).flat();
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)].map((mm) =>
    Math.round(10 * mm),
  );
}
const bottom = (body: string): number => extent(body)[3];
const width = (body: string): number => extent(body)[2] - extent(body)[0];

describe("baselines", () => {
  it.each([
    ['dominant-baseline="middle"', 523],
    ['dominant-baseline="hanging"', 572],
    ['dominant-baseline="text-before-edge"', 590],
    ['dominant-baseline="text-after-edge"', 479],
    ['alignment-baseline="central"', 535],
    ['baseline-shift="super"', 467],
    ['baseline-shift="sub"', 520],
    ['baseline-shift="-2"', 520],
    ['baseline-shift="50%"', 450],
  ])("with %s capitals end at %d", (attributes, expected) => {
    const body = text(`<tspan ${attributes}>H</tspan>`);
    expect(Math.abs(bottom(body) - expected)).toBeLessThanOrEqual(1);
  });

  it("accumulate shifts of nested elements", () => {
    expect(bottom(text('<tspan baseline-shift="2"><tspan baseline-shift="3">H</tspan></tspan>'))).toBe(450);
  });
});

describe("decorations", () => {
  it.each([
    ["underline", "M10 51.2L"],
    ["overline", "M10 41L"],
    ["line-through", "M10 47.7L"],
  ])("%s is a line along the text", (kind, begin) => {
    const plain = shapes(text("HH"));
    const added = shapes(text("HH", `text-decoration="${kind}"`)).filter((shape) => !plain.includes(shape));
    expect(added).toHaveLength(2);
    expect(added[0].startsWith(begin)).toBe(true);
  });

  it("have the colour of the requesting element", () => {
    const drawing = draw(text('<tspan fill="blue">H</tspan>', 'text-decoration="underline"'));
    expect(drawing.colors).toEqual(["#ff0000", "#0000ff"]);
  });
});

describe("widths", () => {
  it("have the given textLength, by gaps or by wider letters", () => {
    const plain = width(text("HHHH"));
    const gaps = width(text("HHHH", 'textLength="60"'));
    const glyphs = width(text("HHHH", 'textLength="60" lengthAdjust="spacingAndGlyphs"'));
    expect([plain, gaps, glyphs].map((tenths) => tenths > 500)).toEqual([false, true, true]);
    const one = width(text("H"));
    expect(glyphs - one).toBeGreaterThan(400);
    expect(shapes(text("H", 'textLength="60" lengthAdjust="spacingAndGlyphs"'))).not.toEqual(
      shapes(text("H")),
    );
  });

  it("apply in a tspan only to its own letters", () => {
    const all = text('A<tspan textLength="40">HH</tspan>B');
    const [, , x1] = extent(all);
    expect(x1).toBeGreaterThan(extent(text("AHHB"))[2] + 150);
  });

  it("ignore lengths that browsers ignore", () => {
    for (const attributes of ['textLength="0"', 'dominant-baseline="text-top"']) {
      expect(shapes(text("HH", attributes))).toEqual(shapes(text("HH")));
    }
  });

  it("grow with word-spacing at each space", () => {
    expect(width(text("H H H", 'word-spacing="5"')) - width(text("H H H"))).toBe(100);
  });
});

describe("spaces", () => {
  it.each([
    ["xml:space on a tspan", '<tspan xml:space="preserve">H  H</tspan>', ""],
    ["xml:space around the text", "H  H", 'xml:space="preserve"'],
    ["white-space", '<tspan style="white-space:pre">H  H</tspan>', ""],
  ])("are kept with %s", (_name, body, attributes) => {
    expect(width(text(body, attributes))).toBeGreaterThan(width(text("H  H")));
  });

  it("collapse again inside", () => {
    const body = text('<tspan xml:space="default">H  H</tspan>', 'xml:space="preserve"');
    expect(shapes(body)).toEqual(shapes(text("H H")));
  });
});

describe("letters", () => {
  it("are small capitals on request", () => {
    expect(shapes(text("Hh", 'font-variant="small-caps"'))).toEqual(
      shapes(text('H<tspan font-size="7">H</tspan>')),
    );
  });

  it("are transformed", () => {
    expect(shapes(text("ab", 'style="text-transform:uppercase"'))).toEqual(shapes(text("AB")));
    expect(shapes(text("ab cd", 'style="text-transform:capitalize"'))).toEqual(shapes(text("Ab Cd")));
  });

  it("run down the page in vertical text, turned by 90°", () => {
    const [x0, y0, x1, y1] = extent(text("HHHH", 'writing-mode="tb"'));
    expect(x1 - x0).toBe(70);
    expect(x0).toBeLessThan(100);
    expect(x1).toBeGreaterThan(100);
    expect(y0).toBeGreaterThan(400);
    expect(y1 - y0).toBe(width(text("HHHH")));
  });

  it("end at the text's position if they run from the right", () => {
    const [, , x1] = extent(text("HHHH", 'direction="rtl"'));
    expect(x1).toBeLessThan(100);
  });

  it("of a tspan in another language are left out", () => {
    expect(shapes(text('H<tspan systemLanguage="ru">HHH</tspan>'))).toEqual(shapes(text("H")));
    expect(codes(draw(text("H")))).toEqual(["text-substituted"]);
  });
});
