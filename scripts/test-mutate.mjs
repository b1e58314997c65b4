/**
 * `npm run test:mutate -- AREA [FILE...]`: changes the area's code in many small ways, and runs its tests on each change.
 * A change that no test notices is a survivor. It is printed at once, since an area takes minutes to hours: read the list,
 * and write a test for those that could reach the paper, lose a job or let somebody in. Texts are not changed. Stryker is
 * installed on first use, outside package.json: its 140 packages would slow down every other installation.
 */
import { spawnSync } from "node:child_process";
import { existsSync, writeFileSync, mkdirSync } from "node:fs";

const AREAS = {
  machines: { code: ["src/machines"], tests: ["test/src/machines", "test/src/drivers/ebb/compile"] },
  plan: { code: ["src/plan"], tests: ["test/src/plan"] },
  compile: { code: ["src/drivers/ebb/compile"], tests: ["test/src/drivers/ebb/compile"] },
  queue: { code: ["host/queue"], tests: ["test/host/queue"] },
  security: { code: ["server/security"], tests: ["test/server/security"] },
};
const PACKAGES = ["@stryker-mutator/core@9.6.1", "@stryker-mutator/vitest-runner@9.6.1"];
const FOLDER = "node_modules/.cache/mutate";

/** A reporter of Stryker: its own print the survivors only at the end. */
const SURVIVORS = `
export const strykerPlugins = [{ kind: "Reporter", name: "survivors", factory: () => ({
  onMutantTested({ status, fileName, location: { start }, replacement }) {
    if (!["Killed", "Ignored"].includes(status)) console.log(\`\${status}: \${fileName}:\${start.line}:\${start.column} \${replacement}\`);
  },
}) }];
`;

const area = AREAS[process.argv[2]];
if (area === undefined) {
  console.error(`Name an area: ${Object.keys(AREAS).join(", ")}. Files of it may follow.`);
  process.exit(2);
}
const files = process.argv.slice(3);

const run = (command, ...args) => {
  const { status } = spawnSync(command, args, { stdio: "inherit" });
  if (status !== 0) process.exit(status ?? 1);
};

if (!existsSync("node_modules/@stryker-mutator/vitest-runner")) {
  run("npm", "install", "--no-save", "--no-package-lock", "--no-audit", "--no-fund", ...PACKAGES);
}
mkdirSync(FOLDER, { recursive: true });
const vitestConfig = {
  test: {
    include: area.tests.map((folder) => `${folder}/**/*.test.ts`),
    setupFiles: ["test/support/runs/fixed-seed.ts"],
    // Most changes show in the first cases.
    env: { PLOTWRIGHT_MOST_CASES: "10" },
    testTimeout: 60_000,
  },
};
writeFileSync(`${FOLDER}/vitest.config.mjs`, `export default ${JSON.stringify(vitestConfig)};\n`);
writeFileSync(`${FOLDER}/survivors.mjs`, SURVIVORS);
const strykerConfig = {
  testRunner: "vitest",
  plugins: ["@stryker-mutator/vitest-runner", `./${FOLDER}/survivors.mjs`],
  vitest: { configFile: `${FOLDER}/vitest.config.mjs`, related: false },
  mutate: files.length > 0 ? files : area.code.map((folder) => `${folder}/**/*.ts`),
  mutator: { excludedMutations: ["StringLiteral"] },
  reporters: ["clear-text", "progress-append-only", "survivors"],
  dryRunTimeoutMinutes: 30,
  // A computer with other work is slow: a test counts as hanging only long after that.
  timeoutMS: 30_000,
  timeoutFactor: 3,
  concurrency: 1,
  clearTextReporter: { allowColor: false, reportTests: false, allowEmojis: false },
  tempDirName: `${FOLDER}/sandbox`,
  // Stryker rewrites the paths in tsconfig.json, which it cannot do with TypeScript 7. The tests do not need that.
  tsconfigFile: "none",
};
writeFileSync(`${FOLDER}/stryker.config.json`, JSON.stringify(strykerConfig, null, 2));
run("npx", "stryker", "run", `${FOLDER}/stryker.config.json`);
