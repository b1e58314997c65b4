import { it } from "vitest";
import { seeded } from "../support/live-plot.js";
import { plotWithFault, waitS } from "../support/faulty-plots.js";
it("repro", async () => {
  const r = seeded(1_000_003 * 2);
  for (let i = 0; i < 8; i++) {
    const afterS = 0.3 + 6.7 * r();
    const b = Math.floor(60 * r());
    console.log(i, afterS, b);
    if (Math.abs(afterS - 1.71821) > 1e-3) continue;
    const res = await Promise.all([b - 1, b, b + 1].map((afterBytes) => plotWithFault({ name: "x", happen: async (board) => {
      board.tell({ type: "deaf", deaf: true, afterBytes });
      await waitS(6);
      board.tell({ type: "deaf", deaf: false });
    } }, "3.0.3", afterS)));
    for (const q of res) console.log(q.gapMm, q.overlapMm, q.outcomes);
  }
}, 90000);
