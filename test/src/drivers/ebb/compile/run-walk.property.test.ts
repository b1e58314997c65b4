import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { RunWalk } from "../../../../../src/drivers/ebb/compile/run-walk.js";
import { DEFAULT_MOTION, DEFAULT_PEN, machineById, plan } from "../../../../../src/index.js";
import { strokeSetOf, type Point } from "../../../../support/drawings/arbitraries.js";
import { cases } from "../../../../support/runs/full-run.js";

const real = (min: number, max: number) => fc.double({ min, max, noNaN: true });
const machine = machineById("axidraw-v3");
/** Both motors reverse at its corners. */
const ZIGZAG: Point[] = [
  [0, 0],
  [3, 0.5],
  [0.5, 3],
  [3, 6],
  [0, 6],
];
/** Slower than this a motor rests: rounding errors, counts per tick. */
const RESTING = 1;

describe("the walk along a run of any plan", () => {
  it("finds the tick at which a motor first reverses in a block", () => {
    let turnCount = 0;
    fc.assert(
      fc.property(
        fc.array(fc.tuple(real(0, 6), real(0, 6)), { minLength: 2, maxLength: 4 }),
        fc.constantFrom("blend", "scurve"),
        fc.nat(1_000),
        (points, mode, firstTick) => {
          const trajectory = plan(strokeSetOf([points]), { ...DEFAULT_MOTION, mode, fit: null }, DEFAULT_PEN);
          const walk = new RunWalk(trajectory, machine);
          for (let run = 0; run < trajectory.runs.count; run++) {
            walk.begin(run, firstTick);
            for (let k = walk.first; k < walk.end; k++) {
              const from = k === walk.first ? firstTick : walk.endTick(k - 1);
              const to = walk.endTick(k);
              if (isResting(walk, k, from, to)) continue;
              const turn = firstTurn(walk, k, from, to);
              const found = walk.turnTick(k, from, to);
              if (turn !== Infinity) turnCount++;
              // It may be rounded to the other tick, which may be outside.
              if (turn === Infinity && found !== Infinity)
                expect(Math.min(found - from, to - found)).toBeLessThan(2);
              else if (found === Infinity && turn !== Infinity)
                expect(Math.min(turn - from, to - turn)).toBeLessThan(2);
              else if (turn !== Infinity) expect(Math.abs(found - turn)).toBeLessThanOrEqual(1);
            }
          }
        },
      ),
      {
        numRuns: cases(200, 20),
        examples: [
          [ZIGZAG, "blend", 7],
          [ZIGZAG, "scurve", 8],
        ],
        endOnFailure: true,
      },
    );
    expect(turnCount).toBeGreaterThan(0);
  });
});

/** Whether a motor has no speed but rounding errors, whose sign says nothing. */
function isResting(walk: RunWalk, block: number, from: number, to: number): boolean {
  const [start, end] = [walk.pointAt(from, block), walk.pointAt(to, block)];
  return (["m1", "m2"] as const).some(
    (motor) => Math.max(Math.abs(start[motor].v), Math.abs(end[motor].v)) < RESTING,
  );
}

/** Looks at each tick. */
function firstTurn(walk: RunWalk, block: number, from: number, to: number): number {
  let before = walk.pointAt(from, block);
  for (let tick = from + 1; tick <= to; tick++) {
    const now = walk.pointAt(tick, block);
    for (const motor of ["m1", "m2"] as const) {
      const [v0, v1] = [before[motor].v, now[motor].v];
      if (v0 * v1 < 0 && Math.min(Math.abs(v0), Math.abs(v1)) > RESTING) return tick;
    }
    before = now;
  }
  return Infinity;
}
