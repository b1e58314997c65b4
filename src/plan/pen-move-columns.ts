/** A plan's pen moves in columns: who only wants the motion makes no object for each of them. */
import type { PenMove } from "./trajectory.js";

export class PenMoveColumns {
  private count = 0;
  private readonly beforeRun: Uint32Array;
  private readonly up: Uint8Array;
  private readonly startS: Float64Array;
  private readonly waitS: Float64Array;
  private readonly heightPct: Float64Array;
  private made: readonly PenMove[] | null = null;

  constructor(most: number) {
    this.beforeRun = new Uint32Array(most);
    this.up = new Uint8Array(most);
    this.startS = new Float64Array(most);
    this.waitS = new Float64Array(most);
    this.heightPct = new Float64Array(most);
  }

  push(beforeRun: number, up: boolean, startS: number, waitS: number, heightPct: number): void {
    const i = this.count++;
    this.beforeRun[i] = beforeRun;
    this.up[i] = up ? 1 : 0;
    this.startS[i] = startS;
    this.waitS[i] = waitS;
    this.heightPct[i] = heightPct;
  }

  /** Made when first asked for; push no more then. */
  get moves(): readonly PenMove[] {
    this.made ??= Array.from({ length: this.count }, (_, i) => ({
      beforeRun: this.beforeRun[i]!,
      up: this.up[i] === 1,
      startS: this.startS[i]!,
      waitS: this.waitS[i]!,
      heightPct: this.heightPct[i]!,
    }));
    return this.made;
  }
}
