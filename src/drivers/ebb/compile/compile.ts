/**
 * Compiles a trajectory to EBB commands: pen moves, and between them the runs. How a run is written depends on the
 * firmware: as legs with one ramp or parabola each (leg-runs.ts), or as slices of constant speed (write-slices.ts).
 *
 * A model of the firmware predicts the exact board state (steps and accumulators) after each command, and the next
 * command is computed from that state. So rounding never adds up, and the final step counters equal the plan's.
 */
import { checkObject } from "../../../check-arguments.js";
import { firstWhere } from "../../../geometry/binary-search.js";
import type { MachineProfile } from "../../../machines/profile.js";
import type { PenSettings } from "../../../settings/pen.js";
import { checkPen } from "../../../plan/check-settings.js";
import { penMoveAt } from "../../../plan/pen/pen-moves.js";
import { runEndS, SAME_TIME_S, type PenMove, type Trajectory } from "../../../plan/trajectory.js";
import { S_PER_TICK, TICKS_PER_MS } from "../../../units.js";
import {
  MAX_DELAY_MS,
  penCommand,
  penMoveOf,
  penMoveSetUp,
  penSetUpCommands,
  type ServoMove,
} from "../protocol/commands.js";
import { AT_HOME, type BoardState, type CommandStream } from "./command-stream.js";
import { checkEbbProfile } from "../protocol/ebb-controller.js";
import { firmwareFeatures, newerFirmwareNote } from "../protocol/firmware.js";
import type { LegWriter, RunCommandWriter } from "./leg.js";
import { LegRuns } from "./leg-runs.js";
import { RunWalk } from "./run-walk.js";
import { StreamColumns } from "./stream-columns.js";
import { SignedWriter } from "./write-signed.js";
import { SliceRuns } from "./write-slices.js";
import { SteppedWriter } from "./write-stepped.js";
import { TimedWriter } from "./write-timed.js";

/** The board that `compile` writes commands for. */
export interface CompileOptions {
  /** A machine with an EiBotBoard. */
  readonly machine: MachineProfile;
  /** As in the board's reply to V: "2.8.1". */
  readonly firmware: string;
  /** Heights and speeds of the pen. */
  readonly pen: PenSettings;
  /** State of the board at the start; default: at home, all zero, as after EM and CS. */
  readonly start?: BoardState | undefined;
  /**
   * The board has performed the trajectory up to this time, s; `start` is its state then. Only the commands after it are
   * written, without the set-up at the beginning.
   *
   * @internal
   */
  readonly fromS?: number | undefined;
  /**
   * With `fromS` during a run: how many pen moves that begin by then are not written yet. A pen move is written after the
   * command during which it begins. Default 0.
   *
   * @internal
   */
  readonly penMovesDue?: number | undefined;
}

/**
 * Compiles a trajectory to the commands for a board with the given firmware, from setting the pen heights to the last
 * pen move. Send `setUpCommands` before it, once per session: they switch the motors on. `EM,0,0` switches them off.
 *
 * @throws PlotwrightError "bad-setting" for an invalid firmware version, an incomplete machine profile, or a machine
 *   without an EiBotBoard
 * @throws TypeError for an argument of the wrong type
 * @throws RangeError for a trajectory with values that are not finite
 */
export function compile(trajectory: Trajectory, options: CompileOptions): CommandStream {
  checkObject("compile", "the trajectory", trajectory, ["runs", "penMoves"], "what plan returns");
  checkObject(
    "compile",
    "the options object",
    options,
    ["machine", "firmware", "pen"],
    "{ machine, firmware, pen }",
  );
  const { machine, pen } = options;
  checkEbbProfile(machine);
  checkPen("Pen", pen);
  return new Compiler(trajectory, options).run();
}

/**
 * One command of a stream as text, without its line end.
 *
 * @throws RangeError for an index outside the stream
 */
export function commandLine(stream: CommandStream, index: number): string {
  if (!(index >= 0 && index < stream.count)) {
    throw new RangeError(`command ${index} does not exist: the stream has ${stream.count} commands`);
  }
  const bytes = stream.text.subarray(stream.textOffsets[index], stream.textOffsets[index + 1] - 1);
  return String.fromCharCode(...bytes);
}

class Compiler {
  private readonly columns: StreamColumns;
  private readonly runs: RunCommandWriter;
  /** The current set-up lines, by "SC,number". */
  private readonly parameters = new Map<string, string>();

  constructor(
    private readonly trajectory: Trajectory,
    private readonly options: CompileOptions,
  ) {
    this.columns = new StreamColumns(options.start ?? AT_HOME);
    this.runs = this.runWriter();
  }

  run(): CommandStream {
    const { trajectory } = this;
    const { penMoves, runs } = trajectory;
    const { fromS } = this.options;
    if (!Number.isFinite(trajectory.totalS)) throw new RangeError("the trajectory's time is not finite");
    const note = newerFirmwareNote(this.options.firmware);
    if (note !== null) this.columns.warnOnce(note);
    if (penMoves.count > 0 && fromS === undefined)
      this.setUp(penSetUpCommands(this.options.machine, this.options.pen), 0, -1);
    const beginS = (fromS ?? 0) - SAME_TIME_S;
    // A plan may begin with the pen down: its drop was made before.
    const due = this.options.penMovesDue ?? 0;
    const notBeforeS = due > 0 ? beginS + S_PER_TICK : beginS;
    let next = firstWhere(0, penMoves.count, (i) => penMoves.startS[i] >= notBeforeS) - due;
    const first = firstWhere(0, runs.count, (r) => runEndS(trajectory, r) > (fromS ?? -1) + SAME_TIME_S);
    if (fromS !== undefined) this.waitForNext(fromS, first, next);
    for (let r = first; r <= runs.count; r++) {
      for (; next < penMoves.count && penMoves.beforeRun[next] <= r; next++)
        this.penMove(penMoveAt(penMoves, next));
      if (r === runs.count) break;
      const inFlight: PenMove[] = [];
      const endS = runEndS(trajectory, r);
      for (; next < penMoves.count && penMoves.startS[next] < endS; next++)
        inFlight.push(penMoveAt(penMoves, next));
      this.runs.write(
        r,
        fromS,
        inFlight.map((move) => ({
          atS: move.startS,
          write: (planS) => this.penMoveInFlight(move, r, planS),
        })),
      );
      for (const { waitS } of inFlight) this.waitForPen(waitS, endS);
    }
    return this.columns.finish(trajectory.totalS);
  }

  /** Waits for the rest of a pen move that began before `fromS`. */
  private waitForNext(fromS: number, run: number, move: number): void {
    const { runs, penMoves, totalS } = this.trajectory;
    const runS = run < runs.count ? runs.startS[run] : totalS;
    const moveS = move < penMoves.count ? penMoves.startS[move] : totalS;
    this.waitForPen(Math.min(runS, moveS) - fromS, fromS);
  }

  private runWriter(): RunCommandWriter {
    const { trajectory, columns } = this;
    const features = firmwareFeatures(this.options.firmware);
    const walk = new RunWalk(trajectory, this.options.machine);
    const legs = (writer: LegWriter): RunCommandWriter => new LegRuns(trajectory, walk, writer, columns);
    switch (features.motion) {
      case "jerk":
        return legs(new SignedWriter(features));
      case "timed":
        return legs(new TimedWriter());
      case "steps":
        return legs(new SteppedWriter(features));
      case "slices":
        return new SliceRuns(features, walk, columns);
    }
  }

  /** A pen move for which the carriage waits. */
  private penMove(move: PenMove): void {
    const waitMs = Math.min(MAX_DELAY_MS, Math.round(move.waitS * 1_000));
    const servoMove = this.servoMoveOf(move, { run: -1, planS: move.startS });
    const line = penCommand(this.options.machine, servoMove, waitMs);
    this.columns.add(line, Math.max(1, waitMs * TICKS_PER_MS), move.startS, -1);
  }

  /** A pen move during a run. It takes one tick, in which the motors do not move. */
  private penMoveInFlight(move: PenMove, run: number, planS: number): void {
    const servoMove = this.servoMoveOf(move, { run, planS });
    this.columns.add(penCommand(this.options.machine, servoMove, 0), 1, planS, run);
  }

  /** Waits for the rest of a pen move that began during the run. */
  private waitForPen(waitS: number, planS: number): void {
    const waitMs = Math.round(waitS * 1_000);
    if (waitMs > 0) this.columns.add(`SM,${waitMs},0,0`, waitMs * TICKS_PER_MS, planS, -1);
  }

  /** Converts a pen move, and sets its height on the board if it changed. */
  private servoMoveOf(
    { up, heightPct }: PenMove,
    { run, planS }: { readonly run: number; readonly planS: number },
  ): ServoMove {
    const { machine, pen } = this.options;
    const servoMove: ServoMove = { ...penMoveOf(pen, up), heightPct };
    this.setUp(penMoveSetUp(machine, servoMove), planS, run);
    return servoMove;
  }

  /** Writes the set-up lines that differ from those sent before. */
  private setUp(lines: readonly string[], planS: number, run: number): void {
    for (const line of lines) {
      const parameter = line.slice(0, line.lastIndexOf(","));
      if (this.parameters.get(parameter) === line) continue;
      this.parameters.set(parameter, line);
      this.columns.add(line, 0, planS, run);
    }
  }
}
