/** Builds a command stream: one row of columns per command, and its text. */
import { sFromTicks } from "../../../units.js";
import { CommandText } from "../protocol/commands.js";
import type { CommandStream } from "./command-stream.js";
import type { MotorState } from "./leg.js";

export class StreamColumns {
  readonly text = new CommandText();
  /** Ticks from the stream's start to the end of the last command written. */
  boardTicks = 0;
  private readonly warnings: string[] = [];
  private readonly textOffsets = [0];
  private readonly boardS: number[] = [];
  private readonly planS: number[] = [];
  private readonly steps1: number[] = [];
  private readonly steps2: number[] = [];
  private readonly acc1: number[] = [];
  private readonly acc2: number[] = [];
  private readonly run: number[] = [];

  /** Completes the command whose text was just written: its `ticks`, and the motors' state after it. */
  add(ticks: number, planStartS: number, run: number, m1: MotorState, m2: MotorState): void {
    this.boardS.push(sFromTicks(this.boardTicks));
    this.planS.push(planStartS);
    this.steps1.push(m1.steps);
    this.steps2.push(m2.steps);
    this.acc1.push(m1.acc);
    this.acc2.push(m2.acc);
    this.run.push(run);
    this.boardTicks += ticks;
    this.textOffsets.push(this.text.byteCount);
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
      text: this.text.finish(),
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
}
