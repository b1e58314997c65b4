/**
 * Affine maps of the plane, with SVG's coefficient names:
 *
 *   x′ = a x + c y + e        ( a c e )
 *   y′ = b x + d y + f        ( b d f )
 *
 * Immutable: every function returns a new map.
 */
export interface Affine {
  readonly a: number;
  readonly b: number;
  readonly c: number;
  readonly d: number;
  readonly e: number;
  readonly f: number;
}

export const IDENTITY: Affine = { a: 1, b: 0, c: 0, d: 1, e: 0, f: 0 };

export const translation = (x: number, y: number): Affine => ({ a: 1, b: 0, c: 0, d: 1, e: x, f: y });
export const scaling = (x: number, y = x): Affine => ({ a: x, b: 0, c: 0, d: y, e: 0, f: 0 });

/** Rotates +x towards +y: clockwise on a page whose y axis points down. Exact at multiples of a quarter turn. */
export function rotation(angleRad: number): Affine {
  const quarters = angleRad / (Math.PI / 2);
  const nearest = Math.round(quarters);
  let cos = Math.cos(angleRad);
  let sin = Math.sin(angleRad);
  if (Math.abs(quarters - nearest) < 1e-12) {
    const k = ((nearest % 4) + 4) % 4;
    cos = [1, 0, -1, 0][k];
    sin = [0, 1, 0, -1][k];
  }
  return { a: cos, b: sin, c: -sin, d: cos, e: 0, f: 0 };
}

/** The map that applies `inner` first, then `outer`. */
export function compose(outer: Affine, inner: Affine): Affine {
  return {
    a: outer.a * inner.a + outer.c * inner.b,
    b: outer.b * inner.a + outer.d * inner.b,
    c: outer.a * inner.c + outer.c * inner.d,
    d: outer.b * inner.c + outer.d * inner.d,
    e: outer.a * inner.e + outer.c * inner.f + outer.e,
    f: outer.b * inner.e + outer.d * inner.f + outer.f,
  };
}

/** The map with (x, y) as its origin. */
export const mapAround = (x: number, y: number, map: Affine): Affine =>
  compose(translation(x, y), compose(map, translation(-x, -y)));

export const applyX = (m: Affine, x: number, y: number): number => m.a * x + m.c * y + m.e;
export const applyY = (m: Affine, x: number, y: number): number => m.b * x + m.d * y + m.f;

export const determinant = (m: Affine): number => m.a * m.d - m.b * m.c;

/** Mean scale factor of lengths: the square root of the scale factor of areas. */
export const meanScale = (m: Affine): number => Math.sqrt(Math.abs(determinant(m)));

/** Max scale factor of lengths along an axis. Never 0, so that callers can divide by it. */
export const largestScale = (m: Affine): number =>
  Math.max(Math.hypot(m.a, m.b), Math.hypot(m.c, m.d), 1e-12);

/** The map back. Not finite if there is none. */
export function inverse(m: Affine): Affine {
  const det = determinant(m);
  return {
    a: m.d / det,
    b: -m.b / det,
    c: -m.c / det,
    d: m.a / det,
    e: (m.c * m.f - m.d * m.e) / det,
    f: (m.b * m.e - m.a * m.f) / det,
  };
}

/**
 * The inverse without its translation, scaled to preserve areas. Null if the map has no inverse, or if the
 * result would preserve lengths too (no stretching or skew).
 */
export function unstretched(m: Affine): { a: number; b: number; c: number; d: number } | null {
  const det = determinant(m);
  const isSimilar = Math.abs(largestScale(m) - meanScale(m)) <= 1e-9 * meanScale(m);
  if (det === 0 || !Number.isFinite(det) || isSimilar) return null;
  const k = meanScale(m) / det;
  return { a: m.d * k, b: -m.b * k, c: -m.c * k, d: m.a * k };
}

export const isFiniteAffine = (m: Affine): boolean => Number.isFinite(m.a + m.b + m.c + m.d + m.e + m.f);
