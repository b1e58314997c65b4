import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { strokeCount, type StrokeSet } from "../../../src/drawing/stroke-set.js";
import { distance } from "../../../src/geometry/polyline.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { DEFAULT_PREPARE, type PrepareSettings } from "../../../src/settings/prepare.js";
import { drawingOf, type TestShape } from "../../support/drawings/drawings.js";
import { cases } from "../../support/runs/full-run.js";

const RUNS = { numRuns: cases() };
const PLAIN: PrepareSettings = {
  ...DEFAULT_PREPARE,
  paper: { widthMm: 120, heightMm: 120 },
  marginMm: 10,
  fit: false,
  clipToMargins: true,
  joinMm: 0,
  order: "none",
};

/** Coordinates that meet often, lie on margins, and are sometimes absurd. */
const coordinate = fc.oneof(
  { weight: 6, arbitrary: fc.integer({ min: -20, max: 140 }) },
  { weight: 3, arbitrary: fc.double({ min: -20, max: 140, noNaN: true }) },
  { weight: 1, arbitrary: fc.constantFrom(10, 110, 1e-12, 1e6, -1e6, 1e15, 1e300) },
);
const quarter = fc.integer({ min: -80, max: 560 }).map((v) => v / 4);
const sane = fc.double({ min: -20, max: 140, noNaN: true });

const shapeOf = (value: fc.Arbitrary<number>): fc.Arbitrary<TestShape> =>
  fc
    .record({
      start: fc.tuple(value, value),
      steps: fc.array(
        fc.oneof(
          fc.tuple(value, value).map((p) => `L${p.join(" ")}`),
          fc.tuple(value, value, value, value, value, value).map((p) => `C${p.join(" ")}`),
        ),
        { maxLength: 5 },
      ),
      close: fc.boolean(),
      group: fc.nat(2),
      filledOnly: fc.boolean(),
      dash: fc.constantFrom(-1, 0),
    })
    .map(({ start, steps, close, group, filledOnly, dash }) => ({
      d: `M${start.join(" ")}${steps.join("")}${close ? "Z" : ""}`,
      group,
      dash,
      ...(filledOnly ? { stroke: null, fill: "#123456" } : {}),
    }));

const drawingFrom = (shapes: readonly TestShape[]): ReturnType<typeof drawingOf> =>
  drawingOf(shapes, { groups: ["a", "b", "c"], dashes: [{ lengths: [7, 3], offset: 1 }] });
const drawings = fc.array(shapeOf(coordinate), { maxLength: 8 }).map(drawingFrom);
const saneDrawings = fc.array(shapeOf(sane), { maxLength: 8 }).map(drawingFrom);

const settings: fc.Arbitrary<PrepareSettings> = fc
  .record({
    paper: fc.constant({ widthMm: 120, heightMm: 120 }),
    landscape: fc.boolean(),
    marginMm: fc.constantFrom(0, 10),
    fit: fc.boolean(),
    rotateDeg: fc.constantFrom(0, 90, 33.3, -180),
    flattenMm: fc.constantFrom(0.02, 0.5),
    joinMm: fc.constantFrom(0, 0.1, 5),
    dropShorterMm: fc.constantFrom(0, 1),
    simplifyMm: fc.constantFrom(0, 0.1),
    layers: fc.constantFrom("group" as const, "stroke" as const, "all" as const),
    hiddenLayers: fc.constantFrom([], ["g1"]),
    order: fc.constantFrom("none" as const, "fast" as const),
    mirror: fc.constantFrom("none" as const, "leftRight" as const),
    cropToPage: fc.boolean(),
    hatch: fc.constantFrom(
      { spacingMm: 0, angleDeg: 0, cross: false },
      { spacingMm: 3, angleDeg: 30, cross: true },
    ),
    hideCovered: fc.boolean(),
    dropRepeatsMm: fc.constantFrom(0, 0.1),
    smoothRounds: fc.constantFrom(0, 1),
    reloop: fc.boolean(),
    spread: fc.constantFrom("none" as const, "interleave" as const, "shuffle" as const),
    reinkMm: fc.constantFrom(0, 200),
  })
  .map((some) => ({ ...DEFAULT_PREPARE, clipToMargins: true, ...some }));

const lengthOf = (set: StrokeSet): number => {
  let length = 0;
  for (let i = 0; i < strokeCount(set); i++) {
    for (let p = set.offsets[i] + 1; p < set.offsets[i + 1]; p++) {
      length += distance(set.xy[2 * p - 2], set.xy[2 * p - 1], set.xy[2 * p], set.xy[2 * p + 1]);
    }
  }
  return length;
};

/** A stroke as text that is the same for both directions and, if closed, for every starting point. */
function canonical(set: StrokeSet, i: number): string {
  const points: string[] = [];
  for (let p = set.offsets[i]; p < set.offsets[i + 1]; p++)
    points.push(`${set.xy[2 * p]},${set.xy[2 * p + 1]}`);
  const closed = points.length > 2 && points[0] === points[points.length - 1];
  const forms: string[] = [];
  const ring = closed ? points.slice(0, -1) : points;
  for (const list of [ring, ring.slice().reverse()]) {
    const starts = closed ? list.length : 1;
    for (let k = 0; k < starts; k++) forms.push([...list.slice(k), ...list.slice(0, k)].join(" "));
  }
  return `${set.layer[i]}${closed ? "o" : "-"}${forms.sort()[0]}`;
}

const canonicalStrokes = (set: StrokeSet): string[] =>
  Array.from({ length: strokeCount(set) }, (_, i) => canonical(set, i)).sort();

describe("prepare, for any drawing and settings", () => {
  it("gives finite points inside the margins, columns of matching lengths, and consistent figures", () => {
    fc.assert(
      fc.property(drawings, settings, (drawing, s) => {
        const prepared = prepare(drawing, s);
        const { strokes } = prepared;
        // Cutting by areas rounds to 0.1 µm; if only the margins cut there is no tolerance at all.
        const slack = s.cropToPage || s.hideCovered || s.hatch.spacingMm > 0 ? 1e-4 : 0;
        expect(strokes.xy.every((v) => v >= s.marginMm - slack && v <= 120 - s.marginMm + slack)).toBe(true);
        expect(strokes.offsets[0]).toBe(0);
        expect(strokes.offsets[strokeCount(strokes)]).toBe(strokes.xy.length / 2);
        expect(strokes.layer.length).toBe(strokeCount(strokes));
        for (let i = 0; i < strokeCount(strokes); i++) {
          expect(strokes.offsets[i + 1]).toBeGreaterThan(strokes.offsets[i]);
          expect(strokes.layer[i]).toBeLessThan(strokes.layers.length);
          if (i > 0) expect(strokes.layer[i]).toBeGreaterThanOrEqual(strokes.layer[i - 1]);
        }
        const shown = prepared.layers.filter((layer) => layer.visible);
        const counted = shown.reduce((sum, layer) => sum + layer.strokeCount, 0);
        if (s.reinkMm === 0) expect(counted).toBe(strokeCount(strokes));
        else expect(counted).toBeLessThanOrEqual(strokeCount(strokes));
        expect(prepared.drawMm).toBeCloseTo(lengthOf(strokes), 6);
        if (s.spread === "none") expect(prepared.travelMm).toBeLessThanOrEqual(prepared.travelMmUnordered);
      }),
      { numRuns: cases(500) },
    );
  });

  it("orders by permuting, reversing and re-starting strokes, and nothing else", () => {
    fc.assert(
      fc.property(saneDrawings, fc.constantFrom(0, 2), (drawing, joinMm) => {
        const given = prepare(drawing, { ...PLAIN, joinMm });
        const ordered = prepare(drawing, { ...PLAIN, joinMm, order: "fast" });
        expect(canonicalStrokes(ordered.strokes)).toEqual(canonicalStrokes(given.strokes));
        expect(ordered.drawMm).toBeCloseTo(given.drawMm, 6);
      }),
      RUNS,
    );
  });

  it("joins by adding at most the join distance at each join, and draws everything that was there", () => {
    fc.assert(
      fc.property(saneDrawings, fc.constantFrom(0.1, 3), (drawing, joinMm) => {
        const apart = prepare(drawing, PLAIN);
        const joined = prepare(drawing, { ...PLAIN, joinMm });
        const joins = strokeCount(apart.strokes) - strokeCount(joined.strokes);
        // Closing a loop is a join too, and does not lower the count.
        const added = joined.drawMm - apart.drawMm;
        expect(joins).toBeGreaterThanOrEqual(0);
        expect(added).toBeGreaterThanOrEqual(-1e-3);
        expect(added).toBeLessThanOrEqual(joinMm * strokeCount(apart.strokes) + 1e-9);
      }),
      RUNS,
    );
  });

  it("gives the same strokes for any scale of the file if the drawing is fitted to the paper", () => {
    fc.assert(
      fc.property(
        fc.array(fc.tuple(quarter, quarter, quarter, quarter), { minLength: 1, maxLength: 6 }),
        fc.constantFrom(0.01, 3, 1_000),
        (lines, k) => {
          const at = (scale: number): Float64Array => {
            const shapes = lines.map(
              ([a, b, c, d]) => `M${a * scale} ${b * scale}L${c * scale} ${d * scale}`,
            );
            return prepare(drawingOf(shapes), { ...PLAIN, fit: true }).strokes.xy;
          };
          const small = at(1);
          const large = at(k);
          expect(large.length).toBe(small.length);
          large.forEach((v, i) => expect(v).toBeCloseTo(small[i], 6));
        },
      ),
      RUNS,
    );
  });
});

describe("flattening", () => {
  it("keeps chords within the tolerance of the curve after scaling to paper", () => {
    fc.assert(
      fc.property(
        fc.array(sane, { minLength: 8, maxLength: 8 }),
        fc.constantFrom(0.02, 0.2),
        (c, flattenMm) => {
          const d = `M${c[0]} ${c[1]}C${c.slice(2).join(" ")}`;
          const free = { ...PLAIN, flattenMm, clipToMargins: false };
          const { xy } = prepare(drawingOf([d]), free).strokes;
          for (let k = 0; k <= 50; k++) {
            const t = k / 50;
            const s = 1 - t;
            const at = (o: number): number =>
              s * s * s * c[o] + 3 * s * s * t * c[2 + o] + 3 * s * t * t * c[4 + o] + t * t * t * c[6 + o];
            expect(distanceToPolyline(xy, at(0), at(1))).toBeLessThanOrEqual(flattenMm * 1.001 + 2e-6);
          }
        },
      ),
      RUNS,
    );
  });
});

describe("order fast", () => {
  it("keeps the file's order if that is already the shortest", () => {
    const dots = fc.uniqueArray(fc.tuple(fc.nat(30), fc.nat(30)), {
      minLength: 2,
      maxLength: 5,
      selector: (p) => p.join(),
    });
    fc.assert(
      fc.property(dots, (points) => {
        const best = permutations(points).reduce((a, b) => (tourOf(b) < tourOf(a) ? b : a));
        const drawing = drawingOf(best.map(([x, y]) => `M${x} ${y}Z`));
        const prepared = prepare(drawing, { ...PLAIN, marginMm: 0, order: "fast" });
        expect(prepared.travelMm).toBeCloseTo(tourOf(best), 6);
      }),
      RUNS,
    );
  });
});

const tourOf = (points: readonly (readonly [number, number])[]): number =>
  [...points, [0, 0] as const].reduce(
    (sum, p, i) =>
      sum + (i === 0 ? Math.hypot(...p) : distance(points[i - 1][0], points[i - 1][1], p[0], p[1])),
    0,
  );

function permutations<T>(items: readonly T[]): T[][] {
  if (items.length < 2) return [[...items]];
  return items.flatMap((item, i) =>
    permutations([...items.slice(0, i), ...items.slice(i + 1)]).map((rest) => [item, ...rest]),
  );
}

function distanceToPolyline(xy: Float64Array, x: number, y: number): number {
  let best = distance(xy[0], xy[1], x, y);
  for (let k = 2; k < xy.length; k += 2) {
    const dx = xy[k] - xy[k - 2];
    const dy = xy[k + 1] - xy[k - 1];
    const length2 = dx * dx + dy * dy;
    const along = length2 > 0 ? ((x - xy[k - 2]) * dx + (y - xy[k - 1]) * dy) / length2 : 0;
    const t = Math.min(Math.max(along, 0), 1);
    best = Math.min(best, distance(xy[k - 2] + t * dx, xy[k - 1] + t * dy, x, y));
  }
  return best;
}
