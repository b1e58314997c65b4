/**
 * `npm test`: all checks and tests, also in a fresh clone. Ends with "N passed, N failed".
 *
 *   npm test                       types, lint, format, package, and every test, in real Chromium too: some minutes
 *   npm run test:full              the same with all cases, firmware, kills, faults and page states: about an hour
 *   npm test -- test/src/plan     only these tests
 */
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { setPriority, tmpdir } from "node:os";
import path from "node:path";
import { findBrowser, installBrowser } from "./find-browser.mjs";
import { failedFiles, failuresIn, passedCountIn, readReport, withSecondAttempt } from "./test-report.mjs";
import { ROOT, checkNode, ensureBuild, ensureDependencies, nodeModule } from "./setup.mjs";

const typesOf = (folder) => [nodeModule("typescript", "bin", "tsc"), "-p", `${folder}/tsconfig.json`];

const CHECKS = [
  {
    name: "format",
    args: [nodeModule("prettier", "bin", "prettier.cjs"), "--check", "--log-level", "warn", "."],
  },
  { name: "lint", args: [nodeModule("oxlint", "bin", "oxlint"), "--deny-warnings"] },
  // One program with all code, and one without the types of Node and DOM. The build checks server without DOM; the lint
  // rules keep Node out of web.
  { name: "types", args: typesOf("test") },
  { name: "types of src and host", args: typesOf("host") },
  { name: "package (publint)", args: [nodeModule("publint", "src", "cli.js"), "--strict"] },
];

/** The lowest, so that the tests that run at the same time respond in time. */
const CHECKS_PRIORITY = 19;
const HAS_PSEUDO_TERMINALS = process.platform !== "win32";

/** The projects of vitest.config.ts that run at the same time. Each of the others runs by itself. */
const SHARED_RUN = ["together", "commands", "processes"];

/**
 * Only the tests in a real browser get a second attempt, which the end of the output shows. Their whole files run again,
 * because many of their tests build on each other.
 */
const mayRunAgain = (file) => file.startsWith("test/e2e/");
/** If more files fail, it is probably not by chance. */
const MAX_FILES_AGAIN = 3;

const failures = [];
const passedLater = [];
let passedCount = 0;
let failedCount = 0;

function fail(what, count = 1) {
  failedCount += count;
  failures.push(what);
}

/**
 * Runs a Node program in the project's folder; returns its exit code. `isBackground`: at a lower priority, and
 * its output is shown when it ends.
 */
function runNode(args, isBackground) {
  return new Promise((resolve, reject) => {
    const child = spawn(process.execPath, args, { cwd: ROOT, stdio: isBackground ? "pipe" : "inherit" });
    if (isBackground && child.pid !== undefined) setPriority(child.pid, CHECKS_PRIORITY);
    let output = "";
    for (const stream of [child.stdout, child.stderr]) stream?.on("data", (chunk) => (output += chunk));
    child.once("error", reject);
    child.once("close", (code) => {
      process.stdout.write(output);
      resolve(code ?? 1);
    });
  });
}

async function runChecks() {
  for (const { name, args } of CHECKS) {
    const startedAt = Date.now();
    const code = await runNode(args, true);
    console.log(`${code === 0 ? "✓" : "✗"} ${name} (${((Date.now() - startedAt) / 1000).toFixed(1)} s)`);
    if (code === 0) passedCount++;
    else fail(name);
  }
}

/** Runs these files of projects of vitest.config.ts, or all of them. */
async function runVitest(projects, filters, resultFile) {
  const args = ["run", ...projects.map((name) => `--project=${name}`), "--passWithNoTests"];
  const reports = ["--reporter=default", "--reporter=json", `--outputFile.json=${resultFile}`];
  const vitest = [nodeModule("vitest", "vitest.mjs"), ...args, ...reports];
  const code = await runNode([...vitest, ...filters], false);
  return { code, report: readReport(resultFile) };
}

async function runTests(projects, filters, folder) {
  const name = projects.join("-");
  let { code, report } = await runVitest(projects, filters, path.join(folder, `${name}.json`));
  const again = report === null || filters.length > 0 ? [] : failedFiles(report).filter(mayRunAgain);
  if (again.length > 0 && again.length <= MAX_FILES_AGAIN) {
    console.log(`Second attempt: ${again.join(", ")}`);
    const second = await runVitest(projects, again, path.join(folder, `${name}-again.json`));
    if (second.report !== null) {
      const before = failuresIn(report);
      report = withSecondAttempt(report, second.report);
      const failed = failuresIn(report);
      passedLater.push(...before.filter((what) => !failed.includes(what)));
      if (failed.length === 0) code = second.code;
    }
  }
  count(name, code, report);
}

function count(name, code, report) {
  if (report === null) {
    fail(`tests (${name}) ended with code ${code} and left no report`);
    return;
  }
  passedCount += passedCountIn(report);
  const failed = failuresIn(report);
  for (const what of failed) fail(what);
  if (code !== 0 && failed.length === 0) fail(`tests (${name}): an error outside any test, see above`);
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
const FULL = "--full";
if (process.argv.includes(FULL)) process.env.PLOTWRIGHT_FULL = "1";
const filters = process.argv.slice(2).filter((argument) => argument !== FULL);
ensureDependencies();
await findOrInstallBrowser();
ensureBuild();

const folder = mkdtempSync(path.join(tmpdir(), "plotwright-test-"));
try {
  await runTests(SHARED_RUN, filters, folder);
  // The tests in real time mostly wait, so the checks take no time from them.
  const checks = filters.length === 0 ? runChecks() : Promise.resolve();
  if (HAS_PSEUDO_TERMINALS) await runTests(["real-time"], filters, folder);
  await checks;
  if (HAS_PSEUDO_TERMINALS) await runTests(["load"], filters, folder);
  else {
    console.log(
      "Left out on Windows, which has no pseudo-terminals and no signals: POSIX_ONLY in vitest.config.ts",
    );
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}

const list = (title, tests) => console.log(`\n${title}:\n${tests.map((what) => `  ${what}`).join("\n")}`);
if (passedLater.length > 0) list("Passed at the second attempt", passedLater);
if (failures.length > 0) list("Failed", failures);
console.log(`\n${passedCount} passed, ${failedCount} failed`);
process.exitCode = failedCount === 0 && passedCount > 0 ? 0 : 1;
