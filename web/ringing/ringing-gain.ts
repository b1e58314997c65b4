/** The benefit of measuring: a test figure, planned as before and in each quality, drawn by a simulated pen. */
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  planJob,
  type MachineProfile,
  type StrokeSet,
} from "../../src/index.js";
import { motionOfQuality, penError, QUALITIES, type Quality, type Springs } from "../../src/internal.js";

export interface GainRequest {
  readonly machine: MachineProfile;
  readonly springs: Springs;
}

export interface Gain {
  readonly quality: Quality | "before";
  /** Pen down, without waits. */
  readonly drawS: number;
  /** The pen's largest distance from the line. */
  readonly maxMm: number;
}

export const gainsOf = (machine: MachineProfile, springs: Springs): readonly Gain[] => {
  const strokes = testFigure();
  const measured = { ...machine, springs };
  return (["before", ...QUALITIES] as const).map((quality) => {
    const step = quality === "before" ? {} : motionOfQuality(quality, springs);
    const settings = { motion: { ...DEFAULT_MOTION, ...step }, pen: DEFAULT_PEN };
    const { trajectory } = planJob({ strokes }, settings, measured);
    const { runs, durationS } = trajectory;
    let drawS = 0;
    for (let run = 0; run < runs.count; run++) {
      if (runs.stroke[run] < 0) continue;
      for (let k = runs.firstBlock[run]; k < runs.firstBlock[run + 1]; k++) drawS += durationS[k];
    }
    return { quality, drawS, maxMm: penError(strokes, trajectory, springs).maxMm };
  });
};

const TIPS = 7;
const CIRCLE_POINTS = 120;

/** A star, two circles and a zigzag, because drawings have sharp corners, curves and short lines. */
const testFigure = (): StrokeSet => {
  const lines = [
    polar(2 * TIPS, (i) => (i % 2 === 0 ? 25 : 10), 30, 30),
    polar(CIRCLE_POINTS, () => 20, 85, 30),
    polar(CIRCLE_POINTS, () => 4, 85, 30),
    Array.from({ length: 41 }, (_, i) => [10 + 2.5 * i, i % 2 === 0 ? 62 : 66]).flat(),
  ];
  const offsets = [0];
  for (const line of lines) offsets.push(offsets[offsets.length - 1] + line.length / 2);
  return {
    xy: Float64Array.from(lines.flat()),
    offsets: Uint32Array.from(offsets),
    layer: new Uint16Array(lines.length),
    layers: [{ id: "figure", name: "figure", color: null }],
  };
};

const polar = (count: number, radiusMm: (i: number) => number, xMm: number, yMm: number): number[] =>
  Array.from({ length: count + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / count;
    return [xMm + radiusMm(i) * Math.cos(angle), yMm + radiusMm(i) * Math.sin(angle)];
  }).flat();
