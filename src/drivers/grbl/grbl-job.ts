/**
 * Makes a job for a Grbl controller from strokes: a model of the motion that Grbl's planner produces, and the lines to send.
 */
import type { StrokeSet } from "../../drawing/stroke-set.js";
import type { MachineProfile, PenServo } from "../../machines/profile.js";
import { penMovesOf } from "../../plan/pen/pen-moves.js";
import { plan } from "../../plan/plan.js";
import { runEndS, type Trajectory } from "../../plan/trajectory.js";
import type { PenSettings } from "../../settings/pen.js";
import type { DriverPlanOptions, JobSettings, MachineCommands, MachineJob } from "../machine-job.js";
import { dwellS, grblOf, type GrblController } from "./model/grbl-controller.js";
import { GrblRuns, type SentMove } from "./model/grbl-runs.js";
import { moveTimeS } from "./model/planner.js";

/** Lines of G-code. The reply to the last one comes when everything is done. */
export interface GrblCommands extends MachineCommands {
  readonly lines: readonly string[];
}

/** Narrows a job's commands to the type of this driver. Throws TypeError for those of another driver. */
export function grblCommandsOf(commands: MachineCommands): GrblCommands {
  if (!("lines" in commands)) throw new TypeError("these commands are for another controller");
  return commands as GrblCommands;
}

/** mm, absolute coordinates, mm/min. Sent again after a reset, which may change these modes. */
export const MODES = "G21G90G94";
/** The reply comes when everything before it is done. */
export const SYNC = "G4P0";

export function planGrblJob(
  strokes: StrokeSet,
  { motion, pen }: JobSettings,
  machine: MachineProfile,
  options: DriverPlanOptions,
): MachineJob<GrblCommands> {
  const grbl = grblOf(machine);
  const runs = new GrblRuns(machine, grbl);
  const trajectory = plan(strokes, { ...motion, mode: "junction", shaper: "none" }, penAtRest(pen), {
    servo: zAxisAsServo(grbl),
    from: options.from ?? undefined,
    startX: options.startXMm,
    startY: options.startYMm,
    endX: options.endXMm,
    endY: options.endYMm,
    penOffsetMm: 2 / machine.stepsPerMm,
    liftFirst: options.liftFirst,
    cancel: options.cancel,
    runs,
  });
  let written: GrblCommands | null = null;
  const commands = (): GrblCommands =>
    (written ??= writeCommands(trajectory, runs.runs, grbl, options.liftFirst ?? false));
  return { trajectory, commands, lines: () => [MODES, ...commands().lines] };
}

/** Grbl moves the pen only at rest, and waits for whole dwells. */
function penAtRest({ upPct, downPct, layers = {}, contactPct, fullHeightMm }: PenSettings): PenSettings {
  const waits = Object.entries(layers).map(([id, { beforeMs }]) => {
    return [id, beforeMs ? { beforeMs: 1_000 * dwellS(beforeMs / 1_000) } : {}] as const;
  });
  const heights = { upPct, downPct, overlap: "off", contactPct, fullHeightMm } as const;
  return { ...heights, extraLiftMs: 0, extraDropMs: 0, layers: Object.fromEntries(waits) };
}

/** The Z axis as a servo: it always moves between the profile's two heights. */
function zAxisAsServo(grbl: GrblController): PenServo {
  const minMs = 1_000 * (penTimeS(grbl) + dwellS(grbl.penWaitMs / 1_000));
  return { minMs, slopeMsPerPct: 0, liftPctPerS: Infinity, dropPctPerS: Infinity, frameMs: 0 };
}

/** Duration of the move of the Z axis. */
const penTimeS = ({ penUpZMm, penDownZMm, penSpeedMmPerS, penAccelMmPerS2 }: GrblController): number =>
  moveTimeS(Math.abs(penUpZMm - penDownZMm), penSpeedMmPerS, penAccelMmPerS2);

/** The move to a height, and the wait after it. */
export const penLines = (grbl: GrblController, zMm: number): [move: string, wait: string] => [
  `G1Z${number(zMm)}F${number(60 * grbl.penSpeedMmPerS)}`,
  wait(grbl.penWaitMs / 1_000),
];

const wait = (seconds: number): string => `G4P${number(dwellS(seconds))}`;

/** At most three decimals. */
const number = (value: number): string => String(Number(value.toFixed(3)));

function writeCommands(
  trajectory: Trajectory,
  runs: readonly (readonly SentMove[])[],
  grbl: GrblController,
  liftFirst: boolean,
): GrblCommands {
  const lines: string[] = [];
  const planS: number[] = [];
  const add = (line: string, atS: number): void => {
    lines.push(line);
    planS.push(atS);
  };
  const penMoves = penMovesOf(trajectory);
  let isUp: boolean | null = liftFirst ? null : true;
  let next = 0;
  for (let run = 0; run <= runs.length; run++) {
    for (; next < penMoves.length && penMoves[next].beforeRun === run; next++) {
      const { up, startS, waitS } = penMoves[next];
      if (up && isUp) add(wait(waitS), startS);
      else {
        const [move, settle] = penLines(grbl, up ? grbl.penUpZMm : grbl.penDownZMm);
        add(move, startS);
        add(settle, startS + penTimeS(grbl));
      }
      isUp = up;
    }
    let feed = 0;
    const moves = runs[run] ?? [];
    for (const move of moves) {
      const { x, y, startS } = move;
      add(`G1X${number(x)}Y${number(y)}${move.feed === feed ? "" : `F${number(move.feed)}`}`, startS);
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
  };
}
