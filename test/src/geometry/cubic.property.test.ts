import { describe, expect, it } from "vitest";
import fc from "fast-check";
import { flattenCubic } from "../../../src/geometry/cubic.js";
import { PointBuffer } from "../../../src/geometry/growable.js";
import { cases } from "../../support/runs/full-run.js";

const coordinate = fc.double({ min: -300, max: 300, noNaN: true });
const curve = fc.tuple(
  coordinate,
  coordinate,
  coordinate,
  coordinate,
  coordinate,
  coordinate,
  coordinate,
  coordinate,
);
const tolerance = fc.double({ min: -3, max: 0, noNaN: true }).map((exponent) => 10 ** exponent);
type Curve = [number, number, number, number, number, number, number, number];

function at([x0, y0, x1, y1, x2, y2, x3, y3]: Curve, t: number): [number, number] {
  const s = 1 - t;
  const [a, b, c, d] = [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t];
  return [a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3];
}

function distanceToSegment(px: number, py: number, ax: number, ay: number, bx: number, by: number): number {
  const [dx, dy] = [bx - ax, by - ay];
  const length2 = dx * dx + dy * dy;
  const t = length2 === 0 ? 0 : Math.min(1, Math.max(0, ((px - ax) * dx + (py - ay) * dy) / length2));
  return Math.hypot(px - ax - t * dx, py - ay - t * dy);
}

function polyline(c: Curve, tol: number): Float64Array {
  const out = new PointBuffer(1);
  out.push(c[0], c[1]);
  flattenCubic(out, ...c, tol);
  return out.toArray();
}

/** Largest distance from the curve to the polyline. */
function gap(c: Curve, xy: Float64Array): number {
  let worst = 0;
  for (let i = 0; i <= 300; i++) {
    const [x, y] = at(c, i / 300);
    let best = Infinity;
    for (let k = 0; k + 3 < xy.length; k += 2) {
      best = Math.min(best, distanceToSegment(x, y, xy[k], xy[k + 1], xy[k + 2], xy[k + 3]));
    }
    worst = Math.max(worst, best);
  }
  return worst;
}

describe("flattenCubic", () => {
  it("keeps every point of the curve within the tolerance of the polyline", () => {
    fc.assert(
      fc.property(curve, fc.double({ min: 0.01, max: 2, noNaN: true }), (c, tol) => {
        expect(gap(c, polyline(c, tol))).toBeLessThanOrEqual(tol * (1 + 1e-9) + 1e-9);
      }),
      { numRuns: cases(300) },
    );
  });

  it("keeps every chord within the tolerance of the curve", () => {
    fc.assert(
      fc.property(curve, fc.double({ min: 0.05, max: 2, noNaN: true }), (c, tol) => {
        const xy = polyline(c, tol);
        const dense = polyline(c, tol / 400);
        for (let k = 0; k + 3 < xy.length; k += 2) {
          for (const f of [0.25, 0.5, 0.75]) {
            const x = xy[k] + f * (xy[k + 2] - xy[k]);
            const y = xy[k + 1] + f * (xy[k + 3] - xy[k + 1]);
            let best = Infinity;
            for (let j = 0; j + 3 < dense.length; j += 2) {
              best = Math.min(
                best,
                distanceToSegment(x, y, dense[j], dense[j + 1], dense[j + 2], dense[j + 3]),
              );
            }
            expect(best).toBeLessThanOrEqual(tol * 1.01 + 1e-9);
          }
        }
      }),
      { numRuns: 40 },
    );
  });

  it("ends exactly at the end point and writes only finite points, fewer as the tolerance grows", () => {
    fc.assert(
      fc.property(curve, tolerance, (c, tol) => {
        const fine = polyline(c, tol);
        expect(fine[fine.length - 2]).toBe(c[6]);
        expect(fine[fine.length - 1]).toBe(c[7]);
        expect(fine.every(Number.isFinite)).toBe(true);
        const spread = Math.max(...c) - Math.min(...c);
        const bound = 2 * Math.ceil(Math.sqrt((0.75 * 4 * Math.SQRT2 * spread) / tol)) + 2;
        expect(fine.length / 2).toBeLessThanOrEqual(bound);
        expect(polyline(c, tol * 64).length).toBeLessThanOrEqual(fine.length);
      }),
      { numRuns: cases(300) },
    );
  });

  it("keeps a straight line written as a curve in one piece", () => {
    fc.assert(
      fc.property(
        fc.tuple(coordinate, coordinate, coordinate, coordinate),
        fc.double({ min: 0, max: 1, noNaN: true }),
        fc.double({ min: 0, max: 1, noNaN: true }),
        ([x0, y0, x3, y3], s, t) => {
          const c: Curve = [
            x0,
            y0,
            x0 + s * (x3 - x0),
            y0 + s * (y3 - y0),
            x0 + t * (x3 - x0),
            y0 + t * (y3 - y0),
            x3,
            y3,
          ];
          fc.pre(Math.hypot(x3 - x0, y3 - y0) > 1);
          // Rounding may put a control point an ulp outside the chord, which costs a piece or two.
          const count = polyline(c, 0.02).length / 2;
          if (s > 1e-9 && s < 1 - 1e-9 && t > 1e-9 && t < 1 - 1e-9) expect(count).toBe(2);
        },
      ),
    );
  });

  it("flattens a quarter circle of 50 mm at 0.02 mm with close to the fewest chords possible", () => {
    const k = 0.5522847498307936 * 50;
    const count = polyline([50, 0, 50, k, k, 50, 0, 50], 0.02).length / 2 - 1;
    const fewest = Math.PI / 2 / (2 * Math.acos(1 - 0.02 / 50));
    expect(count).toBeLessThanOrEqual(1.25 * Math.ceil(fewest));
    expect(count).toBeGreaterThanOrEqual(Math.floor(fewest));
  });

  it("refuses a tolerance that is not positive", () => {
    const out = new PointBuffer();
    expect(() => flattenCubic(out, 0, 0, 1, 1, 2, 1, 3, 0, 0)).toThrow(RangeError);
    expect(() => flattenCubic(out, 0, 0, 1, 1, 2, 1, 3, 0, NaN)).toThrow(RangeError);
  });

  it("stays bounded on coordinates far beyond any paper", () => {
    expect(polyline([0, 0, 1e12, 5e12, -3e12, 8e11, 1e12, 0], 0.001).length).toBeLessThanOrEqual(4 * 65_536);
  });
});
