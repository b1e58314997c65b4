/**
 * `npm run test:matrix`: every sample on every firmware in every mode, against the board's guarantees. Takes
 * minutes. `npm run test:matrix -- 2.4.4`: the same for one firmware. Prints the table of docs/ebb.md at the
 * end.
 */
import { checkNode, ensureDependencies, nodeModule, run } from "./setup.mjs";

checkNode();
ensureDependencies();
process.env.PLOTWRIGHT_MATRIX = process.argv[2] ?? "all";
process.exitCode = run(process.execPath, [
  nodeModule("vitest", "vitest.mjs"),
  "run",
  "test/src/drivers/ebb/virtual/plot-matrix.test.ts",
]);
