/**
 * The benefit of each quality on a board: time in motion, and the distance between the drawing and the line of a
 * virtual board's pen on springs, compared with the default (A = 500, V = 50, δ = 0.025, not shaped) on the same
 * board. Medians over drawings.
 * quality.test.ts has the same for the plans.
 */
import { describe, expect, it } from "vitest";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  plan,
  type MotionSettings,
  type StrokeSet,
} from "../../../../../src/index.js";
import type { Quality, Springs } from "../../../../../src/internal.js";
import { cases, IS_FULL } from "../../../../support/runs/full-run.js";
import { sampleStrokes } from "../../../../support/drawings/sample-strokes.js";
import { SegmentGrid } from "../../../../support/drawings/segment-grid.js";
import { FIGURES, inQuality, median, SPRINGS, swinging } from "../../../../support/machines/swinging.js";
import { FastBoard } from "../../../../support/plots/virtual-plots.js";

const SAMPLES = [
  "hello-paper",
  ...(IS_FULL
    ? ["flower-meadow", "harmonograph", "moonrise", "three-colour-hills", "whirling-triangles"]
    : []),
];
const DRAWINGS: Readonly<Record<string, StrokeSet>> = {
  ...FIGURES,
  ...Object.fromEntries(await Promise.all(SAMPLES.map(async (name) => [name, await sampleStrokes(name)]))),
};
/** The machine's true frequency over the one that it is shaped for. */
const FACTORS = [1, 0.9, 1.1];

interface Played {
  readonly timeS: number;
  readonly maxMm: number;
  readonly rmsMm: number;
}

/** @param springs the springs on which the pen swings */
function played(
  strokes: StrokeSet,
  motion: MotionSettings,
  shapedFor: Springs,
  firmware: string,
  springs: Springs,
): Played {
  const machine = swinging(shapedFor);
  const fast = new FastBoard(firmware, machine, DEFAULT_PEN, { springs });
  const { firstWrong } = fast.play(fast.compile(plan(strokes, motion, DEFAULT_PEN, { machine })));
  expect(firstWrong).toBeNull();
  const asked = new SegmentGrid(2);
  for (let s = 0; s + 1 < strokes.offsets.length; s++) {
    asked.addPolyline(strokes.xy, 2 * strokes.offsets[s], 2 * strokes.offsets[s + 1]);
  }
  let maxMm = 0;
  let squares = 0;
  let count = 0;
  // A point for each millisecond, also of swinging while the pen waits at the ends of strokes.
  for (const { penDown, xy } of fast.board.drawn()) {
    for (let i = 0; penDown && i < xy.length; i += 2) {
      const mm = asked.distance(xy[i], xy[i + 1]);
      maxMm = Math.max(maxMm, mm);
      squares += mm * mm;
      count++;
    }
  }
  return { timeS: fast.board.statistics().movingS, maxMm, rmsMm: Math.sqrt(squares / count) };
}

const QUALITIES: readonly Quality[] = ["fine", "fast"];

/** The medians as shares of the default's, by quality: time, and the errors with each of FACTORS. */
function worth(springs: Springs, firmware: string) {
  const rows = Object.values(DRAWINGS).map((strokes) => {
    const before = played(strokes, DEFAULT_MOTION, springs, firmware, springs);
    return QUALITIES.map((quality) => {
      const after = FACTORS.map((factor) => {
        const body = { ...springs, xHz: factor * springs.xHz, yHz: factor * springs.yHz };
        return played(strokes, inQuality(quality, springs), springs, firmware, body);
      });
      return {
        time: after[0].timeS / before.timeS,
        max: after.map(({ maxMm }) => maxMm / before.maxMm),
        rms: after.map(({ rmsMm }) => rmsMm / before.rmsMm),
      };
    });
  });
  const [fine, fast] = QUALITIES.map((_, q) => ({
    time: median(rows.map((row) => row[q].time)),
    max: FACTORS.map((_, i) => median(rows.map((row) => row[q].max[i]))),
    rms: FACTORS.map((_, i) => median(rows.map((row) => row[q].rms[i]))),
  }));
  return { fine, fast };
}

// `npm test` has one machine and fewer drawings.
describe.each(SPRINGS.slice(0, cases(SPRINGS.length, 1)))("on springs of $xHz and $yHz Hz", (springs) => {
  it.each(["2.8.1", "3.0.3"])(
    "the pen of a board is as exact and as fast as promised, on firmware %s",
    { timeout: 1_800_000 },
    (firmware) => {
      const { fine, fast } = worth(springs, firmware);
      if (IS_FULL) console.info(springs, firmware, JSON.stringify({ fine, fast }));
      expect(fast.time).toBeLessThanOrEqual(0.65);
      for (const [right, low, high] of [fast.max, fast.rms]) {
        expect(right).toBeLessThanOrEqual(1);
        expect(Math.max(low, high)).toBeLessThanOrEqual(1.3);
      }
      expect(fine.time).toBeLessThanOrEqual(0.85);
      expect(fine.max[0]).toBeLessThanOrEqual(0.6);
      expect(Math.max(...fine.max)).toBeLessThanOrEqual(0.6);
    },
  );
});
