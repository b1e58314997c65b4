/**
 * Makes a job for a Grbl controller from strokes: a model of the motion that Grbl's planner produces, and the lines to send.
 */
import { strokeCount, type StrokeSet } from "../../drawing/stroke-set.js";
import type { MachineProfile } from "../../machines/profile.js";
import { penMovesOf } from "../../plan/pen/pen-moves.js";
import { plan } from "../../plan/plan.js";
import { runEndS, type StrokePosition, type Trajectory } from "../../plan/trajectory.js";
import { strokeLengthMm } from "../../position/on-drawing.js";
import { NO_PENS, type PenSetup } from "../../prepare/layers/pens.js";
import type { PenSettings } from "../../settings/pen.js";
import type { DriverPlanOptions, JobSettings, MachineCommands, MachineJob } from "../machine-job.js";
import { fileLines } from "./grbl-file.js";
import { ARC_TOLERANCE_MM, isArcTrue } from "./model/arc-cut.js";
import { takesArcs } from "./model/firmware.js";
import { axisLimits, dwellS, grblOf } from "./model/grbl-controller.js";
import { GrblRuns, type SentMove } from "./model/grbl-runs.js";
import { number, penLiftOf, waitLine, type PenLift } from "./model/pen-lift.js";
import { QUEUE_MOVES, type Axes, type GrblAxisLimits } from "./model/planner.js";

/** Lines of G-code. The reply to the last one comes when everything is done. */
export interface GrblCommands extends MachineCommands {
  readonly lines: readonly string[];
  /** How many moves in the Grbl's queue each line becomes. */
  readonly moveCounts: readonly number[];
  /** The first stroke of the layer that begins at a line, by the line's index. */
  readonly strokeAt: ReadonlyMap<number, number>;
}

/** Narrows a job's commands to the type of this driver. Throws TypeError for those of another driver. */
export function grblCommandsOf(commands: MachineCommands): GrblCommands {
  if (!("lines" in commands)) throw new TypeError("these commands are for another controller");
  return commands as GrblCommands;
}

/** The state of a connected Grbl (`MachineState`). */
export interface GrblState {
  /** Its position, mm from home. */
  readonly at: Axes;
  /** Home in the Grbl's work coordinates, which belong to the user; Z: where the profile's Z is 0. */
  readonly zero: Axes;
  /** Its own limits. */
  readonly limits: GrblAxisLimits;
  readonly queueMoves: number;
  /** How far its moves may be from an arc. */
  readonly arcToleranceMm: number;
}

/** The reply comes when everything before it is done. */
export const SYNC = "G4P0";

export function planGrblJob(
  strokes: StrokeSet,
  { motion, pen, ...penSetup }: JobSettings & Partial<PenSetup>,
  machine: MachineProfile,
  options: DriverPlanOptions,
): MachineJob<GrblCommands> {
  const grbl = grblOf(machine);
  const {
    limits = axisLimits(grbl),
    zero = [0, 0, 0],
    queueMoves = QUEUE_MOVES,
    arcToleranceMm = ARC_TOLERANCE_MM,
  } = (options.board ?? {}) as Partial<GrblState>;
  const lift = penLiftOf(machine, limits, zero[2]);
  const drawsArcs = grbl.arcs === true && takesArcs(options.firmware ?? null) && isArcTrue(arcToleranceMm);
  const runs = new GrblRuns(machine, limits, queueMoves, drawsArcs ? arcToleranceMm : null);
  const trajectory = plan(strokes, { ...motion, mode: "junction", shaper: "none" }, penAtRest(pen), {
    servo: lift.servo,
    from: options.from ? undrawn(strokes, options.from, 1 / machine.stepsPerMm) : undefined,
    startX: options.startXMm,
    startY: options.startYMm,
    endX: options.endXMm,
    endY: options.endYMm,
    penOffsetMm: 2 / machine.stepsPerMm,
    liftFirst: options.liftFirst,
    cancel: options.cancel,
    runs,
    penS: (fromPct, toPct, waitS) => penS(lift, fromPct, toPct, waitS),
  });
  let written: GrblCommands | null = null;
  const commands = (): GrblCommands =>
    (written ??= writeCommands(strokes, trajectory, runs.runs, lift, zero, {
      heightPct: pen.upPct,
      isUp: !options.liftFirst,
      downPct: pen.downPct,
    }));
  const lines = (): string[] => {
    const travelMmPerS = Math.min(motion.travel.speedMmPerS, limits.speed[0], limits.speed[1]);
    return fileLines(commands(), {
      strokes,
      machine,
      pen,
      penSetup: { ...NO_PENS, ...penSetup },
      travelMmPerS,
      totalS: trajectory.totalS,
    });
  };
  return { trajectory, commands, lines };
}

/** A rest of a stroke that is shorter than a step has no moves, and would count as a dot. */
const undrawn = (strokes: StrokeSet, from: StrokePosition, stepMm: number): StrokePosition =>
  from.alongMm > 0 &&
  from.stroke < strokeCount(strokes) &&
  strokeLengthMm(strokes, from.stroke) - from.alongMm < stepMm
    ? { stroke: from.stroke + 1, alongMm: 0 }
    : from;

/** How long the carriage stands for a pen move; from a height to the same one it only waits. */
const penS = (lift: PenLift, fromPct: number, toPct: number, waitS: number): number =>
  fromPct === toPct ? dwellS(waitS) : lift.moveS(fromPct, toPct) + lift.waitS(waitS);

/** Grbl moves the pen only at rest, and a servo's signal at once. */
const penAtRest = (pen: PenSettings): PenSettings => ({
  ...pen,
  overlap: "off",
  liftPctPerS: null,
  dropPctPerS: null,
});

/** The pen when a job begins. */
interface PenAtStart {
  readonly heightPct: number;
  /** False: it may be at `downPct`. */
  readonly isUp: boolean;
  readonly downPct: number;
}

function writeCommands(
  strokes: StrokeSet,
  trajectory: Trajectory,
  runs: readonly (readonly SentMove[])[],
  lift: PenLift,
  zero: Axes,
  start: PenAtStart,
): GrblCommands {
  const lines: string[] = [];
  const planS: number[] = [];
  const moveCounts: number[] = [];
  const add = (line: string, atS: number, moveCount = 1): void => {
    lines.push(line);
    planS.push(atS);
    moveCounts.push(moveCount);
  };
  const penMoves = penMovesOf(trajectory);
  const strokeAt = new Map<number, number>();
  let layer = -1;
  let { isUp } = start;
  let pct = isUp ? start.heightPct : start.downPct;
  let next = 0;
  /** The travel to the first stroke of a layer, and the drop, belong to the layer. */
  const begin = (run: number): void => {
    const isTravel = (trajectory.runs.stroke[run] ?? -1) < 0;
    const stroke = trajectory.runs.stroke[isTravel ? run + 1 : run] ?? -1;
    if (stroke < 0 || strokes.layer[stroke] === layer) return;
    layer = strokes.layer[stroke];
    strokeAt.set(lines.length, stroke);
  };
  for (let run = 0; run <= runs.length; run++) {
    for (; next < penMoves.length && penMoves[next].beforeRun === run; next++) {
      const { up, startS, waitS, heightPct } = penMoves[next];
      if (!up) begin(run);
      const moveS = lift.moveS(pct, heightPct);
      const isMove = up !== isUp || heightPct !== pct;
      if (isMove) for (const line of lift.lines(up, heightPct)) add(line, startS);
      add(waitLine(waitS - moveS), startS + moveS);
      [isUp, pct] = [up, heightPct];
    }
    begin(run);
    let feed = 0;
    const moves = runs[run] ?? [];
    for (const move of moves) {
      const [x, y] = [move.x + zero[0], move.y + zero[1]];
      const to = `X${number(x)}Y${number(y)}`;
      const feedWord = move.feed === feed ? "" : `F${number(move.feed)}`;
      add(`${motionWord(move)}${to}${centreWords(move)}${feedWord}`, move.startS, move.moveCount);
      feed = move.feed;
    }
    // Wait for rest, as planned: otherwise Grbl's planner would continue into the next run without a stop.
    if (moves.length > 0) add(SYNC, runEndS(trajectory, run));
  }
  if (lines.length === 0) add(SYNC, 0);
  return {
    count: lines.length,
    planS: Float64Array.from([...planS, trajectory.totalS]),
    warnings: [],
    lines,
    moveCounts,
    strokeAt,
  };
}

const motionWord = ({ arc }: SentMove): string => (!arc ? "G1" : arc.clockwise ? "G2" : "G3");

const centreWords = ({ arc }: SentMove): string => (arc ? `I${number(arc.i)}J${number(arc.j)}` : "");
