import type { Part } from "../../run-progress.js";
import type { BoardState, CommandStream } from "../compile/command-stream.js";

/** A part of a run as the board gets it. */
export interface EbbPart extends Part {
  readonly commands: CommandStream;
  /** What the board holds before its first command. */
  readonly start: BoardState;
}
