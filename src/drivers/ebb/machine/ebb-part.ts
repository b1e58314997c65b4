import type { Part } from "../../run-progress.js";
import type { BoardState, CommandStream } from "../compile/command-stream.js";

/** A part of a run, in the form that the board receives. */
export interface EbbPart extends Part {
  readonly commands: CommandStream;
  /** The board's state before its first command. */
  readonly start: BoardState;
}
