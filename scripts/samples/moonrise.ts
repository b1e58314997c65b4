/**
 * Only short strokes, thousands of them: a night sky that swirls around the moon, hills, and its light on the
 * water. Tone comes only from the density of the strokes.
 */
import { PAGE_HEIGHT_MM, PAGE_WIDTH_MM, polyline, samplePage, seededRandom, type Point } from "./svg.js";

const MARGIN_MM = 20;
const MOON = { x: 112, y: 68, radiusMm: 27 };
const SHORE_MM = 146;

interface Tone {
  /** Distance that a stroke keeps from others, mm: small is dark. */
  readonly gapMm: number;
  readonly angle: number;
  readonly lengthMm: number;
}

const hillLine = (x: number): number =>
  SHORE_MM - 15 - 9 * Math.sin(x * 0.021 + 0.4) - 5 * Math.sin(x * 0.053 + 2) - 1.6 * Math.sin(x * 0.16);

/** Stars: each with its own small whirl, turning against the moon's. */
const STARS = [
  { x: 226, y: 62, reachMm: 30, radiusMm: 4 },
  { x: 178, y: 36, reachMm: 15, radiusMm: 2.2 },
  { x: 44, y: 44, reachMm: 16, radiusMm: 2.2 },
  { x: 262, y: 106, reachMm: 17, radiusMm: 2.2 },
  { x: 182, y: 104, reachMm: 14, radiusMm: 1.8 },
  { x: 38, y: 98, reachMm: 13, radiusMm: 1.8 },
];

function sky(x: number, y: number): Tone | null {
  const dx = x - MOON.x;
  const dy = y - MOON.y;
  const distance = Math.hypot(dx, dy);
  let flowX = -dy / distance;
  let flowY = dx / distance;
  let starGlow = 0;
  for (const star of STARS) {
    const sx = x - star.x;
    const sy = y - star.y;
    const away = Math.hypot(sx, sy);
    if (away < star.radiusMm) return null;
    const pull = 2.6 * Math.exp(-((away / star.reachMm) ** 2) * 2);
    flowX += (pull * sy) / away;
    flowY -= (pull * sx) / away;
    starGlow = Math.max(starGlow, Math.exp(-((away - star.radiusMm) / (star.reachMm * 0.3))));
  }
  const glow = Math.exp(-(distance - MOON.radiusMm) / 42);
  const rings = 0.5 + 0.5 * Math.cos(((distance - MOON.radiusMm) * 2 * Math.PI) / 15);
  return {
    gapMm: 1.35 + 1.75 * Math.max(glow, 0.6 * starGlow) + 0.55 * rings,
    angle: Math.atan2(flowY, flowX),
    lengthMm: 3.4 + 1.2 * rings - 1.6 * starGlow,
  };
}

function moon(x: number, y: number): Tone | null {
  const dx = (x - MOON.x) / MOON.radiusMm;
  const dy = (y - MOON.y) / MOON.radiusMm;
  for (const [cx, cy, r] of [
    [-0.35, -0.2, 0.24],
    [0.22, -0.42, 0.16],
    [0.1, 0.25, 0.3],
    [-0.42, 0.42, 0.13],
    [0.55, 0.1, 0.12],
  ] as const) {
    if (Math.hypot(dx - cx, dy - cy) < r) return { gapMm: 1.7, angle: -0.6, lengthMm: 1.5 };
  }
  const rim = Math.hypot(dx + 0.28, dy + 0.2);
  return rim > 0.98 ? { gapMm: 1.5 + (1.28 - rim) * 4, angle: -0.6, lengthMm: 1.5 } : null;
}

function hill(x: number, y: number): Tone {
  const slope = Math.atan2(hillLine(x + 1) - hillLine(x - 1), 2);
  const depth = (y - hillLine(x)) / 20;
  return { gapMm: 0.85 + 0.35 * depth, angle: slope + 1.15, lengthMm: 2.4 };
}

function water(x: number, y: number): Tone | null {
  const depth = (y - SHORE_MM) / (PAGE_HEIGHT_MM - MARGIN_MM - SHORE_MM);
  const path = Math.abs(x - MOON.x) / (9 + 34 * depth);
  const light = Math.exp(-path * path);
  const ripple = 0.5 + 0.5 * Math.sin(y * (2.6 - 1.2 * depth) + 0.03 * x);
  if (light > 0.55 && ripple > 0.4) return null;
  return { gapMm: 1.15 + 0.5 * depth + 2.6 * light + 0.7 * ripple, angle: 0.03 * Math.sin(x * 0.2), lengthMm: 3 + 3 * depth };
}

function toneAt(x: number, y: number): Tone | null {
  if (Math.hypot(x - MOON.x, y - MOON.y) < MOON.radiusMm) return moon(x, y);
  if (y > SHORE_MM) return water(x, y);
  if (y > hillLine(x)) return hill(x, y);
  return sky(x, y);
}

/** Dart throwing with a distance that follows the tone: no two strokes' middles come closer than the gap there. */
function scatter(random: () => number): { x: number; y: number; tone: Tone }[] {
  const cellMm = 2.5;
  const columns = Math.ceil(PAGE_WIDTH_MM / cellMm);
  const rows = Math.ceil(PAGE_HEIGHT_MM / cellMm);
  const cells: Point[][] = Array.from({ length: columns * rows }, () => []);
  const isFree = (x: number, y: number, gapMm: number): boolean => {
    const reach = Math.ceil(gapMm / cellMm);
    const column = Math.floor(x / cellMm);
    const row = Math.floor(y / cellMm);
    for (let r = Math.max(row - reach, 0); r <= Math.min(row + reach, rows - 1); r++) {
      for (let c = Math.max(column - reach, 0); c <= Math.min(column + reach, columns - 1); c++) {
        for (const [px, py] of cells[r * columns + c] ?? []) {
          if ((px - x) ** 2 + (py - y) ** 2 < gapMm * gapMm) return false;
        }
      }
    }
    return true;
  };
  const strokes: { x: number; y: number; tone: Tone }[] = [];
  for (let dart = 0; dart < 260_000; dart++) {
    const x = MARGIN_MM + random() * (PAGE_WIDTH_MM - 2 * MARGIN_MM);
    const y = MARGIN_MM + random() * (PAGE_HEIGHT_MM - 2 * MARGIN_MM);
    const tone = toneAt(x, y);
    if (tone === null || !isFree(x, y, tone.gapMm)) continue;
    cells[Math.floor(y / cellMm) * columns + Math.floor(x / cellMm)]?.push([x, y]);
    strokes.push({ x, y, tone });
  }
  return strokes;
}

export function moonrise(): string {
  const random = seededRandom(1889);
  const paths = scatter(random).map(({ x, y, tone }) => {
    const half = (tone.lengthMm / 2) * (0.8 + 0.4 * random());
    const angle = tone.angle + 0.12 * (random() - 0.5);
    const dx = half * Math.cos(angle);
    const dy = half * Math.sin(angle);
    return polyline([
      [x - dx, y - dy],
      [x + dx, y + dy],
    ]);
  });
  return samplePage("Moonrise in short strokes", [{ name: "Strokes", color: "#27315c", paths }], 0.35);
}
