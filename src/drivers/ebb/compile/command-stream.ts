import type { MachineCommands } from "../../machine-job.js";

/**
 * EBB commands for one trajectory, with the predicted board state after each. Columns only, no functions, so
 * that it can be transferred between threads. Read a line with `commandLine(stream, i)`.
 */
export interface CommandStream extends MachineCommands {
  /** Number of commands. */
  readonly count: number;
  /** ASCII of all commands, each terminated by CR: ready to be written. */
  readonly text: Uint8Array;
  /** count + 1 offsets into `text`. */
  readonly textOffsets: Uint32Array;
  /**
   * Board seconds from the stream's start to each command's start; count + 1 entries. Set-up
   * commands take no time.
   */
  readonly boardS: Float64Array;
  /** Trajectory seconds at each command's start; count + 1 entries. */
  readonly planS: Float64Array;
  /** Predicted step counters after each command (as QS reports them). */
  readonly steps1: Int32Array;
  readonly steps2: Int32Array;
  /** Predicted accumulators after each command, 0 … 2^31 − 1. */
  readonly acc1: Uint32Array;
  readonly acc2: Uint32Array;
  /** Trajectory run each command belongs to; −1 for pen and set-up commands between two runs. */
  readonly run: Int32Array;
  /** Messages about limits that required splitting or slowing down. */
  readonly warnings: readonly string[];
}

/** Casts a job's commands to the type of this driver. Throws TypeError for commands of another driver. */
export function streamOf(commands: MachineCommands): CommandStream {
  if (!("steps1" in commands)) throw new TypeError("these commands are for another controller");
  return commands as CommandStream;
}

/** Step counters and accumulators of the board between two command streams. */
export interface BoardState {
  readonly steps1: number;
  readonly steps2: number;
  readonly acc1: number;
  readonly acc2: number;
}

/** The state after the motors are switched on at home. */
export const AT_HOME: BoardState = { steps1: 0, steps2: 0, acc1: 0, acc2: 0 };
