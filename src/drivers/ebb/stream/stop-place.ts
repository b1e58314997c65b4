/**
 * Where in its plan a board was stopped at once (ES). Its step counters alone do not say: a line may pass the same
 * steps again and again, as at a narrow tip or where it goes back over itself.
 *
 *   which command   The question before ES, and the answer to it, say how many commands waited in the queue; all that
 *                   were written are answered by then, so the one that ran is as many before the last one. It may
 *                   have ended between question and ES: then it was the next.
 *   where in it     the ticks after which its motors have made just the steps that the counters say, by the same
 *                   arithmetic as the board's
 *   which of these  Before firmware 3, ES tells how many steps of the command were left. Else the time of the stop:
 *                   a motor that turns back within a command passes the same steps twice.
 *
 * Firmware 2.7 and 2.8 does not stop at all but plays what it has got: it stands where the last command ends.
 */
import type { BoardState } from "../compile/command-stream.js";
import { commandLine } from "../compile/compile.js";
import type { FirmwareFeatures } from "../protocol/firmware.js";
import { commandName } from "../protocol/replies.js";
import { TICKS_PER_S } from "../../../units.js";
import type { InFlight, StreamPlace } from "./timeline.js";
import { MotionCommands } from "../model/motion-commands.js";
import { RunningMove } from "../model/orders.js";
import { Parameters } from "../model/parameters.js";

/** What is noted at a stop. */
export interface StopNotes {
  /** The board's time when it was told to stop, as the host has it. */
  readonly boardS: number;
  /** How many commands waited behind the running one just before; null: not told. */
  waitingCount: number | null;
  /** Of the running command, each motor's; null: not told. */
  stepsLeft: readonly [number, number] | null;
}

export interface StopEvidence extends Readonly<StopNotes> {
  /** The commands written last, in order. */
  readonly commands: readonly InFlight[];
}

/** The place of a stop whose counters say `steps1`, `steps2`, in the terms of the streams; null when nothing had run. */
export function placeOfStop(
  evidence: StopEvidence,
  features: FirmwareFeatures,
  steps1: number,
  steps2: number,
): StreamPlace | null {
  const { commands, waitingCount, stepsLeft: left } = evidence;
  const last = commands[commands.length - 1];
  if (!last) return null;
  if (!features.stopEndsTimed) return placeIn(last, last.endS);
  const first = waitingCount === null ? 0 : Math.max(0, commands.length - 1 - waitingCount);
  const running = waitingCount === null ? commands : commands.slice(first, first + 2);
  const boardS = Math.max(evidence.boardS, running[0]!.startS);
  const fits = running.filter(({ stream, index }) => {
    const [end1, end2] = [stream.steps1[index]!, stream.steps2[index]!];
    return !left || (left[0] === Math.abs(end1 - steps1) && left[1] === Math.abs(end2 - steps2));
  });
  const nearest = new NearestTick(features, steps1, steps2, boardS);
  for (const command of fits.length > 0 ? fits : running) {
    nearest.lookIn(command, stateBefore(command, commands));
  }
  return nearest.command && placeIn(nearest.command, nearest.boardS);
}

/** What the board held before a command; null for the very first one. */
function stateBefore({ number, stream, index }: InFlight, commands: readonly InFlight[]): BoardState | null {
  const before = index > 0 ? { stream, index: index - 1 } : commands.find((one) => one.number === number - 1);
  if (!before) return null;
  const { steps1, steps2, acc1, acc2 } = before.stream;
  const i = before.index;
  return { steps1: steps1[i]!, steps2: steps2[i]!, acc1: acc1[i]!, acc2: acc2[i]! };
}

function placeIn({ stream, index, startS, endS }: InFlight, boardS: number): StreamPlace {
  const share = Math.min(1, Math.max(0, (boardS - startS) / (endS - startS)));
  const fromS = stream.planS[index]!;
  return { stream, commandIndex: index, planS: fromS + share * (stream.planS[index + 1]! - fromS) };
}

/** Of the ticks at which the counters come nearest to those told (they should be the same), the nearest in time. */
class NearestTick {
  command: InFlight | null = null;
  boardS = 0;
  private offSteps = Infinity;
  private offS = Infinity;

  constructor(
    private readonly features: FirmwareFeatures,
    private readonly steps1: number,
    private readonly steps2: number,
    private readonly stopS: number,
  ) {}

  lookIn(command: InFlight, before: BoardState | null): void {
    const { stream, index, startS, endS } = command;
    const move = before && moveOf(commandLine(stream, index), this.features, before);
    if (!move) {
      const off = this.off(stream.steps1[index]!, stream.steps2[index]!);
      this.offer(command, off, Math.min(endS, Math.max(startS, this.stopS)));
      return;
    }
    const place = { net: 0, acc: 0 };
    for (let tick = 0; tick <= move.ticks;) {
      const off = this.off(
        before.steps1 + move.motion1.placeAt(tick, place).net,
        before.steps2 + move.motion2.placeAt(tick, place).net,
      );
      this.offer(command, off, startS + tick / TICKS_PER_S);
      // A motor makes one step a tick at most.
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

/** Null for a command in which the motors rest. */
function moveOf(line: string, features: FirmwareFeatures, before: BoardState): RunningMove | null {
  const name = commandName(line);
  const parameters = new Parameters(line.slice(name.length));
  const motion = new MotionCommands(features, () => false);
  const orders =
    name === "SM"
      ? motion.slow(parameters, false)
      : name === "LM"
        ? motion.stepped(parameters, false)
        : name === "LT" || name === "T3"
          ? motion.timed(parameters, name === "T3")
          : [];
  const [order] = orders;
  if (order?.kind !== "move") return null;
  return RunningMove.begin(order, features.arithmetic, before.acc1, before.acc2);
}
