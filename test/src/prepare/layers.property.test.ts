import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { DEFAULT_PREPARE, prepare, type PrepareSettings, type StrokeSet } from "../../../src/index.js";
import { NO_PENS, ORDER_MODES, penStopsOf, strokeCount } from "../../../src/internal.js";
import { drawingOf } from "../../support/drawings/drawings.js";
import { cases } from "../../support/runs/full-run.js";

const RUNS = { numRuns: cases() };
const GROUPS = ["a", "!b", "%c", "d"];
const IDS = GROUPS.map((_, k) => `g${k}`);
const place = fc.integer({ min: 0, max: 90 });
const lines = fc.array(
  fc.tuple(fc.array(fc.tuple(place, place), { minLength: 2, maxLength: 4 }), fc.nat(GROUPS.length - 1)),
  { minLength: 1, maxLength: 12 },
);
const settings = fc.record({
  layerOrder: fc.subarray(IDS).chain((ids) => fc.shuffledSubarray(ids, { minLength: ids.length })),
  hiddenLayers: fc.subarray(IDS),
  shownLayers: fc.subarray(IDS),
  layerRepeats: fc.dictionary(fc.constantFrom(...IDS), fc.integer({ min: 1, max: 4 })),
  order: fc.constantFrom(...ORDER_MODES.filter((mode) => mode !== "best")),
  reloop: fc.boolean(),
  reinkMm: fc.constantFrom(0, 40),
});

const PLAIN: PrepareSettings = { ...DEFAULT_PREPARE, marginMm: 0, fit: false, joinMm: 0, order: "none" };
const drawn = (given: [[number, number][], number][], more: Partial<PrepareSettings>) =>
  prepare(
    drawingOf(
      given.map(([points, group]) => ({ d: `M${points.map(([x, y]) => `${x} ${y}`).join("L")}`, group })),
      { groups: GROUPS },
    ),
    { ...PLAIN, ...more },
  );

/** mm drawn by layer, parts of a layer counted with it. */
const lengths = ({ xy, offsets, layer, layers }: StrokeSet): Map<string, number> => {
  const found = new Map<string, number>();
  for (let i = 0; i < offsets.length - 1; i++) {
    const { id, partOf = id } = layers[layer[i]];
    let length = found.get(partOf) ?? 0;
    for (let p = offsets[i] + 1; p < offsets[i + 1]; p++) {
      length += Math.hypot(xy[2 * p] - xy[2 * p - 2], xy[2 * p + 1] - xy[2 * p - 1]);
    }
    found.set(partOf, length);
  }
  return found;
};

describe("layers in any order, repeated and switched off", () => {
  it("draw each visible layer as often as set, completely, in the wanted order, in one stretch", () => {
    fc.assert(
      fc.property(lines, settings, (given, more) => {
        const { strokes, layers } = drawn(given, more);
        const once = lengths(drawn(given, { shownLayers: IDS }).strokes);
        const found = lengths(strokes);
        for (const { id, visible } of layers) {
          const times = visible ? (more.layerRepeats[id] ?? 1) : 0;
          expect(found.get(id) ?? 0).toBeCloseTo(times * (once.get(id) ?? 0), 6);
        }
        const wanted = more.layerOrder.filter((id) => once.has(id));
        expect(layers.map(({ id }) => id).slice(0, wanted.length)).toEqual(wanted);
        expect([...strokes.layer]).toEqual([...strokes.layer].sort((a, b) => a - b));
        expect(strokes.layers.map(({ id }) => id).filter((id) => !id.includes("~"))).toEqual(
          layers.filter(({ visible }) => visible).map(({ id }) => id),
        );
      }),
      RUNS,
    );
  });

  it("never travel further than the passes drawn as in the file", () => {
    fc.assert(
      fc.property(lines, settings, (given, more) => {
        const { travelMm, travelMmUnordered } = drawn(given, { ...more, reinkMm: 0 });
        expect(travelMm).toBeLessThanOrEqual(travelMmUnordered + 1e-6);
      }),
      RUNS,
    );
  });

  it("stop only where a layer, or a part of one, begins", () => {
    const pens = ["x", "y"].map((id) => ({
      id,
      name: id,
      color: null,
      widthMm: 1,
      offsetXMm: 0,
      offsetYMm: 0,
    }));
    const setups = fc.record({
      layerPens: fc.dictionary(fc.constantFrom(...IDS), fc.constantFrom("x", "y", "gone")),
      layerStops: fc.dictionary(fc.constantFrom(...IDS), fc.boolean()),
      penStops: fc.constantFrom("pens" as const, "layers" as const),
    });
    fc.assert(
      fc.property(lines, settings, setups, (given, more, setup) => {
        const { strokes } = drawn(given, more);
        const stops = penStopsOf(strokes, { ...NO_PENS, pens, ...setup }).map((stop) => stop.strokeIndex);
        expect(stops).toEqual([...new Set(stops)].sort((a, b) => a - b));
        for (const stroke of stops) {
          expect(stroke).toBeLessThan(strokeCount(strokes));
          if (stroke > 0) expect(strokes.layer[stroke]).not.toBe(strokes.layer[stroke - 1]);
        }
      }),
      RUNS,
    );
  });
});
