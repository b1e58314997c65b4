/**
 * `npm run test:faults`: a fault in mid-plot over a real pseudo-terminal, 20 random times for each kind on
 * two firmware versions. About half an hour on an idle machine. `npm run test:faults -- 5`: that many times.
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
