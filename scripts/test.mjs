/**
 * `npm test`: everything that must hold, from a fresh clone on. Ends with "N passed, N failed".
 *
 *   npm test                       types, lint, format, package, and all tests, in real Chromium too
 *   npm test -- test/unit/plan     only these tests
 */
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { findBrowser, installBrowser } from "./find-browser.mjs";
import { checkNode, ensureBuild, ensureDependencies, nodeModule, run } from "./setup.mjs";

const CHECKS = [
  ...["src", "server", "web", "test", "scripts"].map((folder) => ({
    name: `types of ${folder}`,
    args: [nodeModule("typescript", "bin", "tsc"), "-p", `${folder}/tsconfig.json`],
  })),
  { name: "lint", args: [nodeModule("eslint", "bin", "eslint.js"), ".", "--max-warnings", "0"] },
  {
    name: "format",
    args: [nodeModule("prettier", "bin", "prettier.cjs"), "--check", "--log-level", "warn", "."],
  },
  { name: "package (publint)", args: [nodeModule("publint", "src", "cli.js"), "--strict"] },
];

/** `alone`: tests with a real clock, a browser or a process of their own, one file at a time. */
const TEST_RUNS = [
  { name: "together", args: [] },
  { name: "alone", args: ["--maxWorkers=1"] },
];

const failures = [];
let passedCount = 0;
let failedCount = 0;

function fail(what, count = 1) {
  failedCount += count;
  failures.push(what);
}

function runCheck({ name, args }) {
  const startedAt = Date.now();
  const code = run(process.execPath, args);
  console.log(`${code === 0 ? "✓" : "✗"} ${name} (${((Date.now() - startedAt) / 1000).toFixed(1)} s)`);
  if (code === 0) passedCount++;
  else fail(name);
}

function runTests({ name, args }, filters, folder) {
  const resultFile = path.join(folder, `${name}.json`);
  const code = run(process.execPath, [
    nodeModule("vitest", "vitest.mjs"),
    "run",
    "--project",
    name,
    "--passWithNoTests",
    "--reporter=default",
    "--reporter=json",
    `--outputFile.json=${resultFile}`,
    ...args,
    ...filters,
  ]);
  countTests(name, code, resultFile);
}

/** Adds up vitest's own report. A file that could not even be loaded has no tests in it, so it counts as one failure. */
function countTests(name, code, resultFile) {
  let report;
  try {
    report = JSON.parse(readFileSync(resultFile, "utf8"));
  } catch {
    fail(`tests (${name}) ended with code ${code} and left no report`);
    return;
  }
  passedCount += report.numPassedTests;
  const before = failedCount;
  for (const file of report.testResults) {
    const failed = file.assertionResults.filter((test) => test.status === "failed");
    for (const test of failed) fail(`${path.relative(process.cwd(), file.name)}: ${test.fullName}`);
    if (failed.length === 0 && file.status === "failed") {
      fail(`${path.relative(process.cwd(), file.name)}: ${file.message}`);
    }
  }
  if (code !== 0 && failedCount === before) fail(`tests (${name}): an error outside any test, see above`);
}

async function findOrInstallBrowser() {
  const browser = (await findBrowser()) ?? (await installBrowser(nodeModule("playwright-core", "cli.js")));
  if (browser !== null) {
    process.env.CHROMIUM_PATH = browser;
    return;
  }
  console.error(
    "plotwright: the browser tests need Chromium, Chrome or Edge, and none was found.\n" +
      "Install one (on Debian: sudo apt-get install chromium), or set CHROMIUM_PATH to its program file.",
  );
}

checkNode();
const filters = process.argv.slice(2);
ensureDependencies();
await findOrInstallBrowser();
ensureBuild();

if (filters.length === 0) for (const check of CHECKS) runCheck(check);
const folder = mkdtempSync(path.join(tmpdir(), "plotwright-test-"));
try {
  for (const testRun of TEST_RUNS) runTests(testRun, filters, folder);
} finally {
  rmSync(folder, { recursive: true, force: true });
}

if (failures.length > 0) console.log(`\nFailed:\n${failures.map((what) => `  ${what}`).join("\n")}`);
console.log(`\n${passedCount} passed, ${failedCount} failed`);
process.exitCode = failedCount === 0 && passedCount > 0 ? 0 : 1;
