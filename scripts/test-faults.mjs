/**
 * `npm run test:faults`: a fault in mid-plot over a real pseudo-terminal, 20 random instants of each kind on two
 * firmwares. About half an hour on a machine with nothing else to do. `npm run test:faults -- 5`: so many instants.
 */
import { checkNode, ensureDependencies, nodeModule, run } from "./setup.mjs";

checkNode();
ensureDependencies();
process.env.PLOTWRIGHT_FAULTS = process.argv[2] ?? "20";
process.exitCode = run(process.execPath, [
  nodeModule("vitest", "vitest.mjs"),
  "run",
  "test/serial/plot-faults.test.ts",
]);
