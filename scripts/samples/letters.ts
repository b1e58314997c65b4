/**
 * Outlines as in a font: two words in a round alphabet drawn for this page, each letter built of straight
 * stems and true arcs. The letters cast a hatched shadow down and to the right.
 *
 * Units inside a letter: R = 1 is the radius of the bowl; the baseline is y = 0, y points down.
 */
import { PAGE_HEIGHT_MM, PAGE_WIDTH_MM, mm, pair, polyline, samplePage, type Point } from "./svg.js";

/** A line to a point, or an arc about a centre from one angle to another (growing angles run clockwise). */
type Piece =
  | { readonly to: Point }
  | { readonly center: Point; readonly radius: number; readonly from: number; readonly until: number };
type Outline = readonly Piece[];

interface Letter {
  readonly width: number;
  readonly outlines: readonly Outline[];
}

const STEM = 0.5;
const ASCENT = 1.15;
const DESCENT = 1.05;
const BAR = 0.36;
const ARCH_RADIUS = 0.88;

const line = (...points: Point[]): Piece[] => points.map((to) => ({ to }));
const arc = (center: Point, radius: number, from: number, until: number): Piece => ({ center, radius, from, until });
const ring = (center: Point, radius: number): Outline => [arc(center, radius, 0, 2 * Math.PI)];

/** Where a circle that touches x = 0 from the right crosses the stem's right side, as an angle. */
const crossing = (radius: number): number => Math.acos((STEM - radius) / radius);

/** A stem from `top` to `bottom` on the left of a whole bowl: p, and mirrored a. */
function stemAndBowl(bottom: number): Outline[] {
  const angle = crossing(1);
  return [
    [...line([0, bottom], [0, -2], [STEM, -2]), arc([1, -1], 1, -angle, angle), ...line([STEM, bottom])],
    ring([1, -1], 1 - STEM),
  ];
}

/** A stem with an arch that springs from it: h goes down on the right, r ends in the air. */
function stemAndArch(top: number, ending: "leg" | "cut"): Outline[] {
  const center: Point = [ARCH_RADIUS, ARCH_RADIUS - 2];
  const inner = ARCH_RADIUS - STEM;
  const end = ending === "leg" ? 0 : -0.85;
  const right = 2 * ARCH_RADIUS;
  return [
    [
      ...line([0, 0], [0, top], [STEM, top]),
      arc(center, ARCH_RADIUS, -crossing(ARCH_RADIUS), end),
      ...(ending === "leg" ? line([right, 0], [right - STEM, 0]) : []),
      arc(center, inner, end, -Math.PI),
      ...line([STEM, 0]),
    ],
  ];
}

function letterE(): Outline[] {
  const inner = 1 - STEM;
  const outerBar = Math.asin(BAR / 2);
  const innerBar = Math.asin(BAR / 2 / inner);
  const terminal = 0.66;
  return [
    [arc([1, -1], inner, Math.PI - innerBar, terminal), arc([1, -1], 1, terminal, 2 * Math.PI + outerBar)],
    [arc([1, -1], inner, Math.PI + innerBar, 2 * Math.PI - innerBar)],
  ];
}

const mirrored = (outlines: Outline[], width: number): Outline[] =>
  outlines.map((outline) =>
    outline.map((piece) =>
      "to" in piece
        ? { to: [width - piece.to[0], piece.to[1]] as Point }
        : arc([width - piece.center[0], piece.center[1]], piece.radius, Math.PI - piece.from, Math.PI - piece.until),
    ),
  );

const ALPHABET: Readonly<Record<string, Letter>> = {
  h: { width: 2 * ARCH_RADIUS, outlines: stemAndArch(-2 - ASCENT, "leg") },
  e: { width: 2, outlines: letterE() },
  l: { width: STEM, outlines: [line([0, 0], [0, -2 - ASCENT], [STEM, -2 - ASCENT], [STEM, 0])] },
  o: { width: 2, outlines: [ring([1, -1], 1), ring([1, -1], 1 - STEM)] },
  p: { width: 2, outlines: stemAndBowl(DESCENT) },
  a: { width: 2, outlines: mirrored(stemAndBowl(0), 2) },
  r: { width: ARCH_RADIUS * (1 + Math.cos(0.85)), outlines: stemAndArch(-2, "cut") },
};

/** A letter's outline at its place on the page, as path data and as a fine polygon for the shadow. */
function place(outline: Outline, scale: number, [originX, originY]: Point): { path: string; polygon: Point[] } {
  const at = ([x, y]: Point): Point => [originX + x * scale, originY + y * scale];
  let path = "";
  const polygon: Point[] = [];
  const lineTo = (point: Point): void => {
    path += `${path === "" ? "M" : "L"}${pair(point)}`;
    polygon.push(point);
  };
  for (const piece of outline) {
    if ("to" in piece) {
      lineTo(at(piece.to));
      continue;
    }
    const { center, radius, from, until } = piece;
    const on = (angle: number): Point =>
      at([center[0] + radius * Math.cos(angle), center[1] + radius * Math.sin(angle)]);
    lineTo(on(from));
    // Thirds, because one arc command cannot describe a whole turn.
    for (let third = 1; third <= 3; third++) {
      const end = from + ((until - from) * third) / 3;
      path += `A${mm(radius * scale)} ${mm(radius * scale)} 0 0 ${until > from ? 1 : 0} ${pair(on(end))}`;
    }
    const chords = 120;
    for (let i = 1; i <= chords; i++) polygon.push(on(from + ((until - from) * i) / chords));
  }
  return { path: `${path}Z`, polygon };
}

/**
 * Lines at 45° that begin where they leave a letter and run `lengthMm` or to the next letter.
 * With u = x − y along a line's normal and w = x + y along it, each line is one-dimensional.
 */
function shadow(polygons: readonly Point[][], lengthMm: number, gapMm: number): string[] {
  const paths: string[] = [];
  const reach = lengthMm * Math.SQRT2;
  for (let u = -PAGE_HEIGHT_MM; u < PAGE_WIDTH_MM; u += gapMm * Math.SQRT2) {
    const crossings: number[] = [];
    for (const polygon of polygons) {
      polygon.forEach(([x0, y0], i) => {
        const [x1, y1] = polygon[(i + 1) % polygon.length] ?? [x0, y0];
        const a = x0 - y0 - u;
        const b = x1 - y1 - u;
        if (a < 0 !== b < 0) crossings.push(x0 + y0 + ((x1 + y1 - x0 - y0) * a) / (a - b));
      });
    }
    crossings.sort((a, b) => a - b);
    for (let i = 1; i < crossings.length; i += 2) {
      const from = (crossings[i] ?? 0) + 0.8;
      const until = Math.min(from + reach, (crossings[i + 1] ?? Infinity) - 0.8);
      if (until - from < 0.8) continue;
      paths.push(polyline([[(from + u) / 2, (from - u) / 2], [(until + u) / 2, (until - u) / 2]]));
    }
  }
  return paths;
}

export function letters(): string {
  const scale = 20;
  const gap = 0.3;
  const outlines: string[] = [];
  const polygons: Point[][] = [];
  for (const [word, baseline] of [
    ["hello", 91],
    ["paper", 161],
  ] as const) {
    const glyphs = [...word].map((name) => ALPHABET[name]).filter((glyph) => glyph !== undefined);
    const width = glyphs.reduce((sum, glyph) => sum + glyph.width + gap, -gap) * scale;
    let x = (PAGE_WIDTH_MM - width) / 2 - 3;
    for (const glyph of glyphs) {
      for (const outline of glyph.outlines) {
        const placed = place(outline, scale, [x, baseline]);
        outlines.push(placed.path);
        polygons.push(placed.polygon);
      }
      x += (glyph.width + gap) * scale;
    }
  }
  return samplePage("Hello paper", [
    { name: "Letters", color: "#1b1b1b", paths: outlines },
    { name: "Shadow", color: "#c0392b", paths: shadow(polygons, 5.5, 0.9) },
  ]);
}
