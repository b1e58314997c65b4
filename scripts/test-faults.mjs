/**
 * `npm run test:faults`: a fault in mid-plot over a real pseudo-terminal, 20 random times for each kind on
 * two firmware versions, and floods of requests to a server whose board plots. About 40 minutes on an idle machine.
 * `npm run test:faults -- 5`: that many times.
 */
import { checkNode, ensureDependencies, nodeModule, run } from "./setup.mjs";

checkNode();
ensureDependencies();
process.env.PLOTWRIGHT_FAULTS = process.argv[2] ?? "20";
// One after the other: the floods would disturb the other plots.
const codes = ["plot-faults", "attacks"].map((name) =>
  run(process.execPath, [nodeModule("vitest", "vitest.mjs"), "run", `test/serial/${name}.test.ts`]),
);
process.exitCode = Math.max(...codes);
