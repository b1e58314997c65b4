/** Three pens, three layers: a sun drawn as a spiral, ranges of hills, and pines in front. */
import { curveThrough, pair, polyline, samplePage, seededRandom, smoothPath, type Point } from "./svg.js";

const LEFT = 20;
const RIGHT = 277;
const SUN = { x: 196, y: 72, radiusMm: 34 };

/** Smooth one-dimensional noise: a few octaves of sines with random phases. */
function ridgeNoise(random: () => number, octaves: number): (x: number) => number {
  const waves = Array.from({ length: octaves }, (_, k) => ({
    frequency: (0.014 + 0.006 * random()) * 1.9 ** k,
    phase: random() * 2 * Math.PI,
    height: 0.56 ** k,
  }));
  return (x) => waves.reduce((sum, w) => sum + w.height * Math.sin(w.frequency * x * 2 * Math.PI + w.phase), 0);
}

/** The hills' lines from front to back: each is drawn only where it is above all lines before it. */
function hills(random: () => number): { paths: string[]; horizon: (x: number) => number; front: (x: number) => number } {
  const paths: string[] = [];
  const stepMm = 0.75;
  const columns = Math.round((RIGHT - LEFT) / stepMm) + 1;
  const skyline = new Float64Array(columns).fill(Infinity);
  let front: (x: number) => number = () => 0;
  const ranges = [
    { base: 176, height: 7, lines: 7, gap: 2.6, octaves: 3 },
    { base: 148, height: 13, lines: 10, gap: 2.3, octaves: 4 },
    { base: 119, height: 17, lines: 9, gap: 1.9, octaves: 5 },
  ];
  for (const [index, range] of ranges.entries()) {
    const noise = ridgeNoise(random, range.octaves);
    for (let line = range.lines - 1; line >= 0; line--) {
      // Lower lines of a range flatten out, so the folds seem to run down the slope.
      const flatten = 1 - line / (range.lines * 1.35);
      const y = (x: number): number =>
        range.base + line * range.gap * 1.1 - range.height * flatten * noise(x + line * 2.2);
      if (index === 0 && line === range.lines - 2) front = y;
      let run: Point[] = [];
      const flush = (): void => {
        if (run.length > 3) paths.push(curveThrough(run.filter((_, i) => i % 2 === 0 || i === run.length - 1)));
        run = [];
      };
      for (let i = 0; i < columns; i++) {
        const x = LEFT + i * stepMm;
        const value = y(x);
        if (value < (skyline[i] ?? Infinity) - 0.25) {
          skyline[i] = value;
          run.push([x, value]);
        } else flush();
      }
      flush();
    }
  }
  const horizon = (x: number): number => {
    const at = Math.min(Math.max((x - LEFT) / stepMm, 0), columns - 1.001);
    const i = Math.floor(at);
    return (skyline[i] ?? 0) * (1 - (at - i)) + (skyline[i + 1] ?? 0) * (at - i);
  };
  return { paths, horizon, front };
}

/** A spiral, cut off where the hills hide it. */
function sun(horizon: (x: number) => number): string[] {
  const turns = 21;
  const at = (t: number): { place: Point; velocity: Point } => {
    const angle = 2 * Math.PI * t;
    const radius = (SUN.radiusMm * t) / turns;
    const growth = SUN.radiusMm / turns;
    return {
      place: [SUN.x + radius * Math.cos(angle), SUN.y + radius * Math.sin(angle)],
      velocity: [
        growth * Math.cos(angle) - 2 * Math.PI * radius * Math.sin(angle),
        growth * Math.sin(angle) + 2 * Math.PI * radius * Math.cos(angle),
      ],
    };
  };
  const visible = (t: number): boolean => {
    const [x, y] = at(t).place;
    return y < horizon(x) - 0.8;
  };
  const paths: string[] = [];
  const sliceCount = turns * 120;
  let begin = -1;
  for (let i = 0; i <= sliceCount; i++) {
    const shown = i < sliceCount && visible((i * turns) / sliceCount);
    if (shown && begin < 0) begin = i;
    if (!shown && begin >= 0) {
      const count = i - begin;
      const from = (begin * turns) / sliceCount;
      if (count > 2) paths.push(smoothPath(at, from, (i * turns) / sliceCount, Math.max(2, Math.round(count / 8))));
      begin = -1;
    }
  }
  return paths;
}

/** One pine: a trunk, and drooping branches that zigzag from the top down. */
function pine(random: () => number, x: number, foot: number, heightMm: number): string[] {
  const points: Point[] = [[x, foot - heightMm]];
  const rows = Math.round(heightMm / 1.5);
  for (let row = 1; row <= rows; row++) {
    const part = row / rows;
    const y = foot - heightMm * (1 - 0.9 * part);
    const reach = heightMm * 0.2 * part ** 0.85 * (0.75 + 0.5 * random());
    const side = row % 2 === 0 ? 1 : -1;
    points.push([x + side * reach, y + reach * 0.35], [x - side * reach * 0.12, y - 0.2]);
  }
  return [polyline(points), polyline([[x, foot - heightMm * 0.1], [x, foot]])];
}

export function threeColours(): string {
  const random = seededRandom(20);
  const land = hills(random);
  const pines: string[] = [];
  for (const [x, heightMm] of [
    [34, 30], [43, 44], [51, 35], [60, 24], [67, 31], [84, 18], [225, 20], [238, 33], [246, 26], [255, 46], [264, 36], [270, 22],
  ] as const) {
    pines.push(...pine(random, x, land.front(x) + 3, heightMm));
  }
  for (let bird = 0; bird < 7; bird++) {
    const x = 92 + bird * 9 + 6 * random();
    const y = 52 + 3.2 * Math.abs(bird - 3) + 5 * random();
    const span = 2.6 + 1.6 * random();
    const dip = y - span * 0.35;
    const lift = y - span * 0.75;
    pines.push(
      `M${pair([x - span, dip])}Q${pair([x - span * 0.45, lift])} ${pair([x, y])}` +
        `Q${pair([x + span * 0.45, lift])} ${pair([x + span, dip])}`,
    );
  }
  return samplePage("Hills in three colours", [
    { name: "1 Sun", color: "#e4572e", paths: sun(land.horizon) },
    { name: "2 Hills", color: "#2e6f95", paths: land.paths },
    { name: "3 Pines and birds", color: "#1f2d27", paths: pines },
  ]);
}
