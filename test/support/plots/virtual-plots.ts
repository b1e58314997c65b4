/** Plays command streams on virtual boards at full speed, and compares the result with the prediction. */
import {
  commandLine,
  compile,
  setUpCommands,
  VirtualBoard,
  type CommandStream,
  type Clock,
  type MachineProfile,
  type PenSettings,
  type Trajectory,
} from "../../../src/index.js";
import { MotionCommands } from "../../../src/drivers/ebb/model/motion-commands.js";
import { RunningMove } from "../../../src/drivers/ebb/model/orders.js";
import { Parameters } from "../../../src/drivers/ebb/model/parameters.js";
import type { FirmwareFeatures } from "../../../src/drivers/ebb/protocol/firmware.js";
import type { BoardState, Springs } from "../../../src/internal.js";

/** A clock that stands still: a board of infinite speed does not need it. */
const stillClock: Clock = { nowS: () => 0, after: () => () => undefined };

export const ascii = (text: string): Uint8Array => Uint8Array.from(text, (c) => c.charCodeAt(0));

export class FastBoard {
  readonly board: VirtualBoard;
  /** Error lines of the board. */
  readonly errors: string[] = [];
  private state: BoardState = { steps1: 0, steps2: 0, acc1: 0, acc2: 0 };

  constructor(
    readonly firmware: string,
    readonly machine: MachineProfile,
    readonly pen: PenSettings,
    unlike: { readonly springs?: Springs; readonly idleTicksTimed?: number } = {},
  ) {
    const options = { clock: stillClock, firmware, machine, speed: Infinity, servo: {} };
    this.board = new VirtualBoard({ ...options, ...unlike });
    this.board.onSend((bytes) => {
      const text = String.fromCharCode(...bytes);
      if (text.includes("!")) this.errors.push(text.trim());
    });
    for (const line of setUpCommands(machine, pen, firmware)) this.send(line);
  }

  send(line: string): void {
    this.board.receive(ascii(`${line}\r`));
  }

  compile(trajectory: Trajectory): CommandStream {
    const { machine, firmware, pen, state } = this;
    return compile(trajectory, { machine, firmware, pen, start: state });
  }

  /**
   * Plays a stream; returns its duration in board seconds and the first command after which the counters
   * differ.
   */
  play(stream: CommandStream): { boardS: number; firstWrong: string | null } {
    const before = this.board.state().boardS;
    let firstWrong: string | null = null;
    for (let i = 0; i < stream.count; i++) {
      this.board.receive(stream.text.subarray(stream.textOffsets[i], stream.textOffsets[i + 1]));
      const { steps1, steps2 } = this.board.state();
      if (firstWrong === null && (steps1 !== stream.steps1[i] || steps2 !== stream.steps2[i])) {
        firstWrong = `${i}: ${commandLine(stream, i)} -> ${steps1},${steps2}`;
      }
    }
    if (stream.count > 0) {
      const last = stream.count - 1;
      this.state = {
        steps1: stream.steps1[last],
        steps2: stream.steps2[last],
        acc1: stream.acc1[last],
        acc2: stream.acc2[last],
      };
    }
    return { boardS: this.board.state().boardS - before, firstWrong };
  }
}

/** What both motors do during a command SM, LM, LT or T3, from the state of their accumulators; null: they wait. */
export function execute(
  line: string,
  features: FirmwareFeatures,
  acc1: number,
  acc2: number,
): RunningMove | null {
  const [name] = line.split(",");
  const commands = new MotionCommands(features, () => false);
  const parameters = new Parameters(line.slice(name.length));
  const [order] =
    name === "SM"
      ? commands.slow(parameters, false)
      : name === "LM"
        ? commands.stepped(parameters, false)
        : commands.timed(parameters, name === "T3");
  return order.kind === "move" ? RunningMove.begin(order, features, acc1, acc2) : null;
}
