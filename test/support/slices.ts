/** Streams for firmware before 2.5.3, taken apart: slices, the jumps between them, and whether a board keeps up. */
import { commandLine, type CommandStream, type MachineProfile, type Trajectory } from "../../src/index.js";
import { xFromMotors, yFromMotors } from "../../src/machines/motors.js";

export interface Slice {
  readonly command: number;
  readonly ms: number;
  readonly steps1: number;
  readonly steps2: number;
  readonly run: number;
  readonly isDrawn: boolean;
  /** The run's first, and last. */
  readonly isFirst: boolean;
  readonly isLast: boolean;
}

export function slicesOf(stream: CommandStream, trajectory: Trajectory): Slice[] {
  const slices: Slice[] = [];
  for (let i = 0; i < stream.count; i++) {
    const [name, ms, steps1, steps2] = commandLine(stream, i).split(",");
    if (name !== "SM") continue;
    const run = stream.run[i]!;
    slices.push({
      command: i,
      ...{ ms: Number(ms), steps1: Number(steps1), steps2: Number(steps2), run },
      isDrawn: trajectory.runs.stroke[run]! >= 0,
      isFirst: stream.run[i - 1] !== run,
      isLast: i + 1 === stream.count || stream.run[i + 1] !== run,
    });
  }
  return slices;
}

/** Largest change of speed between slices, from and to rest included where there is one, mm/s. */
export function largestJump(machine: MachineProfile, slices: readonly Slice[]): number {
  let largest = 0;
  let v1 = 0;
  let v2 = 0;
  const turnTo = (next1: number, next2: number): void => {
    const x = xFromMotors(machine, next1 - v1, next2 - v2);
    const y = yFromMotors(machine, next1 - v1, next2 - v2);
    largest = Math.max(largest, Math.hypot(x, y));
    v1 = next1;
    v2 = next2;
  };
  slices.forEach(({ command, ms, steps1, steps2 }, i) => {
    turnTo((1_000 * steps1) / ms, (1_000 * steps2) / ms);
    if (slices[i + 1]?.command !== command + 1) turnTo(0, 0);
  });
  return largest;
}

/**
 * Seconds that a board of firmware before 2.7 would stand still in moving, were it given all bytes at once: it reads a
 * command in 4 ms while both motors step at 2.5 kHz, in 7 ms at 25 kHz (EBB command reference, "Performance"), and
 * cannot begin to read the next before this one is in its queue of one.
 */
export function standstillS(stream: CommandStream, slices: readonly Slice[]): number {
  let readMs = 0;
  let startMs = 0;
  let endMs = 0;
  let stepsPerMs = 0;
  let standstillMs = 0;
  const speeds = new Map(
    slices.map(({ command, ms, steps1, steps2 }) => [
      command,
      (Math.abs(steps1) + Math.abs(steps2)) / 2 / ms,
    ]),
  );
  for (let i = 0; i < stream.count; i++) {
    const durationMs = 1_000 * (stream.boardS[i + 1]! - stream.boardS[i]!);
    // In the queue once it is read and the one before it runs.
    readMs = Math.max(readMs + 4 + (3 * (stepsPerMs - 2.5)) / 22.5, startMs);
    if (durationMs === 0) continue;
    startMs = Math.max(endMs, readMs);
    if (stepsPerMs > 0) standstillMs += startMs - endMs;
    endMs = startMs + durationMs;
    stepsPerMs = speeds.get(i) ?? 0;
  }
  return standstillMs / 1_000;
}
