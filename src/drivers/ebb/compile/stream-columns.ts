/** Builds a command stream: one row of columns per command, and its text. */
import { grown } from "../../../geometry/growable.js";
import { sFromTicks } from "../../../units.js";
import { asciiBytes } from "../../line-splitter.js";
import type { BoardState, CommandStream } from "./command-stream.js";
import type { MotorState } from "./leg.js";

export class StreamColumns {
  /** The motors' predicted states after the last command. */
  readonly m1: MotorState;
  readonly m2: MotorState;
  /** Ticks from the stream's start to the end of the last command. */
  boardTicks = 0;
  private readonly warnings: string[] = [];
  private text = new Uint8Array(1 << 12);
  private readonly textOffsets = [0];
  private readonly boardS: number[] = [];
  private readonly planS: number[] = [];
  private readonly steps1: number[] = [];
  private readonly steps2: number[] = [];
  private readonly acc1: number[] = [];
  private readonly acc2: number[] = [];
  private readonly run: number[] = [];

  constructor({ steps1, steps2, acc1, acc2 }: BoardState) {
    this.m1 = { steps: steps1, acc: acc1 };
    this.m2 = { steps: steps2, acc: acc2 };
  }

  /** Adds a command after which the motors are in the states `m1` and `m2`. */
  add(line: string, ticks: number, planStartS: number, run: number): void {
    this.addText(line);
    this.boardS.push(sFromTicks(this.boardTicks));
    this.planS.push(planStartS);
    this.steps1.push(this.m1.steps);
    this.steps2.push(this.m2.steps);
    this.acc1.push(this.m1.acc);
    this.acc2.push(this.m2.acc);
    this.run.push(run);
    this.boardTicks += ticks;
  }

  warnOnce(warning: string): void {
    if (!this.warnings.includes(warning)) this.warnings.push(warning);
  }

  finish(planEndS: number): CommandStream {
    const count = this.run.length;
    this.boardS.push(sFromTicks(this.boardTicks));
    this.planS.push(planEndS);
    return {
      count,
      text: this.text.slice(0, this.textOffsets[count]),
      textOffsets: new Uint32Array(this.textOffsets),
      boardS: new Float64Array(this.boardS),
      planS: new Float64Array(this.planS),
      steps1: new Int32Array(this.steps1),
      steps2: new Int32Array(this.steps2),
      acc1: new Uint32Array(this.acc1),
      acc2: new Uint32Array(this.acc2),
      run: new Int32Array(this.run),
      warnings: this.warnings,
    };
  }

  private addText(line: string): void {
    const bytes = asciiBytes(`${line}\r`);
    const start = this.textOffsets[this.run.length];
    const end = start + bytes.length;
    if (end > this.text.length) this.text = grown(this.text, end);
    this.text.set(bytes, start);
    this.textOffsets.push(end);
  }
}
