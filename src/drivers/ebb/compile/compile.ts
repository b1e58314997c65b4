/**
 * Trajectory to EBB commands: the pen's moves, and between them each run of the trajectory as the firmware does it
 * best: in legs, a ramp or a parabola each (leg-runs), or in slices of constant speed (write-slices).
 *
 * The host model knows after each command where the board truly is, step and phase, and the next one is aimed from
 * there: the step counters at the end are those of the plan.
 */
import { checkProfile } from "../../../machines/check-profile.js";
import type { MachineProfile } from "../../../machines/profile.js";
import type { PenSettings } from "../../../settings/pen.js";
import { penMoveAt } from "../../../plan/pen-moves.js";
import type { PenMove, Trajectory } from "../../../plan/trajectory.js";
import { TICKS_PER_MS } from "../../../units.js";
import {
  MAX_DELAY_MS,
  penCommand,
  penMoveSetUp,
  penSetUpCommands,
  type PenWay,
} from "../protocol/commands.js";
import type { BoardState, CommandStream } from "./command-stream.js";
import { firmwareFeatures, type FirmwareFeatures } from "../protocol/firmware.js";
import type { LegWriter, MotorPlace, RunWriter } from "./leg.js";
import { LegRuns } from "./leg-runs.js";
import { RunWalk } from "./run-walk.js";
import { StreamColumns } from "./stream-columns.js";
import { SignedWriter } from "./write-signed.js";
import { SliceRuns } from "./write-slices.js";
import { SteppedWriter } from "./write-stepped.js";
import { TimedWriter } from "./write-timed.js";

export interface CompileOptions {
  readonly machine: MachineProfile;
  /** As in the board's answer to V: "2.8.1". */
  readonly firmware: string;
  readonly pen: PenSettings;
  /** Where the board stands; default: at home, as EM and CS leave it. */
  readonly start?: BoardState | undefined;
}

/**
 * Commands that play a trajectory on a board of that firmware, from pen heights to the last pen move. Motors are
 * switched on and off by `setUpCommands` and `closingCommands`, once a session.
 *
 * @throws PlotwrightError "bad-setting" for a firmware that is no version, and for a machine profile with something missing
 * @throws RangeError for a trajectory with values that are not finite
 */
export function compile(trajectory: Trajectory, options: CompileOptions): CommandStream {
  checkProfile(options.machine);
  return new Compiler(trajectory, options).run();
}

/** One command of a stream, without its end. */
export function commandLine(stream: CommandStream, index: number): string {
  if (!(index >= 0 && index < stream.count)) {
    throw new RangeError(`command ${index} of ${stream.count}: there is none`);
  }
  const bytes = stream.text.subarray(stream.textOffsets[index]!, stream.textOffsets[index + 1]! - 1);
  return String.fromCharCode(...bytes);
}

class Compiler {
  private readonly columns = new StreamColumns();
  private readonly m1: MotorPlace;
  private readonly m2: MotorPlace;
  private readonly runs: RunWriter;
  /** Where the pen was told to be, up and down. */
  private readonly heights: { up: number; down: number };
  /** The set-up lines that the board has, by "SC,number". */
  private readonly parameters = new Map<string, string>();

  constructor(
    private readonly trajectory: Trajectory,
    private readonly options: CompileOptions,
  ) {
    const start = options.start ?? { steps1: 0, steps2: 0, acc1: 0, acc2: 0 };
    this.m1 = { steps: start.steps1, acc: start.acc1 };
    this.m2 = { steps: start.steps2, acc: start.acc2 };
    const features = firmwareFeatures(options.firmware);
    const walk = new RunWalk(trajectory, options.machine);
    this.runs = runWriterFor(features, trajectory, walk, this.columns, this.m1, this.m2);
    this.heights = { up: options.pen.upPct, down: options.pen.downPct };
  }

  run(): CommandStream {
    const { trajectory } = this;
    const { penMoves, runs } = trajectory;
    if (!Number.isFinite(trajectory.totalS)) throw new RangeError("the trajectory's time is not finite");
    if (penMoves.count > 0) this.setUpPen();
    let next = 0;
    for (let r = 0; r <= runs.count; r++) {
      while (next < penMoves.count && penMoves.beforeRun[next]! <= r)
        this.penMove(penMoveAt(penMoves, next++));
      if (r < runs.count) this.runs.write(r);
    }
    return this.columns.finish(trajectory.totalS);
  }

  private setUpPen(): void {
    this.setUp(penSetUpCommands(this.options.machine, this.options.pen), 0);
  }

  /** The pen's move, with its height and speed where they are others than before. */
  private penMove(move: PenMove): void {
    const { machine, pen } = this.options;
    const { heights } = this;
    const wayPct = Math.abs(move.heightPct - (move.up ? heights.down : heights.up));
    if (move.up) heights.up = move.heightPct;
    else heights.down = move.heightPct;
    const wholeS = move.up ? (move.waitS * 100) / (pen.clearPct ?? 100) : move.waitS;
    const way: PenWay = {
      up: move.up,
      heightPct: move.heightPct,
      wayPct,
      timeMs: 1_000 * wholeS,
      ratePctPerS: move.up ? pen.liftPctPerS : pen.dropPctPerS,
    };
    this.setUp(penMoveSetUp(machine, way), move.startS);
    const waitMs = Math.min(MAX_DELAY_MS, Math.round(move.waitS * 1_000));
    this.still(penCommand(machine, way, waitMs), Math.max(1, waitMs * TICKS_PER_MS), move.startS);
  }

  /** Writes the set-up lines that the board does not have yet. */
  private setUp(lines: readonly string[], planS: number): void {
    for (const line of lines) {
      const parameter = line.slice(0, line.lastIndexOf(","));
      if (this.parameters.get(parameter) === line) continue;
      this.parameters.set(parameter, line);
      this.still(line, 0, planS);
    }
  }

  /** A command in which the motors rest. */
  private still(line: string, ticks: number, planS: number): void {
    const { columns, m1, m2 } = this;
    columns.text.line(line);
    columns.add(ticks, planS, -1, m1.steps, m2.steps, m1.acc, m2.acc);
  }
}

function runWriterFor(
  features: FirmwareFeatures,
  trajectory: Trajectory,
  walk: RunWalk,
  columns: StreamColumns,
  m1: MotorPlace,
  m2: MotorPlace,
): RunWriter {
  const legs = (writer: LegWriter): RunWriter => new LegRuns(trajectory, walk, writer, columns, m1, m2);
  switch (features.motion) {
    case "jerk":
      return legs(new SignedWriter(columns.text, features));
    case "timed":
      return legs(new TimedWriter(columns.text));
    case "steps":
      return legs(new SteppedWriter(columns.text, features));
    case "slices":
      return new SliceRuns(features, walk, columns, m1, m2);
  }
}
