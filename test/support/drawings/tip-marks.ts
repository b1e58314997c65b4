/**
 * The line that a pen draws, according to a simulated servo. The servo gets only the pen commands and their times, not
 * the planner's assumptions. Below a given height the tip touches the paper, wherever the carriage is.
 */
import { commandLine } from "../../../src/drivers/ebb/compile/compile.js";
import type { CommandStream } from "../../../src/drivers/ebb/compile/command-stream.js";
import { pctFromServoPos } from "../../../src/drivers/ebb/protocol/servo-height.js";
import type { MachineProfile } from "../../../src/machines/profile.js";
import { stateAt, type Trajectory } from "../../../src/plan/trajectory.js";
import { dropMoveTime, liftMoveTime, timedPen, type TimedPen } from "../../../src/plan/pen/pen-times.js";
import type { PenSettings } from "../../../src/settings/pen.js";

export interface TipServo {
  /** 0.8: it needs a quarter more than the machine's servo. */
  readonly speed: number;
  /** When its frames begin, 0 … 1 frame. */
  readonly phaseMs: number;
  /** Share of the distance from down to up below which the tip touches. */
  readonly contact: number;
}

export interface TipMarks {
  /** Longest mark before a stroke's start or beyond its end, mm. */
  readonly strayMm: number;
  /** Longest part of a stroke at its start that is not drawn, mm. */
  readonly lateMm: number;
  /** Strokes that the tip left before their end. */
  readonly brokenCount: number;
}

const STEP_S = 0.001;

interface PenCommand {
  readonly atS: number;
  readonly up: boolean;
  readonly heightPct: number;
}

interface Stroke {
  readonly startS: number;
  readonly endS: number;
  readonly from: Point;
  readonly to: Point;
}
type Point = readonly [x: number, y: number];

export function tipMarks(
  trajectory: Trajectory,
  commands: CommandStream,
  machine: MachineProfile,
  pen: PenSettings,
  servo: TipServo,
): TipMarks {
  const strokes = strokesOf(trajectory);
  const tip = new Tip(penCommandsOf(commands, machine, pen), timedPen(pen, machine), servo);
  let strayMm = 0;
  let lateMm = 0;
  let index = 0;
  let next = 0;
  const begun = new Set<number>();
  const broken = new Set<number>();
  const endS = commands.boardS[commands.count];
  for (let boardS = 0; boardS < endS; boardS += STEP_S) {
    while (index + 1 < commands.count && commands.boardS[index + 1] <= boardS) index++;
    const spanS = commands.boardS[index + 1] - commands.boardS[index];
    const share = spanS > 0 ? (boardS - commands.boardS[index]) / spanS : 0;
    const planS = commands.planS[index] + share * (commands.planS[index + 1] - commands.planS[index]);
    while (next < strokes.length && strokes[next].startS <= planS) next++;
    const last = strokes[next - 1];
    const isOnStroke = last !== undefined && planS < last.endS;
    if (tip.touches(boardS) === isOnStroke) {
      if (isOnStroke) begun.add(next);
    } else if (isOnStroke) {
      if (begun.has(next)) broken.add(next);
      else lateMm = Math.max(lateMm, stateAt(trajectory, planS).alongMm);
    } else {
      const at = stateAt(trajectory, planS);
      const beyond = last ? distance([at.x, at.y], last.to) : Infinity;
      const before = strokes[next] ? distance([at.x, at.y], strokes[next].from) : Infinity;
      strayMm = Math.max(strayMm, Math.min(beyond, before));
    }
  }
  return { strayMm, lateMm, brokenCount: broken.size };
}

/** In every frame the servo gets a new target, one step further, and slews there evenly until the next frame. */
class Tip {
  private readonly contactPct: number;
  private readonly periodS: number;
  private index = -1;
  private fromPct: number;
  private toPct: number;
  /** Max change in a frame: the servo needs its time for the whole way to the target. */
  private mostPct = 0;
  /** The next frame. */
  private frame = 0;

  constructor(
    private readonly commands: readonly PenCommand[],
    private readonly pen: TimedPen,
    private readonly servo: TipServo,
  ) {
    this.periodS = pen.servo.frameMs / 1_000;
    this.contactPct = pen.downPct + servo.contact * (pen.upPct - pen.downPct);
    this.fromPct = this.toPct = pen.upPct;
  }

  /** Time must not go back. */
  touches(boardS: number): boolean {
    for (; this.frameS() <= boardS; this.frame++) this.beginFrame();
    const left = Math.min(1, (this.frameS() - boardS) / this.periodS);
    return this.toPct + left * (this.fromPct - this.toPct) < this.contactPct;
  }

  private beginFrame(): void {
    const { commands, pen, servo } = this;
    const before = this.index;
    while (this.index + 1 < commands.length && commands[this.index + 1].atS <= this.frameS()) this.index++;
    const targetPct = commands[this.index]?.heightPct ?? pen.upPct;
    if (this.index !== before) {
      const wayPct = targetPct - this.toPct;
      const wholeS = wayPct > 0 ? liftMoveTime(pen, wayPct) : dropMoveTime(pen, wayPct);
      this.mostPct = wholeS > 0 ? (Math.abs(wayPct) * servo.speed * this.periodS) / wholeS : 0;
    }
    const distancePct = targetPct - this.toPct;
    this.fromPct = this.toPct;
    this.toPct += Math.max(-this.mostPct, Math.min(this.mostPct, distancePct));
  }

  private frameS(): number {
    return this.servo.phaseMs / 1_000 + this.frame * this.periodS;
  }
}

function strokesOf(trajectory: Trajectory): Stroke[] {
  const { runs, x, y, startS, durationS, endX, endY } = trajectory;
  const strokes: Stroke[] = [];
  for (let run = 0; run < runs.count; run++) {
    if (runs.stroke[run] < 0) continue;
    const [first, end] = [runs.firstBlock[run], runs.firstBlock[run + 1]];
    const from: Point = first < trajectory.blockCount ? [x[first], y[first]] : [endX, endY];
    const to: Point = end < trajectory.blockCount ? [x[end], y[end]] : [endX, endY];
    const lastS = end > first ? startS[end - 1] + durationS[end - 1] : runs.startS[run];
    strokes.push({ startS: runs.startS[run], endS: lastS, from, to });
  }
  return strokes;
}

function penCommandsOf(commands: CommandStream, machine: MachineProfile, pen: PenSettings): PenCommand[] {
  const found: PenCommand[] = [];
  let [upPct, downPct] = [pen.upPct, pen.downPct];
  for (let i = 0; i < commands.count; i++) {
    const [name, first, second] = commandLine(commands, i).split(",");
    if (name === "SC" && first === "4") upPct = pctFromServoPos(machine, Number(second));
    if (name === "SC" && first === "5") downPct = pctFromServoPos(machine, Number(second));
    if (name === "S2") {
      const heightPct = pctFromServoPos(machine, Number(first));
      found.push({ atS: commands.boardS[i], up: heightPct > pen.downPct, heightPct });
    }
    if (name !== "SP") continue;
    const up = first === "1";
    found.push({ atS: commands.boardS[i], up, heightPct: up ? upPct : downPct });
  }
  return found;
}

const distance = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
