/** Generators shared by property tests: drawings and settings, ordinary and nasty. */
import fc from "fast-check";
import type { StrokeSet } from "../../../src/index.js";
import type { MotionLimits } from "../../../src/internal.js";

export type Point = readonly [number, number];

/** Strokes in one layer (or the given ones) from lists of points. */
export function strokeSetOf(
  strokes: readonly (readonly Point[])[],
  layerOf: readonly number[] = [],
): StrokeSet {
  const offsets = [0];
  for (const stroke of strokes) offsets.push(offsets[offsets.length - 1] + stroke.length);
  const layerCount = 1 + Math.max(0, ...layerOf);
  return {
    xy: Float64Array.from(strokes.flat(2)),
    offsets: Uint32Array.from(offsets),
    layer: Uint16Array.from(strokes.map((_, i) => layerOf[i] ?? 0)),
    layers: Array.from({ length: layerCount }, (_, i) => ({ id: `l${i}`, name: `Layer ${i}`, color: null })),
  };
}

const real = (min: number, max: number) => fc.double({ min, max, noNaN: true, noDefaultInfinity: true });

/** Points on a page, anywhere. */
const scattered = fc.array(fc.tuple(real(0, 300), real(0, 200)), { minLength: 1, maxLength: 12 });

/** Segment lengths from 1e-12 to 1e6 mm and all kinds of turns: straight on, reversals, tiny ones. */
const wandering = fc
  .array(
    fc.tuple(
      fc.oneof(real(0.01, 50), fc.constantFrom(0, 1e-12, 1e-7, 1e-3, 1, 1e6)),
      fc.oneof(real(-Math.PI, Math.PI), fc.constantFrom(0, Math.PI, -Math.PI / 2, Math.PI / 2, 1e-9, 1e-4)),
    ),
    { minLength: 1, maxLength: 15 },
  )
  .map((steps) => {
    let heading = 0.3;
    const points: Point[] = [[0, 0]];
    for (const [length, turn] of steps) {
      heading += turn;
      const [x, y] = points[points.length - 1];
      points.push([x + length * Math.cos(heading), y + length * Math.sin(heading)]);
    }
    return points;
  });

/** Finely sampled curves: the radius changes slowly, as in real drawings. */
const curve = fc
  .tuple(real(0.3, 30), real(0.02, 0.5), fc.integer({ min: 5, max: 150 }), real(-0.6, 0.6), real(0, 6.3))
  .map(([radius, step, count, growth, start]) => {
    const points: Point[] = [[50, 50]];
    let heading = start;
    for (let i = 0; i < count; i++) {
      const r = radius * (1 + (growth * i) / count);
      heading += step / r;
      const [x, y] = points[points.length - 1];
      points.push([x + step * Math.cos(heading), y + step * Math.sin(heading)]);
    }
    return points;
  });

const dot = fc.constantFrom<readonly Point[]>(
  [[3, 4]],
  [
    [5, 5],
    [5, 5],
    [5, 5],
  ],
);

/** One stroke, of any kind. */
export const arbitraryStroke: fc.Arbitrary<readonly Point[]> = fc.oneof(
  { weight: 3, arbitrary: scattered },
  { weight: 3, arbitrary: wandering },
  { weight: 3, arbitrary: curve },
  { weight: 1, arbitrary: dot },
);

/** One stroke with points on a grid of 1 µm: none closer together than that, unless equal. */
export const arbitraryGridStroke: fc.Arbitrary<readonly Point[]> = arbitraryStroke.map((stroke) =>
  stroke.map(([x, y]): Point => [Math.round(x * 1000) / 1000, Math.round(y * 1000) / 1000]),
);

/** No drawing, or a few strokes. */
export const arbitraryStrokeSet: fc.Arbitrary<StrokeSet> = fc
  .array(arbitraryStroke, { maxLength: 4 })
  .map((strokes) => strokeSetOf(strokes));

const limitsOf = (accelMin: number): fc.Arbitrary<MotionLimits> =>
  fc.record({
    speedMmPerS: real(1, 400),
    accelMmPerS2: real(accelMin, 5000),
    cornerMm: real(0.001, 1),
    jerkMmPerS3: real(1_000, 500_000),
  });

export const arbitraryLimits = limitsOf(20);
