/** Shared code of the sample drawings: a seeded random source, number formatting, and the A4 page around them. */

export const PAGE_WIDTH_MM = 297;
export const PAGE_HEIGHT_MM = 210;

export type Point = readonly [x: number, y: number];

/** A repeatable random source (mulberry32, public domain): the samples come out the same on every machine. */
export function seededRandom(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = state;
    t = Math.imul(t ^ (t >>> 15), t | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** Hundredths of a millimetre are finer than any pen. */
export const mm = (value: number): string => String(Math.round(value * 100) / 100);
export const pair = ([x, y]: Point): string => `${mm(x)} ${mm(y)}`;

export const polyline = (points: readonly Point[]): string => `M${points.map(pair).join(" ")}`;
export const polygon = (points: readonly Point[]): string => `${polyline(points)}Z`;

/** A curve through its points as cubics, from the exact derivative at each: `at` gives place and velocity. */
export function smoothPath(
  at: (t: number) => { place: Point; velocity: Point },
  fromT: number,
  toT: number,
  segmentCount: number,
): string {
  const step = (toT - fromT) / segmentCount;
  let path = "";
  for (let i = 0; i < segmentCount; i++) {
    const a = at(fromT + i * step);
    const b = at(fromT + (i + 1) * step);
    if (i === 0) path = `M${pair(a.place)}C`;
    const c1: Point = [a.place[0] + (a.velocity[0] * step) / 3, a.place[1] + (a.velocity[1] * step) / 3];
    const c2: Point = [b.place[0] - (b.velocity[0] * step) / 3, b.place[1] - (b.velocity[1] * step) / 3];
    path += `${i === 0 ? "" : " "}${pair(c1)} ${pair(c2)} ${pair(b.place)}`;
  }
  return path;
}

/** A curve through given points (Catmull–Rom), as cubics. */
export function curveThrough(points: readonly Point[]): string {
  const point = (i: number): Point => points[Math.min(Math.max(i, 0), points.length - 1)] ?? [0, 0];
  let path = `M${pair(point(0))}C`;
  for (let i = 0; i + 1 < points.length; i++) {
    const [p0, p1, p2, p3] = [point(i - 1), point(i), point(i + 1), point(i + 2)];
    const c1: Point = [p1[0] + (p2[0] - p0[0]) / 6, p1[1] + (p2[1] - p0[1]) / 6];
    const c2: Point = [p2[0] - (p3[0] - p1[0]) / 6, p2[1] - (p3[1] - p1[1]) / 6];
    path += `${i === 0 ? "" : " "}${pair(c1)} ${pair(c2)} ${pair(p2)}`;
  }
  return path;
}

export interface SampleLayer {
  readonly name: string;
  readonly color: string;
  readonly paths: readonly string[];
}

/** A whole file: A4 landscape in mm, one Inkscape layer for each entry. */
export function samplePage(title: string, layers: readonly SampleLayer[], strokeWidthMm = 0.4): string {
  const groups = layers.map(
    (layer, i) =>
      `  <g id="layer${i + 1}" inkscape:groupmode="layer" inkscape:label="${layer.name}" stroke="${layer.color}">\n` +
      layer.paths.map((d) => `    <path d="${d}"/>\n`).join("") +
      "  </g>\n",
  );
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"` +
    ` width="${PAGE_WIDTH_MM}mm" height="${PAGE_HEIGHT_MM}mm" viewBox="0 0 ${PAGE_WIDTH_MM} ${PAGE_HEIGHT_MM}"` +
    ` fill="none" stroke-width="${strokeWidthMm}" stroke-linecap="round" stroke-linejoin="round">\n` +
    `  <title>${title}</title>\n${groups.join("")}</svg>\n`
  );
}
