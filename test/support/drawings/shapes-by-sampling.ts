/** Inside and outside, decided point by point and independently of the library: the reference for clipping. */
import type { StrokeSet } from "../../../src/drawing/stroke-set.js";

export type Ring = readonly (readonly [number, number])[];

function windingOf(rings: readonly Ring[], x: number, y: number): number {
  let winding = 0;
  for (const ring of rings) {
    ring.forEach(([x1, y1], k) => {
      const [x0, y0] = ring[(k + ring.length - 1) % ring.length];
      if (y0 <= y === y1 <= y) return;
      const crossing = x0 + ((y - y0) / (y1 - y0)) * (x1 - x0);
      if (crossing > x) winding += y1 > y0 ? 1 : -1;
    });
  }
  return winding;
}

export const isInside = (rings: readonly Ring[], evenOdd: boolean, x: number, y: number): boolean => {
  const winding = windingOf(rings, x, y);
  return evenOdd ? winding % 2 !== 0 : winding !== 0;
};

export function distanceToSegment(
  [x, y]: readonly [number, number],
  [x0, y0]: readonly [number, number],
  [x1, y1]: readonly [number, number],
): number {
  const dx = x1 - x0;
  const dy = y1 - y0;
  const length2 = dx * dx + dy * dy;
  const t = length2 > 0 ? Math.min(Math.max(((x - x0) * dx + (y - y0) * dy) / length2, 0), 1) : 0;
  return Math.hypot(x0 + t * dx - x, y0 + t * dy - y);
}

/** Distance from a point to the border of the rings. */
export const distanceToRings = (rings: readonly Ring[], x: number, y: number): number =>
  Math.min(
    Infinity,
    ...rings.flatMap((ring) =>
      ring.map((p, k) => distanceToSegment([x, y], ring[(k + ring.length - 1) % ring.length], p)),
    ),
  );

type Segment = readonly [readonly [number, number], readonly [number, number]];

/** A dot is a segment of length 0. */
export function segmentsOf(strokes: StrokeSet): Segment[] {
  const segments: Segment[] = [];
  for (let i = 0; i + 1 < strokes.offsets.length; i++) {
    const [first, end] = [strokes.offsets[i], strokes.offsets[i + 1]];
    for (let p = first; p < Math.max(first + 1, end - 1); p++) {
      const [x0, y0] = strokes.xy.subarray(2 * p, 2 * p + 2);
      const [x1, y1] = p + 1 < end ? strokes.xy.subarray(2 * p + 2, 2 * p + 4) : [x0, y0];
      segments.push([
        [x0, y0],
        [x1, y1],
      ]);
    }
  }
  return segments;
}

export const distanceToSegments = (segments: readonly Segment[], x: number, y: number): number =>
  segments.reduce((best, [a, b]) => Math.min(best, distanceToSegment([x, y], a, b)), Infinity);

export const pathOf = (rings: readonly Ring[]): string =>
  rings.map((ring) => `M${ring.map((p) => p.join(" ")).join("L")}Z`).join("");
