/** Several drawings on one sheet: what is drawn is what each of them would draw where it lies. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { combine, type SheetItem, type SheetSource } from "../../../src/drawing/combine.js";
import type { Drawing } from "../../../src/drawing/drawing.js";
import { compose, rotation, scaling, translation } from "../../../src/geometry/affine.js";
import { prepare, type PrepareSettings } from "../../../src/index.js";
import { clipOf, drawingOf } from "../../support/drawings/drawings.js";
import { cases } from "../../support/runs/full-run.js";

const PAGE = { widthMm: 400, heightMm: 300 };
const SETTINGS: Partial<PrepareSettings> = {
  paper: PAGE,
  marginMm: 0,
  fit: false,
  joinMm: 0,
  order: "none",
  outside: "allow",
  flattenMm: 0.001,
};

const mm = fc.integer({ min: 0, max: 100 });
const COLORS = ["#000000", "#ff0000", "#0000ff"];
const shape = fc.record({
  d: fc
    .array(fc.tuple(mm, mm), { minLength: 2, maxLength: 5 })
    .map((points) => `M${points.map(([x, y]) => `${x} ${y}`).join("L")}`),
  stroke: fc.constantFrom(...COLORS),
  group: fc.nat(1),
  dash: fc.constantFrom(-1, 0),
  clip: fc.constantFrom(-1, 0, 1),
});
const drawing: fc.Arbitrary<Drawing> = fc.array(shape, { minLength: 1, maxLength: 6 }).map((shapes) =>
  drawingOf(shapes, {
    groups: ["Ink", "!Pencil"],
    dashes: [{ lengths: [7, 3], offset: 2 }],
    clips: [clipOf("M5 5L95 5L95 95L5 95Z"), clipOf("M0 0L60 0L0 60Z", 0, 0)],
  }),
);
const map = fc
  .record({
    scale: fc.integer({ min: 2, max: 30 }).map((tenths) => tenths / 10),
    deg: fc.constantFrom(0, 90, 180, 37),
    x: fc.integer({ min: -50, max: 300 }),
    y: fc.integer({ min: -50, max: 200 }),
    mirror: fc.constantFrom(1, -1),
  })
  .map(({ scale, deg, x, y, mirror }) =>
    compose(
      translation(x, y),
      compose(rotation((deg * Math.PI) / 180), compose(scaling(scale), scaling(mirror, 1))),
    ),
  );
const sheet = fc.tuple(fc.array(drawing, { minLength: 1, maxLength: 3 })).chain(([drawings]) =>
  fc.record({
    drawings: fc.constant(drawings),
    items: fc.array(fc.record({ source: fc.nat(drawings.length - 1), map }), { minLength: 1, maxLength: 4 }),
  }),
);

const sourcesOf = (drawings: readonly Drawing[]): SheetSource[] =>
  drawings.map((one, index) => ({ drawing: one, name: `file ${index}`, layerPrefix: `${index}/` }));

/** The strokes of a drawing whose page is mapped to the paper, as text that is the same whatever rounding does. */
const strokesOf = (one: Drawing): string[] => {
  const { xy, offsets, layer, layers } = prepare(one, SETTINGS).strokes;
  return Array.from(layer, (k, i) => {
    const points = Array.from(xy.subarray(2 * offsets[i], 2 * offsets[i + 1]), (v) => (v + 1e-9).toFixed(3));
    return `${layers[k].id} ${points.join(" ")}`.replaceAll("-0.000", "0.000");
  });
};
/** Alone on the sheet: the reference that does not combine anything. */
const aloneOf = (one: Drawing, item: SheetItem): string[] =>
  strokesOf(
    combine([{ drawing: one, name: "", layerPrefix: `${item.source}/` }], [{ ...item, source: 0 }], PAGE),
  );

const lengthOf = (one: Drawing): number => prepare(one, SETTINGS).drawMm;

describe("several drawings combined on a sheet", () => {
  it("draw the strokes of each one where it lies, nothing lost and nothing added", () => {
    fc.assert(
      fc.property(sheet, ({ drawings, items }) => {
        const found = strokesOf(combine(sourcesOf(drawings), items, PAGE));
        const wanted = items.flatMap((item) => aloneOf(drawings[item.source], item));
        expect([...found].sort()).toEqual([...wanted].sort());
      }),
      { numRuns: cases(600, 60) },
    );
  });

  it("draw as much as each one on its own page times its scale", () => {
    fc.assert(
      fc.property(sheet, ({ drawings, items }) => {
        const wanted = items.reduce((sum, { source, map: { a, b } }) => {
          const [one] = [drawings[source]];
          return sum + lengthOf(one) * Math.hypot(a, b);
        }, 0);
        // A clip keeps lines that are within 0.02 mm of its edge, at any scale.
        const off = Math.abs(lengthOf(combine(sourcesOf(drawings), items, PAGE)) - wanted);
        expect(off).toBeLessThan(0.3 * items.length * drawings.length);
      }),
      { numRuns: cases(600, 60) },
    );
  });

  it("keep the paint order: the shapes of a later one are above", () => {
    fc.assert(
      fc.property(sheet, ({ drawings, items }) => {
        const { paths } = combine(sourcesOf(drawings), items, PAGE);
        let at = 0;
        for (const {
          source,
          map: { a, b, c, d, e, f },
        } of items) {
          const own = drawings[source].paths;
          for (let k = 0; k < own.coords.length; k += 2, at += 2) {
            expect(paths.coords[at]).toBe(a * own.coords[k] + c * own.coords[k + 1] + e);
            expect(paths.coords[at + 1]).toBe(b * own.coords[k] + d * own.coords[k + 1] + f);
          }
        }
        expect(at).toBe(paths.coords.length);
      }),
      { numRuns: cases(600, 60) },
    );
  });
});

describe("the layers of a sheet", () => {
  const leaf = drawingOf(
    [
      { d: "M0 0L10 0", group: 0 },
      { d: "M0 5L10 5", group: 1 },
    ],
    {
      groups: ["Ink", "!2+s50Pencil"],
    },
  );
  const here = translation(5, 5);
  const there = translation(50, 5);

  it("are shared by copies, so that each pen is taken once", () => {
    const [source] = sourcesOf([leaf]);
    const copies = combine(
      [source],
      [
        { source: 0, map: here },
        { source: 0, map: there },
      ],
      PAGE,
    );
    expect(copies.groups.map(({ name }) => name)).toEqual(["Ink", "!2+s50Pencil"]);
    const { strokes } = prepare(copies, SETTINGS);
    expect([...strokes.layer]).toEqual([0, 0, 1, 1]);
  });

  it("are those of each drawing, with its name behind the codes, if there are several", () => {
    const sources = [
      { drawing: leaf, name: "leaf", layerPrefix: "" },
      { drawing: leaf, name: "tree", layerPrefix: "2/" },
    ];
    const both = combine(
      sources,
      [
        { source: 0, map: here },
        { source: 1, map: there },
      ],
      PAGE,
    );
    expect(both.groups.map(({ id, name }) => [id, name])).toEqual([
      ["g0", "Ink (leaf)"],
      ["g1", "!2+s50Pencil (leaf)"],
      ["2/g0", "Ink (tree)"],
      ["2/g1", "!2+s50Pencil (tree)"],
    ]);
    // A drawing that is not placed has no layers.
    expect(combine(sources, [{ source: 1, map: here }], PAGE).groups.map(({ name }) => name)).toEqual([
      "Ink",
      "!2+s50Pencil",
    ]);
  });
});

describe("what lies over what on a sheet", () => {
  const square = (fill: string | null): Drawing =>
    drawingOf([{ d: "M0 0L20 0L20 20L0 20Z", fill }], { widthMm: 20, heightMm: 20 });
  const line = drawingOf(["M0 10L40 10"]);

  it("hides lines of a drawing below a filled shape of one above", () => {
    const place = (fill: string | null): number =>
      prepare(
        combine(
          sourcesOf([line, square(fill)]),
          [
            { source: 0, map: translation(0, 0) },
            { source: 1, map: translation(10, 0) },
          ],
          PAGE,
        ),
        { ...SETTINGS, hideCovered: true },
      ).drawMm;
    expect(place(null)).toBeCloseTo(120, 6);
    expect(place("#ffffff")).toBeCloseTo(100, 6);
  });

  it("does not let a page's background hide other drawings, but what it hides in its own", () => {
    const paper = drawingOf([{ d: "M0 0L50 0L50 50L0 50Z", stroke: null, fill: "#ffffff" }, "M0 30L40 30"]);
    const withBackground = (shape: number): Drawing => {
      const background = new Uint8Array(2);
      background[shape] = 1;
      return { ...paper, paths: { ...paper.paths, background } };
    };
    const both = combine(
      sourcesOf([line, withBackground(0)]),
      [
        { source: 0, map: translation(0, 0) },
        { source: 1, map: translation(0, 0) },
      ],
      PAGE,
    );
    expect(prepare(both, { ...SETTINGS, hideCovered: true }).drawMm).toBeCloseTo(80, 6);
  });

  it("cuts off what lies outside a cropped drawing's page, also where it was clipped before", () => {
    const wide = drawingOf([{ d: "M-10 10L50 10" }, { d: "M-10 15L50 15", clip: 0 }], {
      widthMm: 20,
      heightMm: 20,
      clips: [clipOf("M-5 0L10 0L10 20L-5 20Z")],
    });
    const at = (isCropped: boolean): number =>
      prepare(
        combine(sourcesOf([wide]), [{ source: 0, map: translation(100, 0), isCropped }], PAGE),
        SETTINGS,
      ).drawMm;
    expect(at(false)).toBeCloseTo(60 + 15, 6);
    expect(at(true)).toBeCloseTo(20 + 10, 6);
  });
});
