/** Features of text, in the built-in letters: capitals 0.7 em high, small letters 14/30 em. */
import { describe, expect, it } from "vitest";
import { importSvg } from "../../../../src/import/svg/import-svg.js";
import { codes, draw, pointsOf, shapes } from "../../../support/import/shapes.js";

const text = (body: string, attributes = ""): string =>
  `<text x="10" y="50" font-size="10" stroke="none" fill="red" ${attributes}>${body}</text>`;

/** x0, y0, x1, y1 of everything drawn, in tenths of a mm. */
async function extent(body: string): Promise<number[]> {
  const drawing = await draw(body);
  const points = Array.from({ length: drawing.paths.count }, (_, i) => pointsOf(drawing, i)).flat();
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)].map((mm) =>
    Math.round(10 * mm),
  );
}
const bottom = async (body: string): Promise<number> => (await extent(body))[3];
const width = async (body: string): Promise<number> => (await extent(body))[2] - (await extent(body))[0];

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
  ])("with %s capitals end at %d", async (attributes, expected) => {
    const body = text(`<tspan ${attributes}>H</tspan>`);
    expect(Math.abs((await bottom(body)) - expected)).toBeLessThanOrEqual(1);
  });

  it("accumulate shifts of nested elements", async () => {
    expect(await bottom(text('<tspan baseline-shift="2"><tspan baseline-shift="3">H</tspan></tspan>'))).toBe(
      450,
    );
  });
});

describe("decorations", () => {
  it.each([
    ["underline", "M10 51.2L"],
    ["overline", "M10 41L"],
    ["line-through", "M10 47.7L"],
  ])("%s is a line along the text", async (kind, begin) => {
    const plain = await shapes(text("HH"));
    const added = (await shapes(text("HH", `text-decoration="${kind}"`))).filter(
      (shape) => !plain.includes(shape),
    );
    expect(added).toHaveLength(2);
    expect(added[0].startsWith(begin)).toBe(true);
  });

  it("have the colour of the requesting element", async () => {
    const drawing = await draw(text('<tspan fill="blue">H</tspan>', 'text-decoration="underline"'));
    expect(drawing.colors).toEqual(["#ff0000", "#0000ff"]);
  });
});

describe("widths", () => {
  it("have the given textLength, by gaps or by wider letters", async () => {
    const plain = await width(text("HHHH"));
    const gaps = await width(text("HHHH", 'textLength="60"'));
    const glyphs = await width(text("HHHH", 'textLength="60" lengthAdjust="spacingAndGlyphs"'));
    expect([plain, gaps, glyphs].map((tenths) => tenths > 500)).toEqual([false, true, true]);
    const one = await width(text("H"));
    expect(glyphs - one).toBeGreaterThan(400);
    expect(await shapes(text("H", 'textLength="60" lengthAdjust="spacingAndGlyphs"'))).not.toEqual(
      await shapes(text("H")),
    );
  });

  it("apply in a tspan only to its own letters", async () => {
    const all = text('A<tspan textLength="40">HH</tspan>B');
    const [, , x1] = await extent(all);
    expect(x1).toBeGreaterThan((await extent(text("AHHB")))[2] + 150);
  });

  it("ignore lengths that browsers ignore", async () => {
    for (const attributes of ['textLength="0"', 'dominant-baseline="text-top"']) {
      expect(await shapes(text("HH", attributes))).toEqual(await shapes(text("HH")));
    }
  });

  it("grow with word-spacing at each space", async () => {
    expect((await width(text("H H H", 'word-spacing="5"'))) - (await width(text("H H H")))).toBe(100);
  });
});

describe("spaces", () => {
  it.each([
    ["xml:space on a tspan", '<tspan xml:space="preserve">H  H</tspan>', ""],
    ["xml:space around the text", "H  H", 'xml:space="preserve"'],
    ["white-space", '<tspan style="white-space:pre">H  H</tspan>', ""],
  ])("are kept with %s", async (_name, body, attributes) => {
    expect(await width(text(body, attributes))).toBeGreaterThan(await width(text("H  H")));
  });

  it("collapse again inside", async () => {
    const body = text('<tspan xml:space="default">H  H</tspan>', 'xml:space="preserve"');
    expect(await shapes(body)).toEqual(await shapes(text("H H")));
  });
});

describe("letters", () => {
  it("are small capitals on request", async () => {
    expect(await shapes(text("Hh", 'font-variant="small-caps"'))).toEqual(
      await shapes(text('H<tspan font-size="7">H</tspan>')),
    );
  });

  it("are transformed", async () => {
    expect(await shapes(text("ab", 'style="text-transform:uppercase"'))).toEqual(await shapes(text("AB")));
    expect(await shapes(text("ab cd", 'style="text-transform:capitalize"'))).toEqual(
      await shapes(text("Ab Cd")),
    );
  });

  it("run down the page in vertical text, turned by 90°", async () => {
    const [x0, y0, x1, y1] = await extent(text("HHHH", 'writing-mode="tb"'));
    expect(x1 - x0).toBe(70);
    expect(x0).toBeLessThan(100);
    expect(x1).toBeGreaterThan(100);
    expect(y0).toBeGreaterThan(400);
    expect(y1 - y0).toBe(await width(text("HHHH")));
  });

  it("end at the text's position if they run from the right", async () => {
    const [, , x1] = await extent(text("HHHH", 'direction="rtl"'));
    expect(x1).toBeLessThan(100);
  });

  it("of a tspan in another language are left out", async () => {
    expect(await shapes(text('H<tspan systemLanguage="ru">HHH</tspan>'))).toEqual(await shapes(text("H")));
    expect(codes(await draw(text("H")))).toEqual(["text-substituted"]);
  });
});

describe("at the page's edge", () => {
  const reported = async (body: string): Promise<string[]> =>
    codes(await draw(body)).filter((code) => code.startsWith("text-o"));

  it.each([
    ["right", '<text x="90" y="50" font-size="10" fill="red">Wide</text>'],
    ["upper", '<text x="10" y="3" font-size="10" fill="red">High</text>'],
    ["left, by its anchor", '<text x="4" y="50" font-size="10" fill="red" text-anchor="end">Wide</text>'],
    ["lower, turned", '<text transform="translate(50 90) rotate(90)" font-size="10" fill="red">Wide</text>'],
    [
      "right, in a copy",
      '<g id="a"><text x="60" y="50" font-size="9" fill="red">b</text></g><use href="#a" x="37"/>',
    ],
  ])("a text that reaches over the %s one is reported with its place", async (_edge, body) => {
    const { warnings } = await draw(body);
    const warning = warnings.find(({ code }) => code === "text-over-edge");
    expect(warning?.count).toBe(1);
    const [x0, y0, x1, y1] = warning!.boxes[0];
    expect(Math.min(x0, y0, 100 - x1, 100 - y1)).toBeLessThan(-0.1);
    expect(warning?.message).toContain("1 text reaches over the edge of the file's page");
  });

  it("a text within the page, wholly beside it, invisible, or cut by a clip within it is not", async () => {
    const clip = '<clipPath id="c"><rect x="80" y="40" width="19" height="20"/></clipPath>';
    for (const body of [
      '<text x="10" y="50" font-size="10" fill="red">Wide</text>',
      '<text x="120" y="50" font-size="10" fill="red">Wide</text>',
      '<text x="90" y="50" font-size="10" fill="none" stroke="none">Wide</text>',
      `${clip}<text x="90" y="50" font-size="10" fill="red" clip-path="url(#c)">Wide</text>`,
      '<svg x="80" y="40" width="19" height="20"><text y="10" font-size="10" fill="red">Wide</text></svg>',
    ])
      expect(await reported(body), body).toEqual([]);
  });

  it("a text is not reported where the drawing's own extent is the page", async () => {
    const file = '<svg xmlns="http://www.w3.org/2000/svg"><text x="900" y="50" fill="red">Wide</text></svg>';
    expect(codes(await importSvg(file))).not.toContain("text-over-edge");
  });

  it("letters without room on their path are counted", async () => {
    const along = (word: string, attributes = ""): string =>
      `<text font-size="10" fill="red" ${attributes}><textPath path="M10 50H30">${word}</textPath></text>`;
    const { warnings } = await draw(along("OOOOOOOO", 'text-decoration="underline"'));
    const drawn = (await shapes(along("OOOOOOOO"))).length;
    expect(drawn).toBeGreaterThan(1);
    expect(warnings.find(({ code }) => code === "text-off-path")?.count).toBe(8 - drawn);
    expect(await reported(along("O"))).toEqual([]);
    expect(await reported(along("OOOOOOOO", 'visibility="hidden"'))).toEqual([]);
  });
});
