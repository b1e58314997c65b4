/**
 * The programs for EBB plotters with their own default settings: how long a whole plot takes with each, pen moves included.
 *
 * The figures are those of the programs' sources: saxi 0.17.1, AxiDraw software 3.9.7, NextDraw software 1.x.
 */
import {
  DEFAULT_MOTION,
  DEFAULT_PEN,
  DEFAULT_PREPARE,
  plan,
  prepare,
  type Drawing,
  type MachineProfile,
  type MotionSettings,
  type StrokeSet,
  type Trajectory,
} from "../../../src/index.js";
import {
  BRUSHLESS_LIFT,
  hasBrushlessLift,
  servoTime,
  STANDARD_SERVO,
} from "../../../src/machines/pen-servo.js";
import { referenceRuns } from "./motion.js";
import { NEXTDRAW } from "./nextdraw.js";
import type { ReferencePlanner } from "./polyline.js";
import { AXI, AXIDRAW } from "./systems.js";

const INCH = 25.4;
/** The speed limit of AxiDraw's and NextDraw's software at 1/16 steps, mm/s. */
const TOP_SPEED = 8.6979 * INCH;
/** Their default acceleration, as a share of the highest. */
const ACCEL_SHARE = 0.75;

interface Program {
  readonly name: string;
  readonly planner: ReferencePlanner;
  readonly draw: Partial<MotionSettings["draw"]>;
  readonly travel: Partial<MotionSettings["travel"]>;
  /** Gaps up to this length are drawn, without lifting the pen. */
  readonly joinMm: number;
  /** The waits for one lift and one drop, s; null if the program does not drive this machine. */
  readonly penS: (machine: MachineProfile) => number | null;
}

/** A lift and a drop by the formula of AxiDraw's and NextDraw's software, in percent of its range, at its default rates. */
function makersPenS(machine: MachineProfile, heightPct: number): number {
  const servo = hasBrushlessLift(machine) ? BRUSHLESS_LIFT : STANDARD_SERVO;
  return servoTime(servo, heightPct, servo.liftPctPerS) + servoTime(servo, heightPct, servo.dropPctPerS);
}

const PROGRAMS: readonly Program[] = [
  {
    name: "saxi",
    planner: AXI,
    draw: { speedMmPerS: 50, accelMmPerS2: 200, cornerMm: 0.127 },
    travel: { speedMmPerS: 200, accelMmPerS2: 400 },
    joinMm: 0.5,
    penS: (machine) => 2 * (hasBrushlessLift(machine) ? 0.08 : 0.12),
  },
  {
    name: "AxiDraw software",
    planner: AXIDRAW,
    draw: {
      speedMmPerS: (25 / 110) * TOP_SPEED,
      accelMmPerS2: ACCEL_SHARE * 40 * INCH,
      cornerMm: 0.002 * INCH,
    },
    travel: { speedMmPerS: (75 / 110) * TOP_SPEED, accelMmPerS2: ACCEL_SHARE * 60 * INCH },
    joinMm: 0.008 * INCH,
    penS: (machine) => (hasBrushlessLift(machine) ? null : makersPenS(machine, 30)),
  },
  {
    // Its setting of acceleration acts on the jerk, by its cube.
    name: "NextDraw software",
    planner: NEXTDRAW,
    draw: { speedMmPerS: 0.25 * TOP_SPEED, jerkMmPerS3: ACCEL_SHARE ** 3 * 20_000 * INCH },
    travel: { speedMmPerS: 0.75 * TOP_SPEED, jerkMmPerS3: ACCEL_SHARE ** 3 * 19_000 * INCH },
    joinMm: 0.006 * INCH,
    penS: (machine) => makersPenS(machine, 20),
  },
];

/** One program's plot of one drawing. */
export interface WholePlot {
  readonly program: string;
  readonly totalS: number;
  /** How much of it the carriage waits for the pen. */
  readonly penS: number;
  readonly strokes: StrokeSet;
  /** Its pen moves may take other times than `penS`. */
  readonly trajectory: Trajectory;
}

/** The plots of the other programs that drive this machine, with the strokes in plotwright's order. */
export function othersPlots(drawing: Drawing, machine: MachineProfile): WholePlot[] {
  return PROGRAMS.flatMap(({ name, planner, draw, travel, joinMm, penS: penMovesS }) => {
    const penMoveS = penMovesS(machine);
    if (penMoveS === null) return [];
    const { strokes } = prepare(drawing, { ...DEFAULT_PREPARE, fit: false, joinMm });
    const motion: MotionSettings = {
      ...DEFAULT_MOTION,
      // Its columns have a jerk, which the S-curves need.
      mode: "scurve",
      draw: { ...DEFAULT_MOTION.draw, ...draw },
      travel: { ...DEFAULT_MOTION.travel, ...travel },
    };
    const trajectory = plan(
      strokes,
      motion,
      { ...DEFAULT_PEN, overlap: "off" },
      { machine, runs: referenceRuns(planner) },
    );
    const penS = (strokes.offsets.length - 1) * penMoveS;
    return [{ program: name, totalS: movingS(trajectory) + penS, penS, strokes, trajectory }];
  });
}

/** Plotwright's own plot. `motion` left out: the default settings. */
export function ownPlot(
  program: string,
  drawing: Drawing,
  machine: MachineProfile,
  motion: MotionSettings = DEFAULT_MOTION,
): WholePlot {
  const { strokes } = prepare(drawing, { ...DEFAULT_PREPARE, fit: false });
  const trajectory = plan(strokes, motion, DEFAULT_PEN, { machine });
  const { totalS } = trajectory;
  return { program, totalS, penS: totalS - movingS(trajectory), strokes, trajectory };
}

const movingS = ({ durationS, blockCount }: Trajectory): number =>
  durationS.subarray(0, blockCount).reduce((sum, s) => sum + s, 0);
