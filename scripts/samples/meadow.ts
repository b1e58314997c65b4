/** Line art: a summer meadow of grasses, ferns, poppies and dandelion clocks. The page's first drawing. */
import { curveThrough, pair, polyline, samplePage, seededRandom, type Point } from "./svg.js";

type Random = () => number;

/** A stem that leans and bends: places along it, and its direction there. */
interface Stem {
  readonly at: (part: number) => Point;
  readonly angle: (part: number) => number;
  readonly path: string;
}

const GROUND_MM = 193;
const polar = ([x, y]: Point, angle: number, length: number): Point => [
  x + length * Math.cos(angle),
  y + length * Math.sin(angle),
];

function stem(x: number, foot: number, heightMm: number, lean: number, bend: number): Stem {
  const p0: Point = [x, foot];
  const p1: Point = [x + lean * 0.1 * heightMm, foot - heightMm * 0.55];
  const p2: Point = [x + (lean + bend) * heightMm * 0.5, foot - heightMm];
  const at = (t: number): Point => [
    (1 - t) ** 2 * p0[0] + 2 * t * (1 - t) * p1[0] + t * t * p2[0],
    (1 - t) ** 2 * p0[1] + 2 * t * (1 - t) * p1[1] + t * t * p2[1],
  ];
  const angle = (t: number): number =>
    Math.atan2(
      (1 - t) * (p1[1] - p0[1]) + t * (p2[1] - p1[1]),
      (1 - t) * (p1[0] - p0[0]) + t * (p2[0] - p1[0]),
    );
  return { at, angle, path: `M${pair(p0)}Q${pair(p1)} ${pair(p2)}` };
}

/** A leaf: two curves from base to tip, and its midrib. `fullness` is its width to its length. */
function leaf(base: Point, angle: number, lengthMm: number, fullness: number, rib: boolean): string[] {
  const tip = polar(base, angle, lengthMm);
  const middle = polar(base, angle, lengthMm * 0.45);
  const left = polar(middle, angle - Math.PI / 2, lengthMm * fullness);
  const right = polar(middle, angle + Math.PI / 2, lengthMm * fullness);
  const outline = `M${pair(base)}Q${pair(left)} ${pair(tip)}Q${pair(right)} ${pair(base)}Z`;
  return rib ? [outline, `M${pair(base)}L${pair(polar(base, angle, lengthMm * 0.8))}`] : [outline];
}

/** Fern: pairs of leaflets that shorten towards the tip, each with a few smaller leaflets. */
function fern(random: Random, x: number, heightMm: number, lean: number): string[] {
  const frond = stem(x, GROUND_MM, heightMm, lean, lean * 0.9);
  const paths = [frond.path];
  const pairs = Math.round(heightMm / 2.7);
  for (let i = 0; i < pairs; i++) {
    const t = 0.16 + (0.83 * i) / pairs;
    const part = i / pairs;
    const length = heightMm * 0.34 * Math.min(1, 0.35 + 2.6 * part) * (1 - part) ** 0.75 + 1;
    for (const side of [-1, 1]) {
      const angle = frond.angle(t) + side * (1.12 - 0.3 * part + 0.05 * random());
      paths.push(...leaf(frond.at(t), angle, length, 0.13, length > 7));
    }
  }
  paths.push(...leaf(frond.at(0.98), frond.angle(1), heightMm * 0.05, 0.2, false));
  return paths;
}

/** Dandelion clock: seeds on fine rays around a small heart, each with a parasol of hairs. */
function dandelion(random: Random, x: number, heightMm: number, lean: number, radiusMm: number): string[] {
  const stalk = stem(x, GROUND_MM, heightMm, lean, lean * 0.5);
  const heart = stalk.at(1);
  const paths = [stalk.path, circle(heart, radiusMm * 0.13)];
  const seeds = 34;
  for (let i = 0; i < seeds; i++) {
    const angle = (2 * Math.PI * (i + 0.5 * random())) / seeds;
    const reach = radiusMm * (i % 2 === 0 ? 0.72 : 0.55) * (0.94 + 0.1 * random());
    const end = polar(heart, angle, reach);
    const parasol: Point[] = [];
    for (const spread of [-0.75, -0.4, 0, 0.4, 0.75]) {
      parasol.push(polar(end, angle + spread, radiusMm * 0.24), end);
    }
    paths.push(polyline([polar(heart, angle, radiusMm * 0.16), end, ...parasol.slice(0, -1)]));
  }
  return paths;
}

function driftingSeed(random: Random, at: Point, sizeMm: number): string[] {
  const angle = -Math.PI / 2 + 0.9 * (random() - 0.3);
  const top = polar(at, angle, sizeMm);
  const hairs: Point[] = [at, top];
  for (const spread of [-1.1, -0.65, -0.2, 0.25, 0.7, 1.1]) {
    hairs.push(polar(top, angle + spread, sizeMm * 0.75), top);
  }
  return [polyline(hairs.slice(0, -1)), ...leaf(at, angle + Math.PI, sizeMm * 0.35, 0.3, false)];
}

const circle = (center: Point, radius: number): string => {
  const left: Point = [center[0] - radius, center[1]];
  const right: Point = [center[0] + radius, center[1]];
  const r = `${radius.toFixed(2)} ${radius.toFixed(2)}`;
  return `M${pair(left)}A${r} 0 0 1 ${pair(right)}A${r} 0 0 1 ${pair(left)}Z`;
};

/** Poppy seen from the side: four wavy petals, creases in each, a ribbed seed box. */
function poppy(random: Random, x: number, heightMm: number, lean: number, sizeMm: number): string[] {
  const stalk = stem(x, GROUND_MM, heightMm, lean, lean * 0.8);
  const base = stalk.at(1);
  const up = stalk.angle(1);
  const paths = [stalk.path];
  for (const [spread, reach] of [
    [-0.88, 0.95],
    [0.88, 0.95],
    [-0.05, 1.05],
  ] as const) {
    paths.push(...petal(random, base, up + spread, sizeMm * reach, spread === -0.05 ? 0.62 : 0.55));
  }
  for (const side of [-1, 1]) {
    const t = 0.26 + 0.1 * random();
    paths.push(...lobedLeaf(stalk.at(t), stalk.angle(t) + side * 0.75, heightMm * 0.22));
  }
  return paths;
}

function petal(random: Random, base: Point, angle: number, lengthMm: number, halfWidth: number): string[] {
  const rim: Point[] = [];
  for (let i = 0; i <= 12; i++) {
    const part = i / 12;
    const across = (part - 0.5) * 2;
    const edge = lengthMm * (1 - 0.34 * across * across + 0.035 * Math.sin(i * 2.1 + random()));
    rim.push(polar(base, angle + across * halfWidth, edge));
  }
  const outline = curveThrough([base, polar(base, angle - halfWidth * 1.05, lengthMm * 0.35), ...rim, polar(base, angle + halfWidth * 1.05, lengthMm * 0.35), base]);
  const creases = [-0.62, -0.36, -0.12, 0.12, 0.36, 0.62].map((across) => {
    const from = polar(base, angle + across * halfWidth * 0.5, lengthMm * 0.2);
    const via = polar(base, angle + across * halfWidth * 0.95, lengthMm * 0.45);
    const to = polar(base, angle + across * halfWidth, lengthMm * (0.6 + 0.18 * random()));
    return `M${pair(from)}Q${pair(via)} ${pair(to)}`;
  });
  return [outline, ...creases];
}

/** A leaf with teeth on both sides. */
function lobedLeaf(base: Point, angle: number, lengthMm: number): string[] {
  const side = (sign: number): Point[] => {
    const points: Point[] = [];
    for (let tooth = 1; tooth <= 5; tooth++) {
      const along = polar(base, angle, (lengthMm * tooth) / 6);
      const reach = lengthMm * 0.2 * Math.sin((Math.PI * tooth) / 6);
      points.push(polar(along, angle + sign * 1.0, reach), polar(along, angle + sign * 0.7, reach * 0.42));
    }
    return points;
  };
  const outline = [base, ...side(-1), polar(base, angle, lengthMm), ...side(1).reverse(), base];
  return [polyline(outline), polyline([base, polar(base, angle, lengthMm * 0.85)])];
}

/** A blade of grass, and an ear of grain where it is tall. */
function grass(random: Random, x: number, heightMm: number, lean: number, ear: boolean): string[] {
  const blade = stem(x, GROUND_MM, heightMm, lean, lean * 1.6);
  if (!ear) {
    const other = stem(x + 0.9 + 0.5 * random(), GROUND_MM, heightMm * 0.995, lean, lean * 1.6);
    return [`${blade.path}Q${pair(other.at(0.55))} ${pair(other.at(0))}`];
  }
  const paths = [blade.path];
  for (let i = 0; i < 11; i++) {
    const t = 0.7 + (0.3 * i) / 11;
    const side = i % 2 === 0 ? -1 : 1;
    paths.push(...leaf(blade.at(t), blade.angle(t) + side * 0.42, 5.2 - i * 0.15, 0.24, false));
    paths.push(`M${pair(polar(blade.at(t), blade.angle(t) + side * 0.42, 5))}L${pair(polar(blade.at(t), blade.angle(t) + side * 0.36, 10))}`);
  }
  return paths;
}

export function meadow(): string {
  const random = seededRandom(7);
  const paths: string[] = [];
  for (let i = 0; i < 46; i++) {
    const x = 24 + 238 * ((i + 0.8 * random()) / 46);
    paths.push(...grass(random, x, 16 + 34 * random() ** 1.6, 0.9 * (random() - 0.5), false));
  }
  for (const [x, height, lean] of [[36, 104, -0.1], [126, 118, 0.1], [178, 128, -0.05]] as const) {
    paths.push(...grass(random, x, height, lean, true));
  }
  for (const [x, height, lean] of [[42, 72, -0.2], [72, 92, 0.18], [166, 84, -0.2], [206, 76, 0.2], [252, 66, 0.12]] as const) {
    paths.push(...fern(random, x, height, lean));
  }
  for (const [x, height, lean, size] of [[86, 114, 0.08, 27], [204, 104, 0.05, 22], [228, 138, 0.08, 25]] as const) {
    paths.push(...poppy(random, x, height, lean, size));
  }
  for (const [x, height, lean, radius] of [[112, 78, 0.1, 18], [148, 141, 0.04, 24], [257, 92, 0.06, 16], [54, 143, 0.04, 21]] as const) {
    paths.push(...dandelion(random, x, height, lean, radius));
  }
  for (const [x, y, size] of [[186, 40, 6], [199, 28, 5], [207, 47, 4.5], [219, 24, 5], [178, 22, 4], [112, 30, 5], [98, 44, 4.5], [268, 40, 4.5], [252, 22, 4]] as const) {
    paths.push(...driftingSeed(random, [x, y], size));
  }
  return samplePage("Summer meadow", [{ name: "Meadow", color: "#20443a", paths }], 0.35);
}
