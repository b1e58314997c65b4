import { describe, expect, it } from "vitest";
import { servoFollower } from "../../../web/plotter/hand/servo-follow.js";

describe("a pen that follows a slider", () => {
  it("moves at most five times a second, one move at a time, and ends at the last height", async () => {
    const moves: [atMs: number, pct: number][] = [];
    let nowMs = 0;
    let pending: { readonly atMs: number; readonly run: () => void }[] = [];
    const after = (delayMs: number, run: () => void): void =>
      void pending.push({ atMs: nowMs + delayMs, run });
    let goingCount = 0;
    const follow = servoFollower(async ({ pct }: { pct: number }) => {
      moves.push([nowMs, pct]);
      expect(++goingCount).toBe(1);
      await new Promise<void>((resolve) => after(pct === 50 ? 700 : 30, resolve));
      goingCount--;
    }, after);
    for (; nowMs < 3_000; nowMs += 10) {
      // A drag of one second, from 30 to 80 %.
      if (nowMs < 1_000 && nowMs % 20 === 0) follow({ pct: 30 + nowMs / 20 });
      const due = pending.filter(({ atMs }) => atMs <= nowMs);
      pending = pending.filter(({ atMs }) => atMs > nowMs);
      for (const { run } of due) run();
      for (let k = 0; k < 5; k++) await Promise.resolve();
    }
    expect(moves.at(-1)?.[1]).toBe(79);
    const gapsMs = moves.slice(1).map(([atMs], k) => atMs - moves[k][0]);
    expect(Math.min(...gapsMs)).toBeGreaterThanOrEqual(200);
    // A slow move delays the next one.
    expect(Math.max(...gapsMs)).toBeGreaterThanOrEqual(700);
    expect(moves.length).toBeLessThanOrEqual(6);
  });
});
