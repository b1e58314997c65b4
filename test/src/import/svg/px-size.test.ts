/** The size of SVG files whose page is given in px: 72, 90, 96, 150 or 300 px per inch. */
import { describe, expect, it } from "vitest";
import { DEFAULT_PREPARE, PAPER_SIZES, importSvg, prepare } from "../../../../src/index.js";
import { otherPapers, prepareJob, withPxPerInch, type PaperName } from "../../../../src/internal.js";
import { machineById } from "../../../../src/machines/profiles.js";
import { NO_PENS } from "../../../../src/prepare/layers/pens.js";
import { DEFAULT_MOTION } from "../../../../src/settings/motion.js";
import { DEFAULT_PEN } from "../../../../src/settings/pen.js";

const SVG = 'xmlns="http://www.w3.org/2000/svg"';
/** A line of 100 px, below what the writer puts before the root element. */
const svgOf = (attributes: string, before = ""): string =>
  `${before}<svg ${SVG} ${attributes}><path d="M0 10H100" fill="none" stroke="#000"/></svg>`;
const sized = (width: number, height: number): string =>
  `width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"`;
const boxed = (width: number, height: number): string => `viewBox="0 0 ${width} ${height}"`;

const ILLUSTRATOR = `<?xml version="1.0" encoding="utf-8"?>
<!-- Generator: Adobe Illustrator 24.0.1, SVG Export Plug-In . SVG Version: 6.00 Build 0)  -->
`;
/** Illustrator's own data come with entities. */
const ENTITIES = `<?xml version="1.0"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd" [
  <!ENTITY ns_ai "http://ns.adobe.com/AdobeIllustrator/10.0/"> ]>
`;
const INKSCAPE =
  'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"';
const SERIF = 'xmlns:serif="http://www.serif.com/"';

/** px per inch as the drawing has them: its line of 100 px, whatever its page says. */
const pxPerInchOf = async (svg: string): Promise<number> =>
  Math.round((100 / (await importSvg(svg)).paths.coords[2]) * 25.4);
const notes = async (svg: string): Promise<string[]> =>
  (await importSvg(svg)).warnings.map(({ message }) => message);

describe("the writer's px", () => {
  it.each([
    ["Illustrator's comment", svgOf(sized(595.28, 841.89), ILLUSTRATOR), 72, "210 × 297 mm at 72"],
    [
      "its namespace",
      svgOf(`${sized(841.89, 1190.55)} xmlns:i="&ns_ai;"`, ENTITIES),
      72,
      "297 × 420 mm at 72",
    ],
    [
      "its layer names",
      svgOf(`id="Layer_1" data-name="Layer 1" ${boxed(612, 792)}`),
      72,
      "215.9 × 279.4 mm at 72",
    ],
    [
      "its layer names in a layer",
      svgOf(`id="Ebene_2" ${boxed(595.28, 841.89)}`).replace(
        /(<path.*\/>)/,
        '<g id="Ebene_1-2" data-name="Ebene 1">$1</g>',
      ),
      72,
      "210 × 297 mm at 72",
    ],
    [
      "its comment behind the root element",
      svgOf(`id="Layer_1" version="1.1" ${boxed(612, 792)}`).replace(
        "><path",
        `>\n  ${ILLUSTRATOR.split("\n")[1]}\n<path`,
      ),
      72,
      "215.9 × 279.4 mm at 72",
    ],
    [
      "Inkscape 0.48's version",
      svgOf(`${INKSCAPE} inkscape:version="0.48.4 r9939" width="744.09448819" height="1052.3622047"`),
      90,
      "210 × 297 mm at 90",
    ],
    [
      "Inkscape 0.91's version",
      svgOf(`${INKSCAPE} inkscape:version="0.91 r13725" ${sized(765, 990)}`),
      90,
      "215.9 × 279.4 mm at 90",
    ],
    [
      "Sodipodi's version",
      svgOf(`${INKSCAPE} sodipodi:version="0.34" ${sized(900, 900)}`),
      90,
      "254 × 254 mm at 90",
    ],
    [
      "Affinity's A4 at 300",
      svgOf(`${SERIF} width="100%" height="100%" ${boxed(2480, 3508)}`),
      300,
      "210 × 297 mm at 300",
    ],
    [
      "Affinity's A3 at 72",
      svgOf(`${SERIF} width="100%" height="100%" ${boxed(1191, 842)}`),
      72,
      "420.2 × 297 mm at 72",
    ],
    [
      "Affinity's Letter at 96",
      svgOf(`${SERIF} width="100%" height="100%" ${boxed(816, 1056)}`),
      96,
      "215.9 × 279.4 mm at 96",
    ],
    ["Affinity's A4 at 150", svgOf(`${SERIF} ${sized(1240, 1754)}`), 150, "210 × 297 mm at 150"],
  ])("is taken from %s, and the size is said", async (_what, svg, pxPerInch, size) => {
    expect(await pxPerInchOf(svg)).toBe(pxPerInch);
    expect(await notes(svg)).toEqual([expect.stringContaining(`(${size} px per inch; written by `)]);
    // At true size on paper that it fits.
    const { size: drawn } = prepare(await importSvg(svg), {
      paper: PAPER_SIZES.A3,
      landscape: false,
      rotateDeg: "auto",
    });
    expect(drawn.scaleX).toBeCloseTo(1, 3);
  });

  it("is CSS's if Inkscape from 0.92 on has written the file again", async () => {
    for (const version of ["0.92.4 (5da689c313, 2019-01-14)", "1.3.2 (091e20e, 2023-11-25)"]) {
      const svg = svgOf(
        `${INKSCAPE} ${SERIF} sodipodi:version="0.32" inkscape:version="${version}" ${sized(500, 500)}`,
        ILLUSTRATOR,
      );
      expect([await pxPerInchOf(svg), await notes(svg)]).toEqual([96, []]);
    }
  });

  it("is not asked for on a page in real units", async () => {
    for (const [size, mm] of [
      ["210mm", 210],
      ["21cm", 210],
      ["8.5in", 215.9],
      ["612pt", 215.9],
      ["51pc", 215.9],
    ] as const) {
      for (const writer of [SERIF, `${INKSCAPE} inkscape:version="0.91"`, 'data-name="a"']) {
        const drawing = await importSvg(
          svgOf(`${writer} width="${size}" height="${size}" viewBox="0 0 100 100"`, ILLUSTRATOR),
        );
        expect([drawing.widthMm, drawing.pxPerInch]).toEqual([mm, undefined]);
        expect(drawing.paths.coords[2]).toBeCloseTo(mm, 9);
        expect(drawing.warnings).toEqual([]);
      }
    }
  });

  it("is that of the lines too, on a page in mm without a viewBox", async () => {
    const svg = svgOf(`${INKSCAPE} inkscape:version="0.48.4" width="210mm" height="297mm"`);
    expect([(await importSvg(svg)).widthMm, await pxPerInchOf(svg)]).toEqual([210, 90]);
    expect(await notes(svg)).toEqual([expect.stringContaining("210 × 297 mm at 90 px per inch")]);
  });

  it("is said to be unknown if Affinity's page is no paper", async () => {
    const svg = svgOf(`${SERIF} width="100%" height="100%" ${boxed(1000, 1000)}`);
    expect(await notes(svg)).toEqual([
      expect.stringContaining("(only its proportions are known; written by Affinity)"),
    ]);
    expect((await importSvg(svg)).pageFrom).toBe("proportions");
  });

  it("is not taken from a comment further down, or from names without layers", async () => {
    for (const svg of [
      svgOf(sized(500, 500)).replace("</svg>", "<!-- Generator: Adobe Illustrator --></svg>"),
      svgOf(`id="chart" ${sized(500, 500)}`).replace("<path", '<g id="a_1" data-name="a"/><path'),
    ])
      expect([await pxPerInchOf(svg), await notes(svg)]).toEqual([96, []]);
  });
});

describe("a page in px that would be a paper", () => {
  it.each([72, 90, 150, 300])("is offered as each paper at %i px per inch", async (pxPerInch) => {
    for (const name of ["A5", "A4", "A3", "Letter", "Legal"] satisfies PaperName[]) {
      const { widthMm, heightMm } = PAPER_SIZES[name];
      const [width, height] = [heightMm, widthMm].map((mm) => Math.round((mm / 25.4) * pxPerInch));
      const drawing = await importSvg(svgOf(sized(width, height)));
      expect(otherPapers(drawing)).toContainEqual({ name, pxPerInch });
      expect(drawing.warnings.map(({ message }) => message)).toEqual([
        expect.stringContaining(`; --px-per-inch ${pxPerInch} gives ${name}`),
      ]);
      const { widthMm: wide, heightMm: high } = withPxPerInch(drawing, pxPerInch);
      expect(Math.abs(wide - heightMm)).toBeLessThan(0.3);
      expect(Math.abs(high - widthMm)).toBeLessThan(0.3);
    }
  });

  it("is offered at 96 too if only its proportions are known", async () => {
    const drawing = await importSvg(svgOf(boxed(794, 1123)));
    expect(otherPapers(drawing)).toEqual([{ name: "A4", pxPerInch: 96 }]);
    const { size } = prepare(drawing, { pxPerInch: 96 });
    expect(size).toMatchObject({ scaleX: 1, scaleY: 1 });
  });

  it.each([
    ["a paper at 96", sized(794, 1123)],
    ["no paper", sized(500, 500)],
    ["in mm", 'width="595mm" height="842mm" viewBox="0 0 595 842"'],
    ["the drawing's extent", ""],
  ])("is not offered if it is %s", async (_what, attributes) => {
    const drawing = await importSvg(svgOf(attributes));
    expect(otherPapers(drawing)).toEqual([]);
    expect(drawing.warnings.filter(({ code }) => code === "px-per-inch")).toEqual([]);
  });
});

describe("the setting for px per inch", () => {
  const plotted = async (svg: string, pxPerInch: number | "auto") =>
    prepareJob(
      await importSvg(svg),
      {
        prepare: { ...DEFAULT_PREPARE, paper: PAPER_SIZES.A3, pxPerInch },
        motion: DEFAULT_MOTION,
        pen: DEFAULT_PEN,
        ...NO_PENS,
      },
      machineById("axidraw-v3-a3"),
    );

  it("overrides the guess, and its note disappears", async () => {
    const svg = svgOf(sized(300, 300), ILLUSTRATOR);
    const guessed = await plotted(svg, "auto");
    expect(guessed.prepared.size.widthMm).toBeCloseTo((100 * 25.4) / 72, 6);
    expect(guessed.warnings.join()).toContain("105.8 × 105.8 mm at 72 px per inch");
    const set = await plotted(svg, 96);
    expect(set.prepared.size).toMatchObject({ scaleX: 1 });
    expect(set.prepared.size.widthMm).toBeCloseTo((100 * 25.4) / 96, 6);
    expect(set.warnings).toEqual([]);
  });

  it("tells the scale of a viewBox without a size, so that it is drawn at true size", async () => {
    const svg = svgOf(boxed(300, 300));
    expect((await plotted(svg, "auto")).prepared.size.widthMm).toBeGreaterThan(50);
    expect((await plotted(svg, 72)).prepared.size.widthMm).toBeCloseTo((100 * 25.4) / 72, 6);
    expect((await plotted(svg, 300)).prepared.size.widthMm).toBeCloseTo((100 * 25.4) / 300, 6);
  });

  it("applies to a file without any page", async () => {
    expect((await plotted(svgOf(""), 50)).prepared.size.widthMm).toBeCloseTo(50.8, 6);
  });

  it("changes nothing on a page in mm, and in formats without px", async () => {
    const mm = svgOf('width="200mm" height="200mm" viewBox="0 0 200 200"');
    expect((await plotted(mm, 10)).prepared.size).toEqual((await plotted(mm, "auto")).prepared.size);
  });

  it("is refused with its range if it is no number", async () => {
    await expect(async () => prepare(await importSvg(svgOf("")), { pxPerInch: 0 })).rejects.toThrow(
      /pxPerInch.*"auto", or 1 to 10000 px\/in/,
    );
  });
});
