import type { CommandStream } from "../../../src/index.js";

export interface StreamRow {
  readonly line: string;
  readonly durationS: number;
  /** Steps that the command adds to each motor. */
  readonly steps?: readonly [number, number];
  /** Trajectory run; −1 (default) for pen and set-up commands. */
  readonly run?: number;
}

/** A hand-written command stream; plan time is board time. */
export function makeStream(
  rows: readonly StreamRow[],
  from: readonly [number, number] = [0, 0],
): CommandStream {
  const count = rows.length;
  const text = Buffer.from(rows.map((row) => `${row.line}\r`).join(""), "latin1");
  const textOffsets = new Uint32Array(count + 1);
  const boardS = new Float64Array(count + 1);
  const steps1 = new Int32Array(count);
  const steps2 = new Int32Array(count);
  let at = from;
  rows.forEach((row, i) => {
    textOffsets[i + 1] = textOffsets[i] + row.line.length + 1;
    boardS[i + 1] = boardS[i] + row.durationS;
    at = [at[0] + (row.steps?.[0] ?? 0), at[1] + (row.steps?.[1] ?? 0)];
    steps1[i] = at[0];
    steps2[i] = at[1];
  });
  return {
    count,
    text: new Uint8Array(text),
    textOffsets,
    boardS,
    planS: boardS.slice(),
    steps1,
    steps2,
    acc1: new Uint32Array(count),
    acc2: new Uint32Array(count),
    run: Int32Array.from(rows, (row) => row.run ?? -1),
    warnings: [],
  };
}

/** `count` moves in one run, `ms` each, roughly in a circle so that the position stays bounded. */
export function wavyRows(count: number, ms: number, run = 0): StreamRow[] {
  const stepsPerMs = 4;
  return Array.from({ length: count }, (_, i) => {
    const steps: [number, number] = [
      Math.round(stepsPerMs * ms * Math.cos(i / 25)) || 1,
      Math.round(stepsPerMs * ms * Math.sin(i / 25)) || 1,
    ];
    return { line: `SM,${ms},${steps[0]},${steps[1]}`, durationS: ms / 1000, steps, run };
  });
}
