/**
 * npm run compare:shaping [rules|shapers|steps|assumed]: compares corner rules, shapers and quality settings on a machine that
 * swings. Prints the tables of docs/motion.md, and that of the corner rules in docs/comparison.md.
 *
 * Figures: medians over all samples of the time without pen waits and of the simulated pen's distance from the drawing,
 * as shares of the defaults' (A = 500, V = 50, δ = 0.025, not shaped).
 */
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  importSvg,
  machineById,
  plan,
  prepare,
  type MotionSettings,
  type StrokeSet,
  type Trajectory,
} from "../src/index.js";
import {
  MOTION_MODES,
  motionOfQuality,
  penError,
  QUALITIES,
  SHAPERS,
  type Springs,
} from "../src/internal.js";
import { shaperKernel } from "../src/plan/shaping/shapers.js";
import type { RunPlanner } from "../src/plan/run-writer.js";
import { inverseMotion } from "../test/support/trajectories/inverse-motion.js";
import { referenceRuns, shapedRuns } from "../test/support/reference-planners/motion.js";
import { REFERENCE_PLANNERS } from "../test/support/reference-planners/systems.js";
import { markdownTable } from "./doc-parts.js";

const FOLDER = path.join(import.meta.dirname, "..", "samples");
const SPRINGS: readonly Springs[] = [
  [10, 15],
  [15, 25],
  [25, 40],
].map(([xHz, yHz]) => ({ xHz, yHz, damping: 0.05 }));
/** The machine's true frequency as a multiple of the shaper's. */
const FACTORS = [1, 0.9, 1.1, 0.8, 1.2];

const drawings: readonly StrokeSet[] = await Promise.all(
  readdirSync(FOLDER).map(
    async (file) =>
      prepare(await importSvg(readFileSync(path.join(FOLDER, file), "utf8")), {
        ...DEFAULT_PREPARE,
        fit: true,
      }).strokes,
  ),
);

interface Variant {
  readonly name: string;
  readonly motion: MotionSettings;
  /** u = q + (2ζ/ω) q′ + q″/ω² of the plan. */
  readonly isInverse?: boolean;
  /** Another system's rules, instead of plotwright's. */
  readonly runs?: RunPlanner;
}

function rowOf(springs: Springs, { name, motion, isInverse, runs }: Variant): string[] {
  const machine = { ...machineById("axidraw-v3"), springs };
  const rows = drawings.map((strokes) => {
    const before = plan(strokes, DEFAULT_MOTION, DEFAULT_PEN, { machine });
    const planned = plan(strokes, motion, DEFAULT_PEN, { machine, runs });
    const after = isInverse ? inverseMotion(planned, springs) : planned;
    const errorOf = (t: Trajectory, factor: number) =>
      penError(strokes, t, { ...springs, xHz: factor * springs.xHz, yHz: factor * springs.yHz });
    const was = errorOf(before, 1);
    const errors = FACTORS.map((factor) => errorOf(after, factor));
    return {
      time: motionS(planned) / motionS(before),
      max: errors.map(({ maxMm }) => maxMm / was.maxMm),
      rms: errors.map(({ rmsMm }) => rmsMm / was.rmsMm),
    };
  });
  const errors = FACTORS.map((_, i) => {
    const medianOf = (what: "max" | "rms"): string => median(rows.map((row) => row[what][i])).toFixed(2);
    return `${medianOf("max")} / ${medianOf("rms")}`;
  });
  return [
    `${springs.xHz} / ${springs.yHz}`,
    name,
    median(rows.map(({ time }) => time)).toFixed(2),
    ...errors,
  ];
}

const HEAD = ["Hz x / y", "", "time", ...FACTORS.map((factor) => (factor === 1 ? "right" : `f × ${factor}`))];

const [, springs] = SPRINGS;
const fast = { ...DEFAULT_MOTION, ...motionOfQuality("fast", springs) };
const inverse = (jerk: number): Variant => ({
  name: `inverse, J = ${jerk / 1000} 000`,
  isInverse: true,
  motion: {
    ...fast,
    shaper: "none",
    mode: "scurve",
    draw: { ...fast.draw, jerkMmPerS3: jerk },
    travel: { ...fast.travel, jerkMmPerS3: 2 * jerk },
  },
});
const variants: readonly Variant[] = [
  ...SHAPERS.map((shaper): Variant => ({ name: shaper, motion: { ...fast, shaper } })),
  ...[10_000, 40_000, 160_000].map(inverse),
];
const kernel = shaperKernel("zv", springs)!;
/** Every system's rule at the limits of quality fast, with and without shaping. scurve is never shaped: it is a filter too. */
const rules: readonly Variant[] = [
  ...REFERENCE_PLANNERS.flatMap((reference): Variant[] => {
    const runs = referenceRuns(reference);
    return [
      { name: reference.name, motion: fast, runs },
      { name: `${reference.name}, shaped`, motion: fast, runs: shapedRuns(runs, kernel) },
    ];
  }),
  ...MOTION_MODES.flatMap((mode): Variant[] => [
    { name: `plotwright ${mode}`, motion: { ...fast, mode, shaper: "none" } },
    ...(mode === "scurve" ? [] : [{ name: `plotwright ${mode}, shaped`, motion: { ...fast, mode } }]),
  ]),
];

const steps: readonly (readonly [Springs, Variant])[] = SPRINGS.flatMap((one) =>
  QUALITIES.map((quality): readonly [Springs, Variant] => [
    one,
    { name: quality, motion: { ...DEFAULT_MOTION, ...motionOfQuality(quality, one) } },
  ]),
);

const TABLES = {
  rules: {
    title: "Corner rules at the limits of quality fast",
    rows: rules.map((variant) => [springs, variant] as const),
  },
  shapers: {
    title: "Shapers at the limits of quality fast",
    rows: variants.map((variant) => [springs, variant] as const),
  },
  steps: { title: "The steps of quality", rows: steps },
};
for (const [name, { title, rows }] of Object.entries(TABLES)) {
  if (process.argv[2] !== undefined && process.argv[2] !== name) continue;
  console.log(`${title}:\n`);
  console.log(
    `${markdownTable([HEAD, ...rows.map(([machineSprings, variant]) => rowOf(machineSprings, variant))])}\n`,
  );
}

/**
 * Before a machine is measured: shaped for assumed springs, with the true ones up to 25 % beside them in each axis. The worst
 * of all these cases and samples, as shares of the unshaped default on the same true springs.
 */
const ASSUMED: readonly Springs[] = [
  { xHz: 15, yHz: 25, damping: 0.05 },
  { xHz: 20, yHz: 30, damping: 0.05 },
];
const TRUE_FACTORS = [
  [1, 1],
  [0.75, 0.75],
  [1.25, 1.25],
  [0.75, 1.25],
  [1.25, 0.75],
];
const TRUE_DAMPINGS = [0.02, 0.12];

function assumedRow(assumed: Springs, name: string, motion: MotionSettings): string[] {
  const machine = { ...machineById("axidraw-v3"), springs: assumed };
  const worst = { max: 0, rms: 0 };
  for (const strokes of drawings) {
    const before = plan(strokes, DEFAULT_MOTION, DEFAULT_PEN, { machine });
    const after = plan(strokes, motion, DEFAULT_PEN, { machine });
    for (const [factorX, factorY] of TRUE_FACTORS) {
      for (const damping of TRUE_DAMPINGS) {
        const springs = { xHz: factorX * assumed.xHz, yHz: factorY * assumed.yHz, damping };
        const [was, is] = [before, after].map((trajectory) => penError(strokes, trajectory, springs));
        worst.max = Math.max(worst.max, is.maxMm / was.maxMm);
        worst.rms = Math.max(worst.rms, is.rmsMm / was.rmsMm);
      }
    }
  }
  return [`${assumed.xHz} / ${assumed.yHz}`, name, `${worst.max.toFixed(2)} / ${worst.rms.toFixed(2)}`];
}

if ([undefined, "assumed"].includes(process.argv[2])) {
  const rows = ASSUMED.flatMap((one) => [
    assumedRow(one, "zv at the default's limits", { ...DEFAULT_MOTION, shaper: "zv" }),
    ...(["fine", "normal"] as const).map((quality) =>
      assumedRow(one, quality, { ...DEFAULT_MOTION, ...motionOfQuality(quality, one) }),
    ),
  ]);
  console.log(`Shaped for assumed springs:\n\n${markdownTable([["Hz x / y", "", "worst"], ...rows])}\n`);
}

function motionS({ durationS, blockCount }: Trajectory): number {
  return durationS.subarray(0, blockCount).reduce((sum, s) => sum + s, 0);
}

function median(values: readonly number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const half = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}
