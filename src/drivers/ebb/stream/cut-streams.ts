/** Functions to cut and build command streams, for a switch from one plan to another in motion. */
import { commandLine } from "../compile/compile.js";
import type { BoardState, CommandStream } from "../compile/command-stream.js";
import { StreamColumns } from "../compile/stream-columns.js";
import { firstWhere } from "../../../geometry/binary-search.js";
import { TICKS_PER_S } from "../../../units.js";

/** The board's state after command `i`. */
const boardStateAfter = ({ steps1, steps2, acc1, acc2 }: CommandStream, i: number): BoardState => ({
  steps1: steps1[i],
  steps2: steps2[i],
  acc1: acc1[i],
  acc2: acc2[i],
});

/** The board's state after the commands before `index`. `start`: its state before the stream. */
export const boardStateBefore = (stream: CommandStream, index: number, start: BoardState): BoardState =>
  index === 0 ? start : boardStateAfter(stream, index - 1);

/** The first command that begins at least `leadS` after command `index`. */
export function commandAfter({ boardS, count }: CommandStream, index: number, leadS: number): number {
  const fromS = boardS[index] + leadS;
  return firstWhere(index, count, (i) => boardS[i] >= fromS);
}

/**
 * The end of the commands that must be written together, from `index` on. That is one command, except for a drop during
 * a run: it is written with the rest of the run. Otherwise a host that is killed in between would leave the pen on the
 * paper before the stroke.
 */
export function endOfLowering(stream: CommandStream, index: number): number {
  const { run, count } = stream;
  let end = index + 1;
  if (run[index] < 0 || !/^(SP,0|S2),/.test(commandLine(stream, index))) return end;
  while (end < count && run[end] === run[index]) end++;
  return end;
}

/** How many pen moves during a run are written from command `index` on, before the carriage moves on. */
export function penMovesInRun(stream: CommandStream, index: number): number {
  let moves = 0;
  for (let i = index; i < stream.count && stream.run[i] >= 0; i++) {
    const line = commandLine(stream, i);
    if (/^(SP|S2),/.test(line)) moves++;
    else if (!line.startsWith("SC,")) break;
  }
  return moves;
}

/**
 * A stream without its initial drop, for a pen that is already down. `setUp`: the heights and speeds that the left out
 * commands set. The board needs them, because the stream sets them again only where they change.
 */
export function withoutDrop(commands: CommandStream): { setUp: string[]; afterDrop: CommandStream } {
  const setUp: string[] = [];
  let first = 0;
  for (; first < commands.count && commands.run[first] < 0; first++) {
    const line = commandLine(commands, first);
    if (line.startsWith("SC,")) setUp.push(line);
  }
  return { setUp, afterDrop: streamFrom(commands, first) };
}

/** A stream without its first commands. */
function streamFrom(stream: CommandStream, index: number): CommandStream {
  return {
    ...stream,
    count: stream.count - index,
    textOffsets: stream.textOffsets.subarray(index),
    boardS: stream.boardS.subarray(index),
    planS: stream.planS.subarray(index),
    steps1: stream.steps1.subarray(index),
    steps2: stream.steps2.subarray(index),
    acc1: stream.acc1.subarray(index),
    acc2: stream.acc2.subarray(index),
    run: stream.run.subarray(index),
  };
}

/** A stream of commands during which the motors rest, each with its duration in the board's queue. */
export function restingStream(
  lines: readonly (readonly [line: string, durationS: number])[],
  state: BoardState,
  planS: number,
): CommandStream {
  const columns = new StreamColumns(state);
  for (const [line, durationS] of lines) columns.add(line, durationS * TICKS_PER_S, planS, -1);
  return columns.finish(planS);
}
