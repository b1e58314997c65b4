/** Small SVGs, one per feature of shapes, paths, transforms, units and viewports; expected mm by hand. */
import { describe, expect, it } from "vitest";
import { importSvg } from "../../../../src/import/svg/import-svg.js";
import { codes, draw, page, pointsOf, shapes, shapesOf } from "../../../support/import/shapes.js";

describe("basic shapes", () => {
  it.each([
    ["line", '<line x1="1" y1="2" x2="3" y2="4"/>', ["M1 2L3 4"]],
    ["line with defaults", '<line x2="3"/>', ["M0 0L3 0"]],
    ["polyline", '<polyline points="1,2 3,4 5 6"/>', ["M1 2L3 4L5 6"]],
    ["polygon", '<polygon points="1 2 3-4,5e0 6"/>', ["M1 2L3 -4L5 6Z"]],
    ["polyline with an odd number", '<polyline points="1 2 3 4 5"/>', ["M1 2L3 4"]],
    ["rect", '<rect x="1" y="2" width="3" height="4"/>', ["M1 2L4 2L4 6L1 6Z"]],
    ["rect without width", '<rect x="1" y="2" height="4"/>', []],
    ["circle without radius", '<circle cx="4" cy="4"/>', []],
    ["ellipse with one radius 0", '<ellipse cx="4" cy="4" rx="3" ry="0"/>', []],
    [
      "rect with rx too large is rounded at half",
      '<rect width="4" height="2" rx="0" ry="9"/>',
      ["M0 0L4 0L4 2L0 2Z"],
    ],
  ])("%s", async (_name, body, expected) => {
    expect(await shapes(body)).toEqual(expected);
  });

  it("keeps a circle to a ten-thousandth of a mm", async () => {
    for (const [x, y] of pointsOf(await draw('<circle cx="50" cy="40" r="30"/>'))) {
      expect(Math.abs(Math.hypot(x - 50, y - 40) - 30)).toBeLessThan(1e-4);
    }
  });

  it("keeps an ellipse on its equation and begins it at the right", async () => {
    const points = pointsOf(await draw('<ellipse cx="50" cy="40" rx="30" ry="10"/>'));
    expect(points[0]).toEqual([80, 40]);
    for (const [x, y] of points) expect(Math.hypot((x - 50) / 30, (y - 40) / 10)).toBeCloseTo(1, 5);
  });

  it("takes one radius of an ellipse for both, as SVG 2 does", async () => {
    for (const [x, y] of pointsOf(await draw('<ellipse cx="50" cy="40" rx="30"/>'))) {
      expect(Math.hypot(x - 50, y - 40)).toBeCloseTo(30, 3);
    }
  });

  it("rounds the corners of a rect, rx standing for ry", async () => {
    const points = pointsOf(await draw('<rect x="10" y="10" width="40" height="20" rx="5"/>'));
    expect(points[0]).toEqual([15, 10]);
    for (const [x, y] of points) {
      const dx = Math.max(15 - x, x - 45, 0);
      const dy = Math.max(15 - y, y - 25, 0);
      if (dx > 0 && dy > 0) expect(Math.hypot(dx, dy)).toBeCloseTo(5, 4);
      else expect(dx === 5 || dy === 5 || Math.abs(Math.max(dx, dy) - 5) < 1e-9).toBe(true);
    }
  });

  it("warns of a negative size", async () => {
    expect(codes(await draw('<rect width="-3" height="4"/>'))).toContain("attribute-fault");
  });
});

describe("path data", () => {
  it.each([
    ["M L H V Z", "M1 2L3 4H9V8Z", "M1 2L3 4L9 4L9 8Z"],
    ["m l h v z", "m1 2l3 4h9v8z", "M1 2L4 6L13 6L13 14Z"],
    ["pairs after M are lines", "M1 2 3 4 5 6", "M1 2L3 4L5 6"],
    ["pairs after m are relative lines", "m1 2 3 4 5 6", "M1 2L4 6L9 12"],
    ["repeated arguments", "M0 0h1 2 3v1 2", "M0 0L1 0L3 0L6 0L6 1L6 3"],
    ["no separators", "M1-2.5.5-3", "M1 -2.5L0.5 -3"],
    ["exponents", "M1e1 2E-1L.5e1+3", "M10 0.2L5 3"],
    ["commas and newlines", "M 1,2\n\tL 3 , 4", "M1 2L3 4"],
    ["C", "M0 0C1 2 3 4 5 6", "M0 0C1 2 3 4 5 6"],
    ["c", "M1 1c1 2 3 4 5 6", "M1 1C2 3 4 5 6 7"],
    ["S mirrors the control", "M0 0C1 2 3 4 5 6S7 8 9 9", "M0 0C1 2 3 4 5 6C7 8 7 8 9 9"],
    ["s after no curve starts at the point", "M1 1s2 2 3 3", "M1 1C1 1 3 3 4 4"],
    ["Q becomes the same cubic", "M0 0Q3 3 6 0", "M0 0C2 2 4 2 6 0"],
    ["T mirrors the control", "M0 0Q3 3 6 0T12 0", "M0 0C2 2 4 2 6 0C8 -2 10 -2 12 0"],
    ["T after no curve is a line", "M0 0T6 3", "M0 0C0 0 2 1 6 3"],
    ["a lone z after m is a dot", "M3 4z", "M3 4L3 4Z"],
    ["a zero line is a dot", "M3 4l0 0", "M3 4L3 4"],
    ["moves alone are left out", "M1 1M2 2L3 3M4 4", "M2 2L3 3"],
    ["after z the pen is at the start", "M1 1h2v2zl1 0", "M1 1L3 1L3 3ZM1 1L2 1"],
    ["after z a relative move is from the start", "m1 1h2v2zm5 5h1", "M1 1L3 1L3 3ZM6 6L7 6"],
    ["subpaths", "M0 0h1M5 5h1", "M0 0L1 0M5 5L6 5"],
    ["arc with a zero radius is a line", "M0 0A0 5 0 0 1 9 9", "M0 0L9 9"],
    ["arc to its own start draws nothing", "M1 1A5 5 0 0 1 1 1L2 2", "M1 1L2 2"],
    ["keeps what comes before a fault", "M0 0L1 1L2", "M0 0L1 1"],
    ["keeps what comes before an unknown letter", "M0 0L1 1K5 5", "M0 0L1 1"],
    ["numbers may have leading zeros", "M007 01L010.50 2", "M7 1L10.5 2"],
  ])("%s", async (_name, d, expected) => {
    expect(await shapes(`<path d="${d}"/>`)).toEqual([expected]);
  });

  it("begins with a move or draws nothing", async () => {
    expect(await shapes('<path d="L1 1"/>')).toEqual([]);
  });

  it.each([
    ["small and clockwise", "0 0 1", [10, 10], 1],
    ["small and anticlockwise", "0 0 0", [20, 20], -1],
  ])("draws an arc that is %s round the right centre", async (_name, flags, centre) => {
    // Quarter circle of radius 10 between (20, 10) and (10, 20).
    for (const [x, y] of pointsOf(await draw(`<path d="M20 10A10 10 ${flags} 10 20"/>`))) {
      expect(Math.hypot(x - centre[0], y - centre[1])).toBeCloseTo(10, 4);
    }
  });

  it("draws the large arc in the long direction", async () => {
    const points = pointsOf(await draw('<path d="M60 50A10 10 0 1 1 50 40"/>'));
    for (const [x, y] of points) expect(Math.hypot(x - 50, y - 50)).toBeCloseTo(10, 4);
    expect(points.some(([x]) => x < 40.01)).toBe(true);
  });

  it("reads compact arc flags", async () => {
    const compact = await shapes('<path d="M0 0a10 10 0 0110 10a5,5 0 1,0.5-3"/>');
    expect(compact).toEqual(await shapes('<path d="M0 0a10 10 0 0 1 10 10a5 5 0 1 0 .5 -3"/>'));
  });

  it("enlarges radii that are too small", async () => {
    for (const [x, y] of pointsOf(await draw('<path d="M10 50A1 1 0 0 1 30 50"/>'))) {
      expect(Math.hypot(x - 20, y - 50)).toBeCloseTo(10, 4);
    }
  });

  it("turns an ellipse by its angle", async () => {
    // Half of the ellipse 20 × 10 turned by 90°: its long axis is vertical.
    const points = pointsOf(await draw('<path d="M50 30A20 10 90 0 1 50 70"/>'));
    expect(Math.max(...points.map(([x]) => x))).toBeCloseTo(60, 3);
  });
});

describe("transforms", () => {
  it.each([
    ["translate", 'transform="translate(3 4)"', "M4 4L5 4"],
    ["translate with one number", 'transform="translate(3)"', "M4 0L5 0"],
    ["scale", 'transform="scale(2)"', "M2 0L4 0"],
    ["scale each", 'transform="scale(2,3)"', "M2 0L4 0"],
    ["rotate", 'transform="rotate(90)"', "M0 1L0 2"],
    ["rotate about a point", 'transform="rotate(180 5 5)"', "M9 10L8 10"],
    ["skewX", 'transform="translate(0 1) skewX(45)"', "M1 1L2 1"],
    ["skewY", 'transform="skewY(45)"', "M1 1L2 2"],
    ["matrix", 'transform="matrix(0 1 -1 0 5 6)"', "M5 7L5 8"],
    ["a list applies from the right", 'transform="translate(10 0) scale(2)"', "M12 0L14 0"],
    ["commas between functions", 'transform="translate(10,0),scale(2)"', "M12 0L14 0"],
    ["no separators", 'transform="translate(1-2)"', "M2 -2L3 -2"],
    ["CSS with units", 'style="transform: translate(10px, 5px) rotate(0.25turn)"', "M10 6L10 7"],
    ["transform-origin", 'transform="rotate(90)" transform-origin="1 0"', "M1 0L1 1"],
    ["none", 'transform="none"', "M1 0L2 0"],
  ])("%s", async (_name, attributes, expected) => {
    expect(await shapes(`<path d="M1 0H2" ${attributes}/>`)).toEqual([expected]);
  });

  it("nests", async () => {
    expect(
      await shapes(
        '<g transform="translate(10 20)"><g transform="scale(2)"><path d="M1 1h1" transform="rotate(90)"/></g></g>',
      ),
    ).toEqual(["M8 22L8 24"]);
  });

  it("ignores a malformed transform and reports it", async () => {
    const drawing = await draw('<path d="M1 0H2" transform="rotate(90,)scale("/>');
    expect(shapesOf(drawing)).toEqual(["M1 0L2 0"]);
    expect(codes(drawing)).toEqual(["attribute-fault"]);
  });

  it("draws nothing that is scaled to zero", async () => {
    expect(await shapes('<g transform="scale(0)"><path d="M1 0H2"/></g>')).toEqual([]);
  });

  it("turns by quarters without rounding", async () => {
    const { coords } = (await draw('<path transform="rotate(270)" d="M1 0H2"/>')).paths;
    expect([...coords]).toEqual([0, -1, 0, -2]);
  });
});

describe("units and viewports", () => {
  it.each([
    ["mm", 'width="210mm" height="297mm"', 210, 297],
    ["cm", 'width="21cm" height="29.7cm"', 210, 297],
    ["in", 'width="8.5in" height="11in"', 215.9, 279.4],
    ["pt", 'width="72pt" height="36pt"', 25.4, 12.7],
    ["pc", 'width="6pc" height="12pc"', 25.4, 50.8],
    ["px", 'width="96px" height="192px"', 25.4, 50.8],
    ["no unit", 'width="96" height="192"', 25.4, 50.8],
    ["Q", 'width="40Q" height="80Q"', 10, 20],
    ["viewBox alone is px", 'viewBox="0 0 96 192"', 25.4, 50.8],
    ["percent with a viewBox", 'width="100%" height="100%" viewBox="0 0 96 192"', 25.4, 50.8],
    ["width alone keeps the ratio", 'width="50mm" viewBox="0 0 10 20"', 50, 100],
    ["height alone keeps the ratio", 'height="50mm" viewBox="0 0 10 20"', 25, 50],
    ["CSS width before the attribute", 'width="10mm" height="10mm" style="width:20mm"', 20, 10],
    ["a size of zero is ignored", 'width="0" height="0" viewBox="0 0 96 96"', 25.4, 25.4],
  ])("page size in %s", async (_name, attributes, width, height) => {
    const drawing = await importSvg(`<svg ${attributes}><path stroke="red" d="M0 0h1"/></svg>`);
    expect(drawing.widthMm).toBeCloseTo(width, 9);
    expect(drawing.heightMm).toBeCloseTo(height, 9);
  });

  it.each([
    ["mm", "10mm", 10],
    ["cm", "1cm", 10],
    ["in", "1in", 25.4],
    ["pt", "72pt", 25.4],
    ["pc", "6pc", 25.4],
    ["%", "50%", 50.8],
    ["em", "2em", (2 * 16 * 25.4) / 96],
    ["ex", "2ex", (16 * 25.4) / 96],
    ["rem", "1rem", (16 * 25.4) / 96],
  ])("lengths in %s", async (_unit, x, mm) => {
    const drawing = await importSvg(`<svg width="384" height="192"><line stroke="red" x2="${x}"/></svg>`);
    expect(drawing.paths.coords[2]).toBeCloseTo(mm, 9);
  });

  it("takes em from the inherited font size", async () => {
    const text =
      '<svg width="96" height="96" font-size="10"><g font-size="2em"><line stroke="red" x2="1em"/></g></svg>';
    expect((await importSvg(text)).paths.coords[2]).toBeCloseTo((20 * 25.4) / 96, 9);
  });

  it("takes percentages of radii from the diagonal", async () => {
    const points = pointsOf(await draw('<circle cx="50%" cy="50%" r="10%"/>'));
    expect(points[0][0]).toBeCloseTo(60, 6);
  });

  it("uses another resolution for px on request, and leaves mm unchanged", async () => {
    const px = await importSvg('<svg width="72" height="72"><path stroke="red" d="M0 0h72"/></svg>', {
      pxPerInch: 72,
    });
    expect(px.widthMm).toBeCloseTo(25.4, 9);
    expect(px.paths.coords[2]).toBeCloseTo(25.4, 9);
    const mm = await importSvg('<svg width="10mm" height="10mm" viewBox="0 0 1 1"/>', { pxPerInch: 72 });
    expect(mm.widthMm).toBe(10);
  });

  it("takes the page from the drawing if the file has none, and reports that", async () => {
    const drawing = await importSvg('<svg><path stroke="red" d="M96 96h96v192"/></svg>');
    expect(drawing.widthMm).toBeCloseTo(25.4, 9);
    expect(drawing.heightMm).toBeCloseTo(50.8, 9);
    expect(shapesOf(drawing)).toEqual(["M0 0L25.4 0L25.4 50.8"]);
    expect(codes(drawing)).toEqual(["page-size"]);
  });

  it("shifts by the viewBox's corner", async () => {
    const text =
      '<svg width="10mm" height="10mm" viewBox="-50 -50 100 100"><path stroke="red" d="M0 0h50"/></svg>';
    expect(shapesOf(await importSvg(text))).toEqual(["M5 5L10 5"]);
  });

  it.each([
    ["", "M50 0L150 0"],
    ["xMidYMid meet", "M50 0L150 0"],
    ["xMinYMin", "M0 0L100 0"],
    ["xMaxYMax", "M100 0L200 0"],
    ["none", "M0 0L200 0"],
    ["xMidYMid slice", "M0 -50L200 -50"],
    ["xMinYMax slice", "M0 -100L200 -100"],
  ])("preserveAspectRatio %s", async (aspect, expected) => {
    const text = `<svg width="200mm" height="100mm" viewBox="0 0 10 10" preserveAspectRatio="${aspect}"><path stroke="red" d="M0 0h10"/></svg>`;
    expect(shapesOf(await importSvg(text))).toEqual([expected]);
  });

  it("places a nested svg with its own viewBox", async () => {
    const body = '<svg x="10" y="20" width="40" height="40" viewBox="0 0 10 10"><path d="M0 0h5"/></svg>';
    expect(await shapes(body)).toEqual(["M10 20L30 20"]);
  });

  it("takes percentages from the nested viewport", async () => {
    expect(await shapes('<svg x="10" width="40" height="20"><line x2="100%" y2="50%"/></svg>')).toEqual([
      "M10 0L50 10",
    ]);
  });

  it("cuts a nested svg to its viewport, unless it overflows", async () => {
    const nested = (more: string): string =>
      `<svg x="10" y="10" width="20" height="20" ${more}><path d="M-5 5h50"/></svg>`;
    const cut = await draw(nested(""));
    expect(cut.clips.length).toBe(1);
    expect([...cut.clips[0].coords]).toEqual([10, 10, 30, 10, 30, 30, 10, 30]);
    expect((await draw(nested('overflow="visible"'))).clips.length).toBe(0);
  });

  it("omits a clip that cuts nothing", async () => {
    expect((await draw('<svg x="10" y="10" width="20" height="20"><path d="M5 5h5"/></svg>')).clips).toEqual(
      [],
    );
  });

  it("keeps the precision of curves in tiny user units", async () => {
    const text =
      '<svg width="100mm" height="100mm" viewBox="0 0 1 1"><circle stroke="red" cx=".5" cy=".5" r=".4"/></svg>';
    for (const [x, y] of pointsOf(await importSvg(text))) {
      expect(Math.abs(Math.hypot(x - 50, y - 50) - 40)).toBeLessThan(2e-4);
    }
  });

  it("reads elements with SVG's prefix", async () => {
    const text =
      '<s:svg xmlns:s="http://www.w3.org/2000/svg" width="96" height="96"><s:path stroke="red" d="M0 0h96"/></s:svg>';
    expect(shapesOf(await importSvg(text))).toEqual(["M0 0L25.4 0"]);
  });

  it("skips a byte order mark and blank lines before the XML declaration", async () => {
    const text = `\ufeff\n<?xml version="1.0"?>${page('<path d="M0 0h1"/>')}`;
    expect(shapesOf(await importSvg(text))).toEqual(["M0 0L1 0"]);
  });
});
