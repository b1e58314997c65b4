/** `npx tsx scripts/true-corners.ts`: what one corner costs under each rule and at least, for docs/comparison.md. */
import { blendLoss, junctionLoss, leastLoss } from "../test/support/corner-bound.js";

const LIMITS = { accel: 500, deviation: 0.05 };
/** Long sides, mm. */
const SIDE = 1e6;
const ms = (s: number): string => (1000 * s).toFixed(1).padStart(8);

console.log(
  "| turn | V mm/s | junction | blend    | least    |\n| ---: | -----: | -------: | -------: | -------: |",
);
for (const deg of [30, 45, 60, 90, 120, 150]) {
  for (const speed of [5, 10, 25, 50, 100]) {
    const corner = { ...LIMITS, speed, turn: (deg * Math.PI) / 180 };
    const least = leastLoss(corner);
    const row = [junctionLoss(corner), blendLoss(corner, SIDE), least].map(ms).join(" | ");
    console.log(`| ${String(deg).padStart(3)}° | ${String(speed).padStart(6)} | ${row} |`);
  }
}
