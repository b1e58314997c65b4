/**
 * Planning compared with a floor: a bare two-pass loop that writes the same blocks into existing arrays. The
 * floor gets the results of planning for free (lengths, directions, corner limits), so a ratio shows the cost
 * of everything else: corners, counting, growing arrays, runs.
 *
 * There are two floors: the loop as first written, and a tighter one without a function for each block,
 * because V8 boxes the numbers that such a function changes.
 *
 * Times are processor time of all threads. A machine's speed drifts by a third within seconds, so both floors
 * run before and after each plan. A plan's ratio is its time over the mean of the two runs of a floor. The
 * result is the median over the rounds.
 */
import { readFileSync, readdirSync } from "node:fs";
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
import { DEFAULT_FIT, MOTION_MODES, motionOfQuality, type Shaper } from "../src/internal.js";

type Report = (section: string, rows: readonly Record<string, string | number>[]) => void;

/** The names of the loops, and of the ratios to them. */
const FLOORS = [
  { what: "bare two-pass loop, as first written", of: "ratio", loop: firstLoop },
  { what: "the same, tighter", of: "ratio to the tighter", loop: tightLoop },
] as const;

const ROUNDS = 7;
const REPEATS = 5;

export default async function planBench(report: Report): Promise<void> {
  // First, while the heap is empty: garbage collection of a million segments would be counted here.
  report("Planning the samples with and without merging, blend, warm", await samples());
  const drawing = scribble(1_000_000, 1_000);
  const floor = prepareFloor(drawing);
  const motions: readonly (readonly [string, MotionSettings])[] = [
    ...MOTION_MODES.map((mode) => [mode, { ...DEFAULT_MOTION, mode, fit: null }] as const),
    ["blend, merged", { ...DEFAULT_MOTION, mode: "blend", fit: DEFAULT_FIT }],
  ];
  const planned = new Map<string, Pick<Trajectory, "blockCount"> & { readonly bytes: number }>();
  const { floorsMs, measured } = inTurns(
    FLOORS.map(
      ({ loop }) =>
        () =>
          loop(floor),
    ),
    motions.map(([what, motion]) => () => {
      const trajectory = plan(drawing, motion, DEFAULT_PEN);
      planned.set(what, { blockCount: trajectory.blockCount, bytes: bytesOf(trajectory) });
    }),
  );
  report("Planning one million segments (1 000 strokes), one thread", [
    ...FLOORS.map(({ what }, i) => ({ what, "processor ms": Math.round(floorsMs[i]), blocks: floor.count })),
    ...motions.map(([what], i) => {
      const { blockCount, bytes } = planned.get(what)!;
      const { ms, ratios } = measured[i];
      return {
        what,
        "processor ms": Math.round(median(ms)),
        blocks: blockCount,
        "bytes/block": Math.round(bytes / blockCount),
        ...Object.fromEntries(FLOORS.map(({ of }, f) => [of, spread(ratios[f])])),
      };
    }),
  ]);
  report("Growth with the number of segments, blend", growth());
  report("Shaped (quality fast, 15 and 25 Hz) against the same limits unshaped, warm", await shaped());
}

const SAMPLES = path.join(import.meta.dirname, "..", "samples");

const sampleStrokes = async (file: string): Promise<StrokeSet> =>
  prepare(await importSvg(readFileSync(path.join(SAMPLES, file), "utf8")), { ...DEFAULT_PREPARE, fit: false })
    .strokes;

/** Number of warm-up rounds, and of timed rounds. */
const WARM_UP = 10;
const SAMPLE_ROUNDS = 31;
/**
 * A round plans a sample repeatedly, until it has planned about this many points: so many that each round contains its
 * share of garbage collection. With 15 000 points the ratio of one sample was between 1.24 and 1.74 from run to run.
 */
const POINTS_A_ROUND = 60_000;

/** Processor ms with and without merging, alternating, warm; the ratio is the median of the rounds' ratios. */
async function samples(): Promise<Record<string, string | number>[]> {
  const files = readdirSync(SAMPLES).filter((name) => name.endsWith(".svg"));
  return await Promise.all(
    files.map(async (file) => {
      const strokes = await sampleStrokes(file);
      const repeats = Math.ceil((2 * POINTS_A_ROUND) / strokes.xy.length);
      const planned = (fit: MotionSettings["fit"]) => plan(strokes, { ...DEFAULT_MOTION, fit }, DEFAULT_PEN);
      const timed = (fit: MotionSettings["fit"]): number =>
        processorMs(() => {
          for (let i = 0; i < repeats; i++) planned(fit);
        }) / repeats;
      const rounds = Array.from({ length: WARM_UP + SAMPLE_ROUNDS }, () => {
        const plainMs = timed(null);
        const mergedMs = timed(DEFAULT_FIT);
        return { plainMs, mergedMs, ratio: mergedMs / plainMs };
      }).slice(WARM_UP);
      return {
        sample: file,
        points: strokes.xy.length / 2,
        blocks: planned(null).blockCount,
        merged: planned(DEFAULT_FIT).blockCount,
        "plain, ms": Number(median(rounds.map(({ plainMs }) => plainMs)).toFixed(2)),
        "merged, ms": Number(median(rounds.map(({ mergedMs }) => mergedMs)).toFixed(2)),
        ratio: Number(median(rounds.map(({ ratio }) => ratio)).toFixed(2)),
      };
    }),
  );
}

/**
 * Time per segment at two sizes: equal if growth is linear. The small drawing is planned repeatedly and its
 * plans are stored, so that as much memory is touched for the first time as for the large one: the system
 * charges for that.
 */
function growth(): Record<string, string | number>[] {
  const sizes = [100_000, 1_000_000];
  const maxSegments = Math.max(...sizes);
  const motion: MotionSettings = { ...DEFAULT_MOTION, mode: "blend", fit: null };
  const times = best(
    sizes.map((segments) => {
      const drawing = scribble(segments, segments / 1000);
      return () => Array.from({ length: maxSegments / segments }, () => plan(drawing, motion, DEFAULT_PEN));
    }),
  );
  return sizes.map((segments, i) => ({
    segments,
    plans: maxSegments / segments,
    "processor ms": Math.round(times[i]),
    "ns/segment": Math.round((1e6 * times[i]) / maxSegments),
  }));
}

const SPRINGS = { xHz: 15, yHz: 25, damping: 0.05 };
/** Rounds of shaped and unshaped planning in turns; the first ones are not counted. */
const SHAPED_ROUNDS = 9;
const SHAPED_WARM_UP = 3;

/** Medians of processor ms and of the rounds' ratios; bytes of a plan and the planned motion in it. */
async function shaped(): Promise<Record<string, string | number>[]> {
  const lines = [100_000, 1_000_000].map(
    (segments) => [`${segments} segments, lines of 1000`, scribble(segments, segments / 1000)] as const,
  );
  const files = await Promise.all(
    readdirSync(SAMPLES)
      .filter((name) => name.endsWith(".svg"))
      .map(async (file) => [file, await sampleStrokes(file)] as const),
  );
  return [...lines, ...files].map(([what, strokes]) => {
    const motion = { ...DEFAULT_MOTION, ...motionOfQuality("fast", SPRINGS) };
    const machine = { ...machineById("axidraw-v3"), springs: SPRINGS };
    const repeats = Math.ceil(POINTS_A_ROUND / (strokes.xy.length / 2));
    let t: Trajectory | null = null;
    const timed = (shaper: Shaper): number =>
      processorMs(() => {
        for (let i = 0; i < repeats; i++) {
          t = plan(strokes, { ...motion, shaper }, DEFAULT_PEN, { machine });
        }
      }) / repeats;
    const rounds = Array.from({ length: SHAPED_WARM_UP + SHAPED_ROUNDS }, () => {
      const plainMs = timed("none");
      const bytes = planBytes(t!);
      const shapedMs = timed(motion.shaper ?? "none");
      return { plainMs, shapedMs, ratio: shapedMs / plainMs, bytes, shapedBytes: planBytes(t!) };
    }).slice(SHAPED_WARM_UP);
    const strokeCount = strokes.offsets.length - 1;
    return {
      what,
      strokes: strokeCount,
      "plain, ms": Number(median(rounds.map(({ plainMs }) => plainMs)).toFixed(2)),
      "shaped, ms": Number(median(rounds.map(({ shapedMs }) => shapedMs)).toFixed(2)),
      ratio: Number(median(rounds.map(({ ratio }) => ratio)).toFixed(2)),
      "plain bytes/stroke": Math.round(rounds[0].bytes / strokeCount),
      "shaped bytes/stroke": Math.round(rounds[0].shapedBytes / strokeCount),
    };
  });
}

const planBytes = (t: Trajectory): number => bytesOf(t) + (t.planned ? bytesOf(t.planned.trajectory) : 0);

function bytesOf(t: Trajectory): number {
  const columns = [t.durationS, t.x, t.y, t.vx, t.vy, t.ax, t.ay, t.startS, t.alongMm, t.jx, t.jy];
  return columns.reduce((sum, column) => sum + (column ? column.byteLength : 0), 0);
}

const spread = (values: readonly number[]): string =>
  `${median(values).toFixed(2)} (${Math.min(...values).toFixed(1)} to ${Math.max(...values).toFixed(1)})`;

interface Measured {
  /** For each round: processor ms, and its ratio to each floor at that time. */
  readonly ms: number[];
  readonly ratios: readonly number[][];
}

/**
 * Runs the floors, the first plan, the floors, the second plan … in every round; the first round is not
 * counted.
 */
function inTurns(
  floors: readonly (() => void)[],
  plans: readonly (() => void)[],
): { floorsMs: readonly number[]; measured: readonly Measured[] } {
  const measured = plans.map((): Measured => ({ ms: [], ratios: floors.map(() => []) }));
  const floorsMs = floors.map((): number[] => []);
  for (let round = 0; round <= ROUNDS; round++) {
    plans.forEach((run, i) => {
      const before = floors.map(processorMs);
      const ms = processorMs(run);
      const after = floors.map(processorMs);
      if (round === 0) return;
      measured[i].ms.push(ms);
      floors.forEach((_, f) => {
        measured[i].ratios[f].push((2 * ms) / (before[f] + after[f]));
        floorsMs[f].push(before[f], after[f]);
      });
    });
  }
  return { floorsMs: floorsMs.map(median), measured };
}

function processorMs(run: () => unknown): number {
  const start = process.cpuUsage();
  run();
  const { user, system } = process.cpuUsage(start);
  return (user + system) / 1000;
}

function median(values: readonly number[]): number {
  return [...values].sort((a, b) => a - b)[values.length >> 1];
}

/** Processor ms of each, the minimum of REPEATS, alternating. */
function best(runs: readonly (() => unknown)[]): number[] {
  const ms = runs.map(() => Infinity);
  for (let round = 0; round < REPEATS; round++) {
    runs.forEach((run, i) => (ms[i] = Math.min(ms[i], processorMs(run))));
  }
  return ms;
}

/** Smooth lines with occasional corners, 0.2 to 1 mm per segment; the same every time. */
export function scribble(segments: number, strokes: number): StrokeSet {
  let seed = 12345;
  const random = (): number => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648;
  const perStroke = segments / strokes + 1;
  const xy = new Float64Array(2 * perStroke * strokes);
  let heading = 0;
  for (let s = 0, k = 0; s < strokes; s++) {
    let x = 50 + 200 * random();
    let y = 50 + 150 * random();
    let bend = 0;
    for (let i = 0; i < perStroke; i++) {
      xy[k++] = x;
      xy[k++] = y;
      bend = 0.9 * bend + 0.1 * (random() - 0.5);
      heading += random() < 0.01 ? 3 * (random() - 0.5) : bend;
      const step = 0.2 + 0.8 * random();
      x += step * Math.cos(heading);
      y += step * Math.sin(heading);
    }
  }
  return {
    xy,
    offsets: Uint32Array.from({ length: strokes + 1 }, (_, i) => i * perStroke),
    layer: new Uint16Array(strokes),
    layers: [{ id: "all", name: "All", color: null }],
  };
}

interface Floor {
  count: number;
  readonly segments: number;
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly ux: Float64Array;
  readonly uy: Float64Array;
  readonly length: Float64Array;
  readonly limit2: Float64Array;
  readonly v2: Float64Array;
  readonly columns: NineColumns;
}

/** The inputs of the bare loop: segments, their corner limits, and arrays already paged in. */
function prepareFloor(drawing: StrokeSet): Floor {
  const segments = drawing.xy.length / 2 - 1;
  const make = (n: number) => new Float64Array(n).fill(1);
  const floor: Floor = {
    count: 0,
    segments,
    x: make(segments + 1),
    y: make(segments + 1),
    ux: make(segments),
    uy: make(segments),
    length: make(segments),
    limit2: make(segments + 1),
    v2: make(segments + 1),
    columns: Array.from({ length: 9 }, () => make(3 * segments)) as unknown as NineColumns,
  };
  const planned = plan(drawing, { ...DEFAULT_MOTION, mode: "junction", fit: null }, DEFAULT_PEN);
  // The corner limits: the speeds of the plan itself.
  for (let i = 0; i <= segments; i++) {
    floor.x[i] = drawing.xy[2 * i];
    floor.y[i] = drawing.xy[2 * i + 1];
    if (i === 0) continue;
    const dx = floor.x[i] - floor.x[i - 1];
    const dy = floor.y[i] - floor.y[i - 1];
    const l = Math.hypot(dx, dy);
    floor.length[i - 1] = l;
    floor.ux[i - 1] = dx / l;
    floor.uy[i - 1] = dy / l;
  }
  const stops = new Set(drawing.offsets);
  const at = new Map<string, number>();
  for (let k = 0; k < planned.blockCount; k++) {
    at.set(`${planned.x[k]},${planned.y[k]}`, planned.vx[k] ** 2 + planned.vy[k] ** 2);
  }
  for (let i = 0; i <= segments; i++) {
    floor.limit2[i] = stops.has(i) || i === segments ? 0 : (at.get(`${floor.x[i]},${floor.y[i]}`) ?? 0);
  }
  return floor;
}

type NineColumns = readonly [
  Float64Array,
  Float64Array,
  Float64Array,
  Float64Array,
  Float64Array,
  Float64Array,
  Float64Array,
  Float64Array,
  Float64Array,
];

/** As first written. */
function firstLoop(floor: Floor): void {
  const { segments: n, x, y, ux, uy, length, limit2, v2, columns } = floor;
  const [durationS, bx, by, vx, vy, ax, ay, startS, alongMm] = columns;
  const { accelMmPerS2: accel, speedMmPerS: speed } = DEFAULT_MOTION.draw;
  const max2 = speed * speed;
  v2[n] = 0;
  for (let i = n - 1; i >= 0; i--) v2[i] = Math.min(limit2[i], v2[i + 1] + 2 * accel * length[i]);
  for (let i = 0; i < n; i++) v2[i + 1] = Math.min(v2[i + 1], v2[i] + 2 * accel * length[i]);
  let k = 0;
  let clock = 0;
  let along = 0;
  const put = (i: number, from: number, w0: number, w1: number, d: number): void => {
    const t = (2 * d) / (w0 + w1);
    const a = (w1 - w0) / t;
    durationS[k] = t;
    bx[k] = x[i] + ux[i] * from;
    by[k] = y[i] + uy[i] * from;
    vx[k] = ux[i] * w0;
    vy[k] = uy[i] * w0;
    ax[k] = ux[i] * a;
    ay[k] = uy[i] * a;
    startS[k] = clock;
    alongMm[k] = along + from;
    clock += t;
    k++;
  };
  for (let i = 0; i < n; i++) {
    const l = length[i];
    const w0 = Math.sqrt(v2[i]);
    const w1 = Math.sqrt(v2[i + 1]);
    const peak2 = Math.min(max2, (v2[i] + v2[i + 1]) / 2 + accel * l);
    const peak = Math.sqrt(peak2);
    const rise = (peak2 - v2[i]) / (2 * accel);
    const fall = (peak2 - v2[i + 1]) / (2 * accel);
    const cruise = l - rise - fall;
    if (rise > 1e-9) put(i, 0, w0, peak, rise);
    if (cruise > 1e-9) put(i, rise, peak, peak, cruise);
    if (fall > 1e-9) put(i, l - fall, peak, w1, fall);
    along += l;
  }
  floor.count = k;
}

/** The same, without a function for each block. */
function tightLoop(floor: Floor): void {
  const { segments: n, x, y, ux, uy, length, limit2, v2, columns } = floor;
  const [durationS, bx, by, vx, vy, ax, ay, startS, alongMm] = columns;
  const { accelMmPerS2: accel, speedMmPerS: speed } = DEFAULT_MOTION.draw;
  const max2 = speed * speed;
  v2[n] = 0;
  for (let i = n - 1; i >= 0; i--) v2[i] = Math.min(limit2[i], v2[i + 1] + 2 * accel * length[i]);
  for (let i = 0; i < n; i++) v2[i + 1] = Math.min(v2[i + 1], v2[i] + 2 * accel * length[i]);
  let k = 0;
  let clock = 0;
  let along = 0;
  for (let i = 0; i < n; i++) {
    const l = length[i];
    const v0 = Math.sqrt(v2[i]);
    const v1 = Math.sqrt(v2[i + 1]);
    const peak2 = Math.min(max2, (v2[i] + v2[i + 1]) / 2 + accel * l);
    const peak = Math.sqrt(peak2);
    const rise = (peak2 - v2[i]) / (2 * accel);
    const fall = (peak2 - v2[i + 1]) / (2 * accel);
    const cruise = l - rise - fall;
    for (let phase = 0; phase < 3; phase++) {
      const d = phase === 0 ? rise : phase === 1 ? cruise : fall;
      if (d <= 1e-9) continue;
      const from = phase === 0 ? 0 : phase === 1 ? rise : l - fall;
      const w0 = phase === 0 ? v0 : peak;
      const w1 = phase === 2 ? v1 : peak;
      const t = (2 * d) / (w0 + w1);
      const a = (w1 - w0) / t;
      durationS[k] = t;
      bx[k] = x[i] + ux[i] * from;
      by[k] = y[i] + uy[i] * from;
      vx[k] = ux[i] * w0;
      vy[k] = uy[i] * w0;
      ax[k] = ux[i] * a;
      ay[k] = uy[i] * a;
      startS[k] = clock;
      alongMm[k] = along + from;
      clock += t;
      k++;
    }
    along += l;
  }
  floor.count = k;
}
