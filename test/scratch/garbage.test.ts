import { it } from "vitest";
import { plotting, seeded } from "../support/live-plot.js";
import { FAULT_DRAWING } from "../support/faulty-plots.js";
import { strokesOf } from "../support/local-planner.js";
const LONG = strokesOf([10, 10, 250, 10, 250, 20, 10, 20, 10, 30, 250, 30], ...Array.from({length: 6}, (_, i) => [10, 40 + i, 60, 40 + i]));
const TOKENS = ["OK\r\n", "1E\r\n", "0F\r\n", "12,34\n\r", "394,300\r\n", "QM,0,0,0,0\n\r", "QU,6,3\r\n", "7\r\n", "1", "\r\n", "OK", "x%", ","];
const soup = (r: () => number) => {
  const kind = process.env.KIND ?? "soup";
  if (kind === "ok") return Buffer.from("OK\r\n");
  if (kind === "hex") return Buffer.from("3E\r\n");
  let t = "";
  while (t.length < 300) t += TOKENS[Math.floor(r() * TOKENS.length)];
  return Buffer.from(t.slice(0, 300));
};
it("garbage", async () => {
  const out: string[] = [];
  const bad: Record<string, number> = {};
  for (const [dn, d] of [["F", FAULT_DRAWING], ["L", LONG]] as const)
  for (const fw of ["2.8.1", "3.0.3"]) for (const mode of ["blend", "junction"] as const) for (let seed = 1; seed <= Number(process.env.SEEDS ?? 60); seed++) {
    const r = seeded(seed * 1000003 % 2147483647);
    r();
    const p = await plotting(mode, d, fw);
    const at = 0.3 + 7 * r();
    p.world.after(at, () => p.board.sendGarbage(soup(r)));
    const o = await p.world.run(p.run.finished.then(() => "done", (e: Error) => e.message));
    const s = p.board.statistics();
    if (o !== "done") bad[o.slice(0, 17)] = (bad[o.slice(0, 17)] ?? 0) + 1;
    if (s.underrunCount > 0) out.push([dn, fw, mode, seed, at.toFixed(2), o, s.underrunCount, s.underrunS.toFixed(3), s.longestUnderrunS.toFixed(3), p.world.nowS().toFixed(2)].join(" "));
    await p.driver.close();
  }
  console.log(out.join("\n"), bad);
});
