/**
 * `npx tsx scripts/true-corners.ts`: the time that one corner costs under each rule, the possible minimum, and
 * how much longer blend takes than junction for whole polygons. For docs/comparison.md.
 */
import { DEFAULT_PEN, plan, type StrokeSet } from "../src/index.js";
import type { MotionMode } from "../src/internal.js";
import { blendLoss, junctionLoss, leastLoss } from "../test/support/trajectories/corner-bound.js";

const LIMITS = { accel: 500, deviation: 0.05 };
const ms = (s: number): string => (1000 * s).toFixed(1).padStart(8);

console.log(
  "| turn | V mm/s | junction | blend    | min      |\n| ---: | -----: | -------: | -------: | -------: |",
);
for (const deg of [30, 45, 60, 90, 120, 150]) {
  for (const speed of [5, 10, 25, 50, 100]) {
    const corner = { ...LIMITS, speed, turn: (deg * Math.PI) / 180 };
    const least = leastLoss(corner);
    const row = [junctionLoss(corner), blendLoss(corner), least].map(ms).join(" | ");
    console.log(`| ${String(deg).padStart(3)}° | ${String(speed).padStart(6)} | ${row} |`);
  }
}

const SIDES_MM = [0.5, 1, 2, 5, 20];
/** Corners, and number of turns: the second one is a star of five points. */
const POLYGONS = [
  [3, 1],
  [5, 2],
  [4, 1],
  [6, 1],
  [8, 1],
  [12, 1],
] as const;
for (const speed of [10, 50]) {
  console.log(`\nV = ${speed} mm/s`);
  console.log(`\n|   polygon | ${SIDES_MM.map((side) => `${side} mm`.padStart(6)).join(" | ")} |`);
  console.log(`| --------: |${" -----: |".repeat(SIDES_MM.length)}`);
  for (const [corners, times] of POLYGONS) {
    const row = SIDES_MM.map((side) => {
      const polygon = regularPolygon(corners, times, side);
      const ratio = drawS("blend", polygon, speed) / drawS("junction", polygon, speed);
      const tenths = Math.round(1000 * (ratio - 1));
      const sign = tenths > 0 ? "+" : tenths < 0 ? "-" : "";
      return `${sign}${(Math.abs(tenths) / 10).toFixed(1)} %`.padStart(6);
    });
    console.log(`| ${(times > 1 ? "5, a star" : String(corners)).padStart(9)} | ${row.join(" | ")} |`);
  }
}

function regularPolygon(corners: number, times: number, side: number): StrokeSet {
  const turn = (2 * Math.PI * times) / corners;
  const radius = side / 2 / Math.sin(turn / 2);
  const angles = Array.from({ length: corners + 1 }, (_, i) => turn * i);
  return {
    xy: Float64Array.from(angles.flatMap((a) => [100 + radius * Math.cos(a), 100 + radius * Math.sin(a)])),
    offsets: Uint32Array.of(0, corners + 1),
    layer: Uint16Array.of(0),
    layers: [{ id: "1", name: "", color: null }],
  };
}

function drawS(mode: MotionMode, polygon: StrokeSet, speedMmPerS: number): number {
  const draw = { speedMmPerS, accelMmPerS2: LIMITS.accel, cornerMm: LIMITS.deviation, jerkMmPerS3: 1e4 };
  const start = { startX: polygon.xy[0], startY: polygon.xy[1], returnHome: false };
  const pen = { ...DEFAULT_PEN, extraLiftMs: -500, extraDropMs: -500 };
  return plan(polygon, { mode, draw, travel: draw, fit: null }, pen, start).totalS;
}
