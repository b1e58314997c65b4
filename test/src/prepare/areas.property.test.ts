/** Hatch, clips and hidden lines, checked by area and by sampling points inside and out. */
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { LineBuilder, type Lines } from "../../../src/geometry/polyline.js";
import { regionOf, ringOf, type Region } from "../../../src/geometry/region.js";
import { hideCovered } from "../../../src/prepare/steps/hidden-lines.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { DEFAULT_PREPARE, type PrepareSettings } from "../../../src/settings/prepare.js";
import { clipOf, drawingOf } from "../../support/drawings/drawings.js";
import {
  distanceToRings,
  distanceToSegments,
  isInside,
  pathOf,
  segmentsOf,
  type Ring,
} from "../../support/drawings/shapes-by-sampling.js";
import { cases } from "../../support/runs/full-run.js";

const RUNS = { numRuns: cases(200) };
const PLAIN: PrepareSettings = {
  ...DEFAULT_PREPARE,
  paper: { widthMm: 100, heightMm: 100 },
  marginMm: 0,
  fit: false,
  joinMm: 0,
  order: "none",
};

const place = fc.integer({ min: 4, max: 96 });
/** Any polygon, also self-intersecting. */
const ring: fc.Arbitrary<Ring> = fc.array(fc.tuple(place, place), { minLength: 3, maxLength: 6 });
const rings = fc.array(ring, { minLength: 1, maxLength: 2 });
const points = fc.array(
  fc.tuple(fc.double({ min: 0, max: 100, noNaN: true }), fc.double({ min: 0, max: 100, noNaN: true })),
  {
    minLength: 20,
    maxLength: 20,
  },
);

/**
 * Points this close to a border, mm, may count either way: Clipper rounds to 0.1 µm, and moves crossings by
 * that.
 */
const BORDER = 0.01;

describe("hatch", () => {
  const SPACING = 2;

  it("covers the inside, stays half a pen from the border, and leaves the outside empty", () => {
    fc.assert(
      fc.property(
        rings,
        fc.boolean(),
        fc.integer({ min: 0, max: 180 }),
        points,
        (shape, evenOdd, angleDeg, samples) => {
          const drawing = drawingOf([
            { d: pathOf(shape), stroke: null, fill: "#000000", fillRule: evenOdd ? 1 : 0 },
          ]);
          const hatch = { spacingMm: SPACING, angleDeg, cross: false };
          const lines = segmentsOf(prepare(drawing, { ...PLAIN, hatch, outlineFills: false }).strokes);
          let strayed = 0;
          for (const [[x0, y0], [x1, y1]] of lines) {
            for (const t of [0.01, 0.4, 0.99]) {
              const [x, y] = [x0 + t * (x1 - x0), y0 + t * (y1 - y0)];
              if (!hasRoomAround(shape, evenOdd, x, y, SPACING / 2 - BORDER)) strayed++;
            }
          }
          expect(strayed).toBe(0);
          for (const [x, y] of samples) {
            // So deep inside that every hatch line near it must exist.
            if (!isInside(shape, evenOdd, x, y) || distanceToRings(shape, x, y) < 1.6 * SPACING) continue;
            expect(distanceToSegments(lines, x, y)).toBeLessThanOrEqual(SPACING / 2 + 1e-3);
          }
        },
      ),
      RUNS,
    );
  });

  it("inks an area equal to the inner area: length times spacing", () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 20, max: 80 }),
        fc.integer({ min: 20, max: 80 }),
        fc.integer({ min: 0, max: 180 }),
        fc.boolean(),
        (width, height, angleDeg, cross) => {
          const drawing = drawingOf([
            {
              d: `M5 5L${5 + width} 5L${5 + width} ${5 + height}L5 ${5 + height}Z`,
              stroke: null,
              fill: "#000000",
            },
          ]);
          const spacingMm = 0.5;
          const prepared = prepare(drawing, {
            ...PLAIN,
            outlineFills: false,
            hatch: { spacingMm, angleDeg, cross },
          });
          const area = (width - spacingMm) * (height - spacingMm) * (cross ? 2 : 1);
          // Off by less than the links and one line at either side, each way.
          const slack = spacingMm * (cross ? 2 : 1) * 4 * (width + height);
          expect(Math.abs(prepared.drawMm * spacingMm - area)).toBeLessThan(slack);
        },
      ),
      RUNS,
    );
  });
});

/** Sampled around the point: an edge with the area on both sides is not a border. */
function hasRoomAround(
  shape: readonly Ring[],
  evenOdd: boolean,
  x: number,
  y: number,
  room: number,
): boolean {
  for (const r of [room / 3, room]) {
    for (let a = 0; a < 2 * Math.PI; a += Math.PI / 8) {
      if (!isInside(shape, evenOdd, x + r * Math.cos(a), y + r * Math.sin(a))) return false;
    }
  }
  return true;
}

describe("clip regions", () => {
  it("keep what is inside the region and its parent, and nothing else", () => {
    fc.assert(
      fc.property(rings, rings, fc.boolean(), ring, (clip, parent, evenOdd, line) => {
        const drawing = drawingOf([{ d: pathOf([line]), clip: 1 }], {
          clips: [clipOf(pathOf(parent), evenOdd ? 1 : 0), clipOf(pathOf(clip), 0, 0)],
        });
        const kept = segmentsOf(prepare(drawing, PLAIN).strokes);
        const visible = (x: number, y: number): boolean =>
          isInside(clip, false, x, y) && isInside(parent, evenOdd, x, y);
        checkBySampling(line, kept, visible, [...clip, ...parent]);
      }),
      RUNS,
    );
  });
});

describe("hidden lines", () => {
  it("are those that a shape painted later covers, whatever its rule", () => {
    const shape = fc.record({ rings, evenOdd: fc.boolean() });
    fc.assert(
      fc.property(fc.array(shape, { minLength: 2, maxLength: 4 }), (shapes) => {
        const drawing = drawingOf(
          shapes.map((s, i) => ({
            d: pathOf(s.rings),
            fill: "#ffffff",
            fillRule: s.evenOdd ? 1 : 0,
            stroke: `#00000${i}`,
            group: i,
          })),
          { groups: shapes.map((_, i) => String(i)) },
        );
        const { strokes } = prepare(drawing, { ...PLAIN, hideCovered: true });
        shapes.forEach((s, i) => {
          const own = segmentsOf(onlyLayer(strokes, i));
          const above = shapes.slice(i + 1);
          const visible = (x: number, y: number): boolean =>
            !above.some((a) => isInside(a.rings, a.evenOdd, x, y));
          for (const line of s.rings)
            checkBySampling(
              line,
              own,
              visible,
              above.flatMap((a) => a.rings),
            );
        });
      }),
      RUNS,
    );
  });

  it("are those that a shape painted later covers, in piles of hundreds of shapes", () => {
    const side = fc.double({ min: 1, max: 60, noNaN: true });
    const place = fc.double({ min: 0, max: 99, noNaN: true });
    const slanted = fc.tuple(place, place, side, side).map(([x, y, width, height]): Ring => [
      [x, y],
      [x + width, y],
      [x + width + 3, y + height],
      [x, y + height],
    ]);
    fc.assert(
      fc.property(fc.array(slanted, { minLength: 100, maxLength: 300 }), (rings) => {
        const builder = new LineBuilder();
        const areas = new Map<number, Region>();
        rings.forEach((ring, i) => {
          for (const [x, y] of [...ring, ring[0]]) builder.point(x, y);
          builder.end(i);
          areas.set(i, regionOf([ringOf(ring.flat())]));
        });
        const visible = hideCovered(builder.finish(), areas, () => true, new Float64Array(rings.length), {});
        for (let i = 0; i < rings.length; i += 10) {
          const above = rings.slice(i + 1);
          const isVisible = (x: number, y: number): boolean =>
            !above.some((ring) => isInside([ring], false, x, y));
          checkBySampling(rings[i], segmentsOfTag(visible, i), isVisible, above);
        }
      }),
      { numRuns: cases(50, 5) },
    );
  });

  it("take no time that grows with the pairs of shapes in a pile", () => {
    // Half of each circle is visible until the pile ends, so that every circle has all later ones beside it.
    const circles = Array.from({ length: 1_000 }, (_, k) => {
      const points = Array.from({ length: 24 }, (_, n) => (n * Math.PI) / 12);
      const at = points.map((a) => `${40 + k / 50 + 20 * Math.cos(a)} ${50 + 20 * Math.sin(a)}`);
      return { d: `M${at.join("L")}Z`, fill: "#ffffff", stroke: null };
    });
    const { strokes, drawMm } = prepare(drawingOf(circles), { ...PLAIN, hideCovered: true });
    expect(strokes.offsets.length - 1).toBeGreaterThan(900);
    expect(drawMm).toBeGreaterThan(1_000 * 20);
  });

  it("hide nothing if their layer is hidden", () => {
    const square = "M10 10L50 10L50 50L10 50Z";
    const drawing = drawingOf(
      [
        { d: "M0 30L90 30", group: 0 },
        { d: square, fill: "#ffffff", group: 1 },
      ],
      { groups: ["line", "cover"] },
    );
    expect(prepare(drawing, { ...PLAIN, hideCovered: true }).layers[0].drawMm).toBeCloseTo(50, 6);
    const without = prepare(drawing, { ...PLAIN, hideCovered: true, hiddenLayers: ["g1"] });
    expect(without.layers.map((layer) => layer.drawMm)).toEqual([90, 160]);
  });
});

function segmentsOfTag({ xy, offsets, tag }: Lines, wanted: number): ReturnType<typeof segmentsOf> {
  const segments: ReturnType<typeof segmentsOf> = [];
  tag.forEach((of, i) => {
    for (let p = offsets[i]; p + 1 < offsets[i + 1] && of === wanted; p++) {
      const [x0, y0, x1, y1] = xy.subarray(2 * p, 2 * p + 4);
      segments.push([
        [x0, y0],
        [x1, y1],
      ]);
    }
  });
  return segments;
}

function onlyLayer(
  strokes: ReturnType<typeof prepare>["strokes"],
  layer: number,
): ReturnType<typeof prepare>["strokes"] {
  const kept = [...strokes.layer.keys()].filter((i) => strokes.layer[i] === layer);
  const offsets = [0];
  const xy: number[] = [];
  for (const i of kept) {
    xy.push(...strokes.xy.subarray(2 * strokes.offsets[i], 2 * strokes.offsets[i + 1]));
    offsets.push(xy.length / 2);
  }
  return {
    ...strokes,
    xy: Float64Array.from(xy),
    offsets: Uint32Array.from(offsets),
    layer: new Uint16Array(kept.length),
  };
}

/** Samples the source line: there must be ink where it is visible, and none where it is hidden. */
function checkBySampling(
  line: Ring,
  ink: ReturnType<typeof segmentsOf>,
  visible: (x: number, y: number) => boolean,
  borders: readonly Ring[],
): void {
  line.forEach(([x1, y1], k) => {
    const [x0, y0] = line[(k + line.length - 1) % line.length];
    for (const t of [0.03, 0.21, 0.5, 0.77, 0.96]) {
      const [x, y] = [x0 + t * (x1 - x0), y0 + t * (y1 - y0)];
      if (distanceToRings(borders, x, y) < BORDER) continue;
      const gap = distanceToSegments(ink, x, y);
      if (visible(x, y)) expect(gap).toBeLessThan(1e-3);
      // Another edge of the same line may cross here: then there is ink for another reason.
      else if (gap < 1e-3) expect(crossesItself(line, x, y)).toBe(true);
    }
  });
}

const crossesItself = (line: Ring, x: number, y: number): boolean =>
  line.filter((p, k) => distanceToSegments([[line[(k + line.length - 1) % line.length], p]], x, y) < 2e-3)
    .length > 1;
