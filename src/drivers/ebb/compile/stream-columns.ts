/** A command stream as it grows: one row of columns a command, and its text. */
import { CommandText } from "../protocol/commands.js";
import type { CommandStream } from "./command-stream.js";
import { sFromTicks } from "../../../units.js";

export class StreamColumns {
  readonly text = new CommandText();
  readonly warnings: string[] = [];
  /** Ticks from the stream's start to the end of what is written. */
  boardTicks = 0;
  private count = 0;
  private capacity = 1 << 10;
  private offsets = new Uint32Array(this.capacity + 1);
  private boardS = new Float64Array(this.capacity + 1);
  private planS = new Float64Array(this.capacity + 1);
  private steps1 = new Int32Array(this.capacity);
  private steps2 = new Int32Array(this.capacity);
  private acc1 = new Uint32Array(this.capacity);
  private acc2 = new Uint32Array(this.capacity);
  private run = new Int32Array(this.capacity);

  /** Closes the command whose text was just written: it takes `ticks` and leaves the motors as given. */
  add(
    ticks: number,
    planStartS: number,
    run: number,
    steps1: number,
    steps2: number,
    acc1: number,
    acc2: number,
  ): void {
    if (this.count === this.capacity) this.grow();
    const i = this.count++;
    this.boardS[i] = sFromTicks(this.boardTicks);
    this.planS[i] = planStartS;
    this.steps1[i] = steps1;
    this.steps2[i] = steps2;
    this.acc1[i] = acc1;
    this.acc2[i] = acc2;
    this.run[i] = run;
    this.boardTicks += ticks;
    this.offsets[i + 1] = this.text.byteCount;
  }

  warnOnce(warning: string): void {
    if (!this.warnings.includes(warning)) this.warnings.push(warning);
  }

  finish(planEndS: number): CommandStream {
    const n = this.count;
    this.boardS[n] = sFromTicks(this.boardTicks);
    this.planS[n] = planEndS;
    return {
      count: n,
      text: this.text.finish(),
      textOffsets: this.offsets.slice(0, n + 1),
      boardS: this.boardS.slice(0, n + 1),
      planS: this.planS.slice(0, n + 1),
      steps1: this.steps1.slice(0, n),
      steps2: this.steps2.slice(0, n),
      acc1: this.acc1.slice(0, n),
      acc2: this.acc2.slice(0, n),
      run: this.run.slice(0, n),
      warnings: this.warnings,
    };
  }

  private grow(): void {
    this.capacity *= 2;
    const longer = <T extends Float64Array | Uint32Array | Int32Array>(
      make: new (n: number) => T,
      old: T,
      n: number,
    ): T => {
      const grown = new make(n);
      grown.set(old);
      return grown;
    };
    this.offsets = longer(Uint32Array, this.offsets, this.capacity + 1);
    this.boardS = longer(Float64Array, this.boardS, this.capacity + 1);
    this.planS = longer(Float64Array, this.planS, this.capacity + 1);
    this.steps1 = longer(Int32Array, this.steps1, this.capacity);
    this.steps2 = longer(Int32Array, this.steps2, this.capacity);
    this.acc1 = longer(Uint32Array, this.acc1, this.capacity);
    this.acc2 = longer(Uint32Array, this.acc2, this.capacity);
    this.run = longer(Int32Array, this.run, this.capacity);
  }
}
