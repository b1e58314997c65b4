/** True size = px × 25.4 / px per inch, for any page in px and everything on it. */
import fc from "fast-check";
import { expect, it } from "vitest";
import { importSvg, prepare, type Drawing } from "../../../../src/index.js";
import { withPxPerInch } from "../../../../src/drawing/px-size.js";
import { boxOfPoints } from "../../../../src/geometry/box.js";
import { cases } from "../../../support/runs/full-run.js";

/** A page is at least 1 mm wide. */
const side = fc.oneof(fc.integer({ min: 60, max: 6_000 }), fc.double({ min: 60, max: 6_000, noNaN: true }));
const pxPerInch = fc.oneof(
  fc.constantFrom(72, 90, 96, 150, 300, 600),
  fc.double({ min: 20, max: 1_200, noNaN: true }),
);
const page = fc.record({ width: side, height: side, withSize: fc.boolean(), withBox: fc.boolean() });

const svgOf = ({
  width,
  height,
  withSize,
  withBox,
}: {
  width: number;
  height: number;
  withSize: boolean;
  withBox: boolean;
}): string =>
  `<svg xmlns="http://www.w3.org/2000/svg"${withSize ? ` width="${width}px" height="${height}"` : ' width="100%"'}${
    withBox ? ` viewBox="0 0 ${width} ${height}"` : ""
  }><clipPath id="c"><path d="M0 0H${width}V${height / 2}H0Z"/></clipPath>
  <g fill="none" stroke="#000" stroke-width="2" stroke-dasharray="${width / 5} ${width / 9}" stroke-dashoffset="1">
    <path d="M0 0L${width} ${height}" clip-path="url(#c)"/>
    <path d="M0 0C${width} 0 0 ${height} ${width} ${height}" transform="scale(1 .5)"/></g>
  <rect width="${width}" height="${height}" fill="none" stroke="#00f"/><image href="a.png" width="${width}" height="9"/></svg>`;

const close = (a: number, b: number): boolean => Math.abs(a - b) <= 1e-9 * (1 + Math.abs(a) + Math.abs(b));

it("is so for any page", async () => {
  await fc.assert(
    fc.asyncProperty(page, pxPerInch, async (px, perInch) => {
      const drawing = await importSvg(svgOf(px));
      const { size, strokes } = prepare(drawing, {
        pxPerInch: perInch,
        fit: false,
        outside: "allow",
        rotateDeg: 0,
        joinMm: 0,
      });
      const { x0, x1, y0, y1 } = boxOfPoints(strokes.xy);
      expect(x1 - x0).toBeCloseTo((px.width * 25.4) / perInch, 6);
      expect(y1 - y0).toBeCloseTo((px.height * 25.4) / perInch, 6);
      expect(close(size.scaleX, 1) && close(size.scaleY, 1)).toBe(true);
    }),
    { numRuns: cases(1_000, 100) },
  );
});

/** All lengths of a drawing, and what else the px per inch decide. */
const lengthsOf = ({ widthMm, heightMm, dashes, clips, paths, warnings }: Drawing): number[] => [
  widthMm,
  heightMm,
  ...paths.coords,
  ...clips.flatMap(({ coords }) => [...coords]),
  ...dashes.flatMap(({ lengths, offset, measure }) => {
    // Stretched dashes are as long as they are measured.
    const factor = measure === undefined ? 1 : 1 / Math.hypot(measure.a, measure.b, measure.c, measure.d);
    return [...lengths, offset].map((length) => length * factor);
  }),
  ...warnings.flatMap(({ boxes }) => boxes.flat()),
];

it("gives the same drawing as reading the file with them", async () => {
  await fc.assert(
    fc.asyncProperty(page, pxPerInch, async (px, perInch) => {
      const read = await importSvg(svgOf(px), { pxPerInch: perInch });
      const set = withPxPerInch(await importSvg(svgOf(px)), perInch);
      const [a, b] = [lengthsOf(read), lengthsOf(set)];
      expect(a.length).toBe(b.length);
      expect(a.filter((mm, i) => !close(mm, b[i]))).toEqual([]);
      set.paths.strokeWidth.forEach((mm, i) => expect(mm).toBeCloseTo(read.paths.strokeWidth[i], 4));
      expect([set.pageFrom, set.pxPerInch]).toEqual([read.pageFrom, read.pxPerInch]);
      expect(set.warnings.map(({ code }) => code)).toEqual(read.warnings.map(({ code }) => code));
    }),
    { numRuns: cases(1_000, 100) },
  );
});
