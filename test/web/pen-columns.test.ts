import { describe, expect, it } from "vitest";
import { DEFAULT_MOTION, DEFAULT_PEN, plan, stateAt } from "../../src/index.js";
import { penColumnsOf, penMovesOf } from "../../web/worker/pen-columns.js";
import { strokeSetOf } from "../support/arbitraries.js";

describe("pen moves that came as columns", () => {
  const trajectory = plan(
    strokeSetOf([
      [
        [10, 10],
        [20, 10],
      ],
      [
        [40, 10],
        [40, 30],
      ],
    ]),
    DEFAULT_MOTION,
    DEFAULT_PEN,
  );
  const moves = penMovesOf(penColumnsOf(trajectory.penMoves));

  it("read like those that were sent", () => {
    expect(moves.length).toBe(trajectory.penMoves.length);
    expect([...moves]).toEqual(
      trajectory.penMoves.map((move) => ({ ...move, waitS: Math.fround(move.waitS) })),
    );
    expect(moves.map(({ up }) => up)).toEqual(trajectory.penMoves.map(({ up }) => up));
    expect(moves[moves.length]).toBeUndefined();
  });

  it("tell whether the pen is up at any moment", () => {
    const sent = { ...trajectory, penMoves: moves };
    for (let i = 0; i <= 200; i++) {
      const tS = (trajectory.totalS * i) / 200;
      expect(stateAt(sent, tS).penUp).toBe(stateAt(trajectory, tS).penUp);
    }
  });
});
