import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { strokeCount, type StrokeSet } from "../../../src/drawing/stroke-set.js";
import { prepare } from "../../../src/prepare/prepare.js";
import { randomFrom } from "../../../src/prepare/work.js";
import { type PrepareSettings, DEFAULT_PREPARE } from "../../../src/settings/prepare.js";
import { improveBlocks } from "../../../src/prepare/order/tour-blocks.js";
import { TourSearch } from "../../../src/prepare/order/tour-search.js";
import { drawingOf } from "../../support/drawings/drawings.js";
import { cases } from "../../support/runs/full-run.js";

const PLAIN: PrepareSettings = {
  ...DEFAULT_PREPARE,
  paper: { widthMm: 300, heightMm: 300 },
  marginMm: 0,
  fit: false,
  joinMm: 0,
  order: "none",
};

/** Places that often coincide or are collinear, as ends of strokes: x, y of end 0, end 1 … */
const value = fc.oneof(fc.integer({ min: 0, max: 9 }), fc.double({ min: 0, max: 100, noNaN: true }));
const ends = fc
  .array(fc.tuple(value, value, value, value), { minLength: 2, maxLength: 40 })
  .map((strokes) => Float64Array.from(strokes.flat()));

const startRing = (xy: Float64Array): Int32Array => Int32Array.from({ length: xy.length / 2 }, (_, k) => k);

function travelOfRing(xy: Float64Array, ring: Int32Array): number {
  let travel = 0;
  for (let p = 1; p < ring.length; p += 2) {
    const a = ring[p];
    const b = ring[(p + 1) % ring.length];
    travel += Math.hypot(xy[2 * a] - xy[2 * b], xy[2 * a + 1] - xy[2 * b + 1]);
  }
  return travel;
}

/** Every stroke once, its two ends side by side at an even and the next odd place. */
function expectRing(ring: Int32Array): void {
  const strokes = new Set<number>();
  let apart = 0;
  for (let p = 0; p < ring.length; p += 2) {
    if ((ring[p] ^ 1) !== ring[p + 1]) apart++;
    strokes.add(ring[p] >> 1);
  }
  expect(apart).toBe(0);
  expect(strokes.size).toBe(ring.length / 2);
}

describe("TourSearch", () => {
  it("keeps a ring of whole strokes with its length, and never makes it longer", () => {
    fc.assert(
      fc.property(ends, fc.integer(), (xy, seed) => {
        const search = new TourSearch(xy, startRing(xy), randomFrom(seed));
        let length = search.length;
        expect(length).toBeCloseTo(travelOfRing(xy, startRing(xy)), 6);
        search.improve();
        for (let k = 0; k < 20; k++) {
          expectRing(search.ring);
          expect(search.length).toBeCloseTo(travelOfRing(xy, search.ring), 6);
          expect(search.length).toBeLessThanOrEqual(length + 1e-6);
          length = search.length;
          search.kick();
        }
      }),
      { numRuns: cases(300) },
    );
  });
});

describe("improveBlocks", () => {
  it("keeps home at the front and a ring of whole strokes that is no longer than before", () => {
    fc.assert(
      fc.property(ends, fc.integer(), (xy, seed) => {
        const ring = startRing(xy);
        const before = travelOfRing(xy, ring);
        expect(improveBlocks(ring, xy, randomFrom(seed), () => true)).toBe(true);
        expectRing(ring);
        expect([...ring.subarray(0, 2)]).toEqual([0, 1]);
        expect(travelOfRing(xy, ring)).toBeLessThanOrEqual(before + 1e-6);
      }),
      { numRuns: cases(300) },
    );
  });

  it("works through a ring of many blocks, with outside strokes fixed", () => {
    const random = randomFrom(7);
    const xy = Float64Array.from({ length: 4 * 300 }, () => 100 * random());
    const ring = startRing(xy);
    const before = travelOfRing(xy, ring);
    let length = before;
    for (let pass = 0; pass < 3; pass++) {
      improveBlocks(ring, xy, random, () => true, 60);
      expectRing(ring);
      expect(travelOfRing(xy, ring)).toBeLessThan(length);
      length = travelOfRing(xy, ring);
    }
    // Random strokes in any order: nearly all of the travel is waste.
    expect(length).toBeLessThan(0.2 * before);
  });
});

describe("order best", () => {
  const coordinate = fc.double({ min: 0, max: 290, noNaN: true });
  const shape = fc.oneof(
    fc.tuple(coordinate, coordinate, coordinate, coordinate).map(([a, b, c, d]) => `M${a} ${b}L${c} ${d}`),
    fc
      .tuple(coordinate, coordinate)
      .map(([x, y]) => `M${x} ${y}L${x + 5} ${y}L${x + 5} ${y + 5}L${x} ${y + 5}Z`),
    fc.tuple(coordinate, coordinate).map(([x, y]) => `M${x} ${y}Z`),
  );
  const drawings = fc.array(fc.tuple(shape, fc.nat(1)), { maxLength: 30 }).map((shapes) =>
    drawingOf(
      shapes.map(([d, group]) => ({ d, group })),
      { groups: ["a", "b"] },
    ),
  );

  it("only permutes, reverses and re-starts strokes, and is not longer than order fast or the file's order", () => {
    fc.assert(
      fc.property(drawings, (drawing) => {
        const given = prepare(drawing, PLAIN);
        const fast = prepare(drawing, { ...PLAIN, order: "fast" });
        const best = prepare(drawing, { ...PLAIN, order: "best" });
        expect(strokeKeys(best.strokes)).toEqual(strokeKeys(given.strokes));
        expect(best.drawMm).toBeCloseTo(given.drawMm, 6);
        expect(best.travelMm).toBeLessThanOrEqual(fast.travelMm + 1e-6);
        expect(best.travelMm).toBeLessThanOrEqual(given.travelMm + 1e-6);
      }),
      { numRuns: 60 },
    );
  });

  it("finds the shortest path through a grid of dots, whose length is known", () => {
    // 10 × 10 dots 10 mm apart, home on one of them: a ring of 100 steps exists.
    const random = randomFrom(3);
    const dots = Array.from({ length: 99 }, (_, k) => ({
      x: 10 * ((k + 1) % 10),
      y: 10 * Math.floor((k + 1) / 10),
    }))
      .map((dot) => ({ dot, key: random() }))
      .sort((a, b) => a.key - b.key)
      .map(({ dot }) => `M${dot.x} ${dot.y}Z`);
    const best = prepare(drawingOf(dots), { ...PLAIN, order: "best" });
    expect(best.travelMm).toBeLessThanOrEqual(1_000 * 1.03);
    expect(best.travelMm).toBeGreaterThanOrEqual(1_000 - 1e-6);
  });

  it("needs at most four fifths of the travel of order fast on random strokes", () => {
    const random = randomFrom(11);
    const strokes = Array.from({ length: 500 }, () => {
      const [x, y, a] = [5 + 280 * random(), 5 + 280 * random(), 7 * random()];
      return `M${x} ${y}L${x + 3 * Math.cos(a)} ${y + 3 * Math.sin(a)}`;
    });
    const drawing = drawingOf(strokes);
    const fast = prepare(drawing, { ...PLAIN, order: "fast" }).travelMm;
    expect(prepare(drawing, { ...PLAIN, order: "best" }).travelMm).toBeLessThan(0.8 * fast);
  });

  describe("with a time limit", () => {
    const random = randomFrom(5);
    const drawing = drawingOf(
      Array.from(
        { length: 400 },
        () => `M${290 * random()} ${290 * random()}L${290 * random()} ${290 * random()}`,
      ),
    );
    const settings: PrepareSettings = { ...PLAIN, order: "best", orderS: 3 };
    /** A clock that advances a tenth of a second each time it is read. */
    const ticking = (): { nowS: () => number; readonly checks: number } => {
      let checks = 0;
      return {
        nowS: () => 0.1 * checks++,
        get checks() {
          return checks;
        },
      };
    };

    it("stops when its time is up, and more time gives no worse result", () => {
      const short = ticking();
      const long = ticking();
      const a = prepare(drawing, { ...settings, orderS: 0.5 }, short);
      const b = prepare(drawing, { ...settings, orderS: 5 }, long);
      expect(short.checks).toBeLessThan(15);
      expect(long.checks).toBeLessThan(60);
      expect(b.travelMm).toBeLessThanOrEqual(a.travelMm);
    });

    it("uses the best order so far if told that it is enough, and throws when cancelled", () => {
      const clock = ticking();
      prepare(drawing, settings, { ...clock, enough: { aborted: true } });
      expect(clock.checks).toBeLessThan(8);
      let checks = 0;
      const cancel = {
        get aborted() {
          return ++checks > 8;
        },
      };
      expect(() => prepare(drawing, settings, { ...ticking(), cancel })).toThrow(
        expect.objectContaining({ code: "cancelled" }),
      );
    });

    it("reports progress that never decreases", () => {
      const seen: number[] = [];
      prepare(drawing, settings, { ...ticking(), onProgress: (done) => seen.push(done) });
      expect(seen).toEqual([...seen].sort((p, q) => p - q));
      expect(seen.filter((done) => done > 0.56 && done < 0.98).length).toBeGreaterThan(2);
    });
  });
});

/** Strokes by layer and outline, independent of direction and starting point. */
function strokeKeys(set: StrokeSet): string[] {
  return Array.from({ length: strokeCount(set) }, (_, i) => {
    const points: string[] = [];
    for (let p = set.offsets[i]; p < set.offsets[i + 1]; p++)
      points.push(`${set.xy[2 * p]},${set.xy[2 * p + 1]}`);
    return `${set.layer[i]} ${points.length} ${[...new Set(points)].sort().join(" ")}`;
  }).sort();
}
