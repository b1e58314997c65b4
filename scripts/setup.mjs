/**
 * The first step of `npm start` and `npm test`: checks the version of Node, installs the packages and builds dist/. It
 * runs before anything is installed, so it uses nothing but Node itself.
 */
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import {
  accessSync,
  constants,
  existsSync,
  mkdirSync,
  readFileSync,
  readdirSync,
  writeFileSync,
} from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

export const ROOT = fileURLToPath(new URL("..", import.meta.url));
const inRoot = (...parts) => path.join(ROOT, ...parts);

const OLDEST_NODE = [20, 19];

/** Prints advice and ends the process: for faults that only the user can fix. */
export function giveUp(message, exitCode = 1) {
  console.error(`\nplotwright: ${message}`);
  process.exit(exitCode);
}

/** Options of `serve` that npm does not have. (It has its own --cert and --key, which may be in its settings.) */
const SERVE_OPTIONS = [
  ...["device", "virtual-speed", "virtual-springs", "data", "port", "host", "lan", "mdns", "pair-always"],
  ...["allow-host", "allow-origin", "watch", "shared-queue", "mqtt", "max-upload-mb", "open"],
];

/** Without `--`, as in `npm start --port 9381`, npm takes an option and passes it only in the environment. */
export const optionsTakenByNpm = (env) =>
  SERVE_OPTIONS.filter((name) => env[`npm_config_${name.replaceAll("-", "_")}`] !== undefined).map(
    (name) => `--${name}`,
  );

export function checkNode() {
  const [major = 0, minor = 0] = process.versions.node.split(".").map(Number);
  if (major > OLDEST_NODE[0] || (major === OLDEST_NODE[0] && minor >= OLDEST_NODE[1])) return;
  giveUp(
    `this is Node ${process.versions.node}, and plotwright needs ${OLDEST_NODE.join(".")} or newer.\n` +
      "Get it from https://nodejs.org (the LTS version), or with a version manager such as nvm: nvm install --lts",
  );
}

/** Runs a program in the project's folder with its output shown; returns its exit code. */
export function run(command, args, options = {}) {
  const result = spawnSync(command, args, { cwd: ROOT, stdio: "inherit", ...options });
  if (result.error) throw result.error;
  // Captured output is shown only after a failure.
  if (result.status !== 0)
    for (const text of [result.stdout, result.stderr]) process.stderr.write(text ?? "");
  return result.status ?? 1;
}

/** Runs npm, also on Windows, where npm is a .cmd file that only a shell can start. */
export function runNpm(args, options = {}) {
  const npmScript = process.env.npm_execpath;
  if (npmScript && /npm-cli\.c?js$/.test(npmScript))
    return run(process.execPath, [npmScript, ...args], options);
  return run("npm", args, { shell: process.platform === "win32", ...options });
}

/** A program of node_modules by its script, so that no shell and no .cmd file is needed. */
export const nodeModule = (...parts) => inRoot("node_modules", ...parts);

const readJson = (file) => JSON.parse(readFileSync(file, "utf8"));

/** npm records in node_modules/.package-lock.json what it installed; that is compared with package-lock.json. */
function installedIsCurrent() {
  const noteFile = nodeModule(".package-lock.json");
  if (!existsSync(noteFile)) return false;
  const installed = readJson(noteFile).packages ?? {};
  const wanted = readJson(inRoot("package-lock.json")).packages ?? {};
  return Object.entries(wanted).every(
    ([name, entry]) => name === "" || entry.optional || installed[name]?.version === entry.version,
  );
}

/** Packages and the build are stored beside the sources. */
function mustBeWritable() {
  try {
    accessSync(ROOT, constants.W_OK);
  } catch {
    giveUp(
      `${ROOT} can't be written to, so packages and the build can't be stored.\n` +
        "Change its permissions, or copy the folder to a place of your own.",
    );
  }
}

/** Without a network connection, npm gives up after 13 s. By default it tries for over a minute, silently. */
const RETRIES = ["--fetch-retries=3", "--fetch-retry-mintimeout=1000", "--fetch-retry-factor=3"];

export function ensureDependencies() {
  if (installedIsCurrent()) return;
  mustBeWritable();
  console.log("plotwright: installing packages (npm ci) …");
  if (runNpm(["ci", "--include=dev", "--no-audit", "--no-fund", ...RETRIES]) !== 0) {
    giveUp(
      "npm ci failed; its message is above. Is there a network connection? Then run the same command again.",
    );
  }
}

const BUILD_INPUTS = [
  "src",
  "host",
  "server",
  "web",
  "scripts/bundle.mjs",
  "scripts/licences.mjs",
  "scripts/licences",
  "tsconfig.json",
  "package.json",
  "package-lock.json",
];

function* filesBelow(relative) {
  if (!existsSync(inRoot(relative))) return;
  if (/\.\w+$/.test(relative)) {
    yield relative;
    return;
  }
  for (const entry of readdirSync(inRoot(relative), { withFileTypes: true })) {
    const child = path.join(relative, entry.name);
    if (entry.isDirectory()) yield* filesBelow(child);
    else yield child;
  }
}

const SITE_INPUTS = [
  ...BUILD_INPUTS,
  "docs",
  "scripts/build-site.ts",
  "scripts/site",
  "ARCHITECTURE.md",
  "CHANGELOG.md",
  "CONTRIBUTING.md",
];

/** One hash over the names and contents of all files that the build reads. */
function stampOf(inputs) {
  const hash = createHash("sha256");
  for (const file of inputs.flatMap((input) => [...filesBelow(input)]).sort()) {
    hash
      .update(file)
      .update("\0")
      .update(readFileSync(inRoot(file)))
      .update("\0");
  }
  return hash.digest("hex");
}

/** Calls `build`, which fills `folder`, unless the folder was built from the same content of all `inputs`. */
function buildOnce(folder, inputs, build) {
  const stampFile = path.join(folder, ".stamp");
  const stamp = stampOf(inputs);
  if (existsSync(stampFile) && readFileSync(stampFile, "utf8") === stamp) return;
  mustBeWritable();
  build();
  mkdirSync(folder, { recursive: true });
  writeFileSync(stampFile, stamp);
}

/** With the NODE_ENV of a test runner, the build would contain React's development version. */
const forProduction = () => ({
  env: { ...process.env, NODE_ENV: "production" },
  stdio: "pipe",
  maxBuffer: 100e6,
});

export function ensureBuild() {
  buildOnce(inRoot("dist"), BUILD_INPUTS, () => {
    console.log("plotwright: building …");
    if (runNpm(["run", "--silent", "build"], forProduction()) === 0) return;
    giveUp("the build failed; its message is above. In an unmodified checkout this is a bug in plotwright.");
  });
}

/** Where tests find the web site, which has the page without a server in app/, and the site's path on a host. */
export const TEST_SITE = {
  folder: inRoot("dist", ".test-site"),
  base: "/plots/",
  source: "https://git.example.org/plotwright",
};

export function ensureTestSite() {
  const { folder, base, source } = TEST_SITE;
  buildOnce(folder, SITE_INPUTS, () => {
    console.log("plotwright: building the web site for the tests …");
    const script = [nodeModule("tsx", "dist", "cli.mjs"), inRoot("scripts", "build-site.ts")];
    const options = ["--out", folder, "--base", base, "--source", source];
    if (run(process.execPath, [...script, ...options], forProduction()) === 0) return;
    giveUp("the web site could not be built; the message is above.");
  });
}
