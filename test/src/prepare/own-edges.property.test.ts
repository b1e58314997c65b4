/** A line on the edge of its own clip, mask or cover is drawn whole, however the same curve is written there. */
import fc from "fast-check";
import { expect, it } from "vitest";
import { strokeCount } from "../../../src/drawing/stroke-set.js";
import { importSvg } from "../../../src/import/svg/import-svg.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { DEFAULT_PREPARE, type PrepareSettings } from "../../../src/settings/prepare.js";
import { cases } from "../../support/runs/full-run.js";

type Point = readonly [x: number, y: number];
type Cubic = readonly [Point, Point, Point, Point];

const coordinate = fc.double({ min: 5, max: 95, noNaN: true });
/** All over the page: points that lie near each other give outlines that go back over themselves, without an area. */
const place: fc.Arbitrary<Point> = fc.noShrink(fc.noBias(fc.tuple(coordinate, coordinate)));

/** A closed curve, which often crosses itself. */
const closedCurve: fc.Arbitrary<Cubic[]> = fc
  .array(fc.tuple(place, place, place), { minLength: 2, maxLength: 6 })
  .map((parts) => parts.map(([from, a, b], k) => [from, a, b, parts[(k + 1) % parts.length][0]] as const));

const polygon: fc.Arbitrary<Cubic[]> = fc
  .array(place, { minLength: 3, maxLength: 12 })
  .map((corners) => corners.map((p, k) => straight(p, corners[(k + 1) % corners.length])));

const straight = (p: Point, q: Point): Cubic => [p, between(p, q, 1 / 3), between(p, q, 2 / 3), q];
const between = ([x0, y0]: Point, [x1, y1]: Point, t: number): Point => [
  x0 + t * (x1 - x0),
  y0 + t * (y1 - y0),
];

/** An ellipse and its arc from one angle through two others and back, in degrees; `turn` rotates it. */
const ellipse = fc.record({
  radii: fc.tuple(fc.double({ min: 2, max: 45, noNaN: true }), fc.double({ min: 2, max: 45, noNaN: true })),
  turn: fc.integer({ min: 0, max: 180 }),
  angles: fc.tuple(
    fc.integer({ min: 0, max: 110 }),
    fc.integer({ min: 120, max: 230 }),
    fc.integer({ min: 240, max: 350 }),
  ),
});

/** A round shape with bulges, which does not cross itself. */
const blob: fc.Arbitrary<Cubic[]> = fc
  .array(fc.double({ min: 0.7, max: 1.3, noNaN: true }), { minLength: 5, maxLength: 12 })
  .chain((radii) => fc.double({ min: 2, max: 35, noNaN: true }).map((size) => radii.map((r) => r * size)))
  .map((radii) => {
    const n = radii.length;
    const arm = (4 / 3) * Math.tan(Math.PI / (2 * n));
    const at = (k: number, side: number): Point => {
      const angle = (2 * Math.PI * k) / n;
      const r = radii[k % n];
      return [
        50 + r * (Math.cos(angle) - side * arm * Math.sin(angle)),
        50 + r * (Math.sin(angle) + side * arm * Math.cos(angle)),
      ];
    };
    return radii.map((_, k): Cubic => [at(k, 0), at(k, 1), at(k + 1, -1), at(k + 1, 0)]);
  });

interface Twins {
  readonly line: string;
  /** The same shape, written in another way. */
  readonly twin: string;
  readonly crossesItself: boolean;
}

const ofCurve = (curves: fc.Arbitrary<Cubic[]>, crossesItself: boolean): fc.Arbitrary<Twins> =>
  fc
    .tuple(curves, fc.nat(11), fc.double({ min: 0.05, max: 0.95, noNaN: true }), fc.boolean())
    .map(([curve, begin, t, isReversed]) => ({
      line: pathOf(curve),
      twin: pathOf(otherwise(curve, begin, t, isReversed)),
      crossesItself,
    }));

const twins: fc.Arbitrary<Twins> = fc.oneof(
  ofCurve(fc.oneof(closedCurve, polygon), true),
  ofCurve(blob, false),
  ellipse.map(({ radii: [rx, ry], turn, angles }) => {
    const at = (degrees: number): string => {
      const [a, b] = [(degrees * Math.PI) / 180, (turn * Math.PI) / 180];
      const [x, y] = [rx * Math.cos(a), ry * Math.sin(a)];
      return `${50 + x * Math.cos(b) - y * Math.sin(b)} ${50 + x * Math.sin(b) + y * Math.cos(b)}`;
    };
    const arcs = [...angles.slice(1), angles[0] + 360].map((angle, k) => {
      const isLarge = angle - angles[k] > 180;
      return `A${rx} ${ry} ${turn} ${isLarge ? 1 : 0} 1 ${at(angle)}`;
    });
    return {
      line: `<ellipse cx="50" cy="50" rx="${rx}" ry="${ry}" transform="rotate(${turn} 50 50)"/>`,
      twin: `<path d="M${at(angles[0])}${arcs.join("")}Z"/>`,
      crossesItself: false,
    };
  }),
);

/** The same curve, each part divided at `t`, begun elsewhere, and perhaps backwards. */
function otherwise(curve: readonly Cubic[], begin: number, t: number, isReversed: boolean): Cubic[] {
  const divided = curve.flatMap(([p, a, b, q]): Cubic[] => {
    const [pa, ab, bq] = [between(p, a, t), between(a, b, t), between(b, q, t)];
    const [left, right] = [between(pa, ab, t), between(ab, bq, t)];
    const middle = between(left, right, t);
    return [
      [p, pa, left, middle],
      [middle, right, bq, q],
    ];
  });
  const first = begin % divided.length;
  const begun = [...divided.slice(first), ...divided.slice(0, first)];
  return isReversed ? begun.reverse().map(([p, a, b, q]) => [q, b, a, p]) : begun;
}

const pathOf = (curve: readonly Cubic[]): string =>
  `<path d="M${curve[0][0].join(" ")}${curve.map((c) => `C${c.slice(1).flat().join(" ")}`).join("")}Z"/>`;

async function drawn(body: string, settings: PrepareSettings): Promise<{ strokes: number; mm: number }> {
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">${body}</svg>`;
  const { strokes, drawMm } = prepare(await importSvg(svg), settings);
  return { strokes: strokeCount(strokes), mm: drawMm };
}

/** How the shape is turned and squeezed around the page's middle. */
const transform = fc.option(
  fc
    .tuple(fc.integer({ min: 0, max: 359 }), fc.constantFrom(0.3, 0.7), fc.constantFrom(-0.5, 0.7))
    .map(([degrees, x, y]) => `translate(50 50) rotate(${degrees}) scale(${x} ${y}) translate(-50 -50)`),
  { nil: "" },
);

it("draws a line whole that is clipped, masked or covered by its own shape", async () => {
  await fc.assert(
    fc.asyncProperty(
      twins,
      fc.constantFrom(100, 30, 400),
      fc.double({ min: -0.0004, max: 0.0004, noNaN: true }),
      fc.record({ isSwapped: fc.boolean(), isDashed: fc.boolean(), map: transform }),
      async ({ line, twin, crossesItself }, paperMm, shift, { isSwapped, isDashed, map }) => {
        const settings: PrepareSettings = {
          ...DEFAULT_PREPARE,
          paper: { widthMm: paperMm, heightMm: paperMm },
          fit: true,
          marginMm: 1,
          outlineFills: false,
          hideCovered: true,
          order: "none",
        };
        const [own, other] = isSwapped ? [twin, line] : [line, twin];
        const dash = isDashed ? 'stroke-dasharray="4 1.3"' : "";
        const stroked = `<g fill="none" stroke="black" ${dash} transform="${map}">${own}</g>`;
        const at = `transform="${map} translate(${shift} ${-shift})"`;
        const bodies: Record<string, string> = {
          clip: `<clipPath id="e" ${at}>${other}</clipPath><g clip-path="url(#e)">${stroked}</g>`,
          mask: `<mask id="e" fill="white" maskUnits="userSpaceOnUse" x="0" y="0" width="100" height="100"><g ${at}>${other}</g></mask><g mask="url(#e)">${stroked}</g>`,
        };
        const path = /(?<= d=")[^"]*/.exec(other)?.[0];
        if (path !== undefined)
          bodies["CSS"] = stroked.replace("<g", `<g style="clip-path: path('${path}') view-box"`);
        // Where a line crosses itself, a part of it is inside, and two of its clips together may cut a thin tip off.
        if (!crossesItself) {
          bodies["nested"] =
            `<clipPath id="o" transform="${map}">${own}</clipPath><clipPath id="e" ${at} clip-path="url(#o)">${other}</clipPath><g clip-path="url(#e)">${stroked}</g>`;
          bodies["hole"] =
            `<mask id="e" maskUnits="userSpaceOnUse" x="0" y="0" width="100" height="100"><path d="M0 0H100V100H0Z" fill="white"/><g ${at}>${other}</g></mask><g mask="url(#e)">${stroked}</g>`;
          bodies["cover"] = `${stroked}<g fill="white" ${at}>${other}</g>`;
        }
        // The page's frame keeps the scale.
        const framed = (body: string): ReturnType<typeof drawn> =>
          drawn(`${body}<path d="M0 0H100V100H0Z" fill="none" stroke="black"/>`, settings);
        const whole = await framed(stroked);
        for (const [kind, body] of Object.entries(bodies)) {
          const { strokes, mm } = await framed(body);
          expect(`${kind}: ${strokes} strokes`).toBe(`${kind}: ${whole.strokes} strokes`);
          // The tip of a hairpin can be too thin for the units of areas.
          expect(Math.abs(mm - whole.mm)).toBeLessThan(0.1);
        }
      },
    ),
    { numRuns: cases(1_000, 50) },
  );
});
