/**
 * Finds the position in the plan at which an emergency stop (ES) stopped the board. The step counters
 * alone are ambiguous: a line may pass the same steps several times, for example at a narrow tip or
 * where it retraces itself.
 *
 *   which command   The query before ES reports how many commands waited in the queue. All written commands are answered
 *                   by then, so the running command is that many before the last one. If it ended between the query
 *                   and ES, it was the next one.
 *   where in it     The ticks after which its motors have made exactly the counted steps, computed with the board's own
 *                   arithmetic.
 *   which of these  A motor that reverses within a command passes the same steps twice. Before firmware 3, ES reports
 *                   how many steps of the command were left. Otherwise the time of the stop decides.
 *
 * Firmware 2.7 and 2.8 does not stop but finishes all received commands, so it is at the end of the last command.
 */
import type { BoardState } from "../compile/command-stream.js";
import { commandLine } from "../compile/compile.js";
import { boardStateAfter } from "./cut-streams.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { commandName } from "../protocol/replies.js";
import { sFromTicks } from "../../../units.js";
import { placeIn, type InFlight, type StreamPlace } from "./timeline.js";
import { MotionCommands } from "../model/motion-commands.js";
import { RunningMove } from "../model/orders.js";
import { Parameters } from "../model/parameters.js";

type Steps = readonly [motor1: number, motor2: number];

const NO_STEPS: Steps = [0, 0];
/** Tolerance in steps for the rounding of plan times to board times. */
const SAME_STEPS = 2;

/** Data recorded at a stop. */
export interface StopNotes {
  /** Estimated board time when the stop was sent. */
  boardS: number;
  /** How many commands waited behind the running one just before the stop; null: not reported. */
  waitingCount: number | null;
  /** Remaining steps of the running command, by motor; null: not reported. */
  stepsLeft: readonly [number, number] | null;
}

interface StopEvidence extends Readonly<StopNotes> {
  /** The commands written last, in order. */
  readonly commands: readonly InFlight[];
  /** Those of them that the board refused and so never ran. */
  readonly refused?: readonly InFlight[];
}

/** `number`: the command's number, as in `InFlight`. */
export interface NumberedPlace extends StreamPlace {
  readonly number: number;
}

/** The position in the streams of a stop at the counters `steps1`, `steps2`; null if nothing had run. */
export function placeOfStop(
  evidence: StopEvidence,
  features: FirmwareFeatures,
  steps1: number,
  steps2: number,
): NumberedPlace | null {
  const { waitingCount, stepsLeft: left, refused = [] } = evidence;
  const commands = evidence.commands.filter((one) => !refused.includes(one));
  // The steps of a refused command are missing, so the commands after it are offset from their plan by these steps.
  const missingBefore = ({ number }: InFlight): Steps =>
    refused
      .filter((one) => one.number < number)
      .map((one) => stepsOf(one, evidence.commands))
      .reduce((sum, steps) => [sum[0] + steps[0], sum[1] + steps[1]], NO_STEPS);
  const last = commands[commands.length - 1];
  if (!last) return null;
  if (!features.stopEndsTimed) return numbered(last, last.endS);
  const first = waitingCount === null ? 0 : Math.max(0, commands.length - 1 - waitingCount);
  const running = waitingCount === null ? commands : commands.slice(first, first + 2);
  const boardS = Math.max(evidence.boardS, running[0].startS);
  const fits = running.filter((command) => {
    const { stream, index } = command;
    const [missing1, missing2] = missingBefore(command);
    const [end1, end2] = [stream.steps1[index] - missing1, stream.steps2[index] - missing2];
    return !left || (left[0] === Math.abs(end1 - steps1) && left[1] === Math.abs(end2 - steps2));
  });
  const nearest = new NearestTick(features, steps1, steps2, boardS);
  for (const command of fits.length > 0 ? fits : running) {
    nearest.search(command, stateBefore(command, evidence.commands), missingBefore(command));
  }
  return nearest.command && numbered(nearest.command, nearest.boardS);
}

/** The position with these step counters that is nearest to a board time; null if no command passes it. */
export function placeOfCounters(
  commands: readonly InFlight[],
  features: FirmwareFeatures,
  steps1: number,
  steps2: number,
  boardS: number,
): StreamPlace | null {
  const nearest = new NearestTick(features, steps1, steps2, boardS, SAME_STEPS);
  for (const command of commands) {
    const before = stateBefore(command, commands);
    if (before && passes(command, before, steps1, steps2)) nearest.search(command, before, NO_STEPS);
  }
  return nearest.command && placeIn(nearest.command, nearest.boardS);
}

/** Whether the counters are between those at a command's start and end: a fast check that excludes most commands. */
function passes({ stream, index }: InFlight, before: BoardState, steps1: number, steps2: number): boolean {
  const isBetween = (from: number, to: number, steps: number): boolean =>
    steps >= Math.min(from, to) - SAME_STEPS && steps <= Math.max(from, to) + SAME_STEPS;
  const [end1, end2] = [stream.steps1[index], stream.steps2[index]];
  return isBetween(before.steps1, end1, steps1) && isBetween(before.steps2, end2, steps2);
}

/** The steps that a command adds to the counters. */
function stepsOf(command: InFlight, commands: readonly InFlight[]): Steps {
  const before = stateBefore(command, commands);
  const { stream, index } = command;
  return before ? [stream.steps1[index] - before.steps1, stream.steps2[index] - before.steps2] : NO_STEPS;
}

/** The board's state before a command; null for the very first one. */
function stateBefore({ number, stream, index }: InFlight, commands: readonly InFlight[]): BoardState | null {
  if (index > 0) return boardStateAfter(stream, index - 1);
  const before = commands.find((one) => one.number === number - 1);
  return before ? boardStateAfter(before.stream, before.index) : null;
}

const numbered = (command: InFlight, boardS: number): NumberedPlace => ({
  number: command.number,
  ...placeIn(command, boardS),
});

/** Finds the tick at which the counters are nearest to those reported (ideally equal); if several, the nearest in time. */
class NearestTick {
  command: InFlight | null = null;
  boardS = 0;
  private offS = Infinity;

  constructor(
    private readonly features: FirmwareFeatures,
    private readonly steps1: number,
    private readonly steps2: number,
    private readonly stopS: number,
    /** Of the nearest tick so far; at first the max that counts. The search skips the ticks that are farther off. */
    private offSteps = Infinity,
  ) {}

  /** `missing`: steps of the command's plan that are not in the counters. */
  search(command: InFlight, before: BoardState | null, [missing1, missing2]: Steps): void {
    const { stream, index, startS, endS } = command;
    const move = before && moveOf(commandLine(stream, index), this.features, before);
    if (!move) {
      const off = this.off(stream.steps1[index] - missing1, stream.steps2[index] - missing2);
      this.offer(command, off, Math.min(endS, Math.max(startS, this.stopS)));
      return;
    }
    for (let tick = 0; tick <= move.ticks;) {
      const off = this.off(
        before.steps1 - missing1 + move.motion1.placeAt(tick).net,
        before.steps2 - missing2 + move.motion2.placeAt(tick).net,
      );
      this.offer(command, off, startS + sFromTicks(tick));
      // A motor makes at most one step per tick, so none of the skipped ticks can be nearer.
      tick += Math.max(1, off - this.offSteps);
    }
  }

  private off(steps1: number, steps2: number): number {
    return Math.max(Math.abs(steps1 - this.steps1), Math.abs(steps2 - this.steps2));
  }

  private offer(command: InFlight, offSteps: number, boardS: number): void {
    const offS = Math.abs(boardS - this.stopS);
    if (offSteps > this.offSteps || (offSteps === this.offSteps && offS >= this.offS)) return;
    this.command = command;
    this.boardS = boardS;
    this.offSteps = offSteps;
    this.offS = offS;
  }
}

/** Null for a command during which the motors do not move. */
function moveOf(line: string, features: FirmwareFeatures, before: BoardState): RunningMove | null {
  const name = commandName(line);
  const parameters = new Parameters(line.slice(name.length));
  const [order] = new MotionCommands(features, () => false).planned(name, parameters);
  if (order?.kind !== "move") return null;
  return RunningMove.begin(order, features, before.acc1, before.acc2);
}
