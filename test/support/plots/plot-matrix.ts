/**
 * The samples, plotted by every firmware in every mode on virtual boards: the board's acceptance figures, and
 * the table of docs/ebb.md.
 */
import { DEFAULT_MOTION, DEFAULT_PEN, machineById, plan, type StrokeSet } from "../../../src/index.js";
import { compareFirmware, motionForFirmware, type MotionMode } from "../../../src/internal.js";
import { sampleStrokes } from "../drawings/sample-strokes.js";
import { SegmentGrid } from "../drawings/segment-grid.js";
import { FastBoard } from "./virtual-plots.js";

export const SAMPLES = [
  "flower-meadow",
  "harmonograph",
  "hello-paper",
  "moonrise",
  "three-colour-hills",
  "whirling-triangles",
] as const;
export const FIRMWARE = ["2.4.4", "2.5.3", "2.6.5", "2.7.0", "2.8.1", "3.0.3", "3.1.7"] as const;
export const MODES = ["junction", "blend", "scurve"] as const;
export type Sample = (typeof SAMPLES)[number];
type Firmware = (typeof FIRMWARE)[number];

const MICROSTEP_MM = 0.0125;
/** δ + ε + one microstep. */
export const ALLOWED_MM = DEFAULT_MOTION.draw.cornerMm + DEFAULT_MOTION.fit!.toleranceMm + MICROSTEP_MM;

/** Max change of speed between two commands, mm/s; null: the plan's own jumps at the corners of the mode. */
export function allowedJump(mode: MotionMode, firmware: Firmware): number | null {
  if (mode === "junction") return null;
  // Slices of constant speed: not guaranteed, but within reason.
  if (compareFirmware(firmware, "2.5.3") < 0) return 10;
  return compareFirmware(firmware, "2.7.0") < 0 ? 5 : 1;
}

export interface MatrixRow {
  readonly sample: Sample;
  readonly firmware: Firmware;
  readonly mode: MotionMode;
  readonly commands: number;
  readonly planS: number;
  /** The first command, over all plots, whose counters differ from the prediction. */
  readonly firstWrong: string | null;
  /** The board's position after the last plot, steps. */
  readonly endSteps: readonly [number, number];
  readonly errors: readonly string[];
  /** |board time / plan time − 1|, the worst of the plots. */
  readonly timeShare: number;
  /** Max mm from the drawn line to the drawing, and from points of the drawing to the drawn line. */
  readonly offMm: number;
  readonly missedMm: number;
  readonly jumpMmPerS: number;
  /** Seconds that one motor waited for the other within a command. */
  readonly motorWaitS: number;
}

const MACHINE = machineById("axidraw-v3");
const strokesOf = remembered(async (sample: Sample): Promise<{ strokes: StrokeSet; grid: SegmentGrid }> => {
  const strokes = await sampleStrokes(sample);
  const grid = new SegmentGrid(0.5);
  for (let i = 0; i + 1 < strokes.offsets.length; i++) {
    grid.addPolyline(strokes.xy, 2 * strokes.offsets[i], 2 * strokes.offsets[i + 1]);
  }
  return { strokes, grid };
});

/** Plots a sample that many times in a row, without homing in between. */
export async function plotOften(
  sample: Sample,
  firmware: Firmware,
  mode: MotionMode,
  plots: number,
  /** Default: as the firmware is known to have. */
  idleTicksTimed?: number,
): Promise<MatrixRow> {
  const { strokes, grid } = await strokesOf(sample);
  const motion = motionForFirmware({ ...DEFAULT_MOTION, mode }, firmware);
  const trajectory = plan(strokes, motion, DEFAULT_PEN, { machine: MACHINE });
  const fast = new FastBoard(
    firmware,
    MACHINE,
    DEFAULT_PEN,
    idleTicksTimed === undefined ? {} : { idleTicksTimed },
  );
  let firstWrong: string | null = null;
  let timeShare = 0;
  let commands = 0;
  let lineCount = 0;
  for (let i = 0; i < plots; i++) {
    const stream = fast.compile(trajectory);
    const played = fast.play(stream);
    commands = stream.count;
    firstWrong ??= played.firstWrong;
    timeShare = Math.max(timeShare, Math.abs(played.boardS / trajectory.totalS - 1));
    if (i === 0) lineCount = fast.board.drawn().length;
  }
  const { steps1, steps2 } = fast.board.state();
  const statistics = fast.board.statistics();
  return {
    ...distances(fast, strokes, grid, lineCount),
    ...{ sample, firmware, mode, commands, firstWrong, timeShare },
    planS: trajectory.totalS,
    endSteps: [steps1, steps2],
    errors: fast.errors,
    jumpMmPerS: statistics.largestJumpMmPerS,
    motorWaitS: statistics.longestMotorWaitS,
  };
}

/**
 * Compares everything drawn with the drawing, but the drawing only with its first plot, so that later plots
 * do not hide a gap.
 */
function distances(
  fast: FastBoard,
  strokes: StrokeSet,
  grid: SegmentGrid,
  firstPlotLines: number,
): { offMm: number; missedMm: number } {
  const drawn = new SegmentGrid(0.5);
  let offMm = 0;
  fast.board.drawn().forEach(({ penDown, xy }, index) => {
    if (!penDown) return;
    if (index < firstPlotLines) drawn.addPolyline(xy);
    for (let i = 0; i < xy.length; i += 2) offMm = Math.max(offMm, grid.distance(xy[i], xy[i + 1], offMm));
  });
  let missedMm = 0;
  for (let i = 0; i < strokes.xy.length; i += 2) {
    missedMm = Math.max(missedMm, drawn.distance(strokes.xy[i], strokes.xy[i + 1], missedMm));
  }
  return { offMm, missedMm };
}

function remembered<K, V>(make: (key: K) => V): (key: K) => V {
  const made = new Map<K, V>();
  return (key) => {
    if (!made.has(key)) made.set(key, make(key));
    return made.get(key)!;
  };
}

/** The worst of the samples, one line for each firmware and mode, as in docs/ebb.md. */
export function worstTable(rows: readonly MatrixRow[]): string {
  const lines = ["| firmware | mode | off the drawing, mm | jump, mm/s | time, % | motors apart, µs |"];
  lines.push("| --- | --- | ---: | ---: | ---: | ---: |");
  for (const firmware of FIRMWARE) {
    for (const mode of MODES) {
      const some = rows.filter((row) => row.firmware === firmware && row.mode === mode);
      if (some.length === 0) continue;
      const worst = (of: (row: MatrixRow) => number): number => Math.max(...some.map(of));
      const cells = [
        ...[firmware, mode, worst((row) => Math.max(row.offMm, row.missedMm)).toFixed(3)],
        ...[worst((row) => row.jumpMmPerS).toFixed(2), (100 * worst((row) => row.timeShare)).toFixed(3)],
        (1e6 * worst((row) => row.motorWaitS)).toFixed(0),
      ];
      lines.push(`| ${cells.join(" | ")} |`);
    }
  }
  return lines.join("\n");
}
