/** Finds a Chromium for the browser tests, and can install one. */
import { spawnSync } from "node:child_process";
import { accessSync, constants, existsSync } from "node:fs";
import path from "node:path";

const PROGRAM_NAMES = [
  "chromium",
  "chromium-browser",
  "google-chrome",
  "google-chrome-stable",
  "chrome",
  "msedge",
];

const PLACES = {
  darwin: [
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
  ],
  win32: ["PROGRAMFILES", "PROGRAMFILES(X86)", "LOCALAPPDATA"].flatMap((folder) => [
    path.join(process.env[folder] ?? "C:\\", "Google\\Chrome\\Application\\chrome.exe"),
    path.join(process.env[folder] ?? "C:\\", "Microsoft\\Edge\\Application\\msedge.exe"),
  ]),
};

function isProgram(file) {
  try {
    accessSync(file, constants.X_OK);
    return true;
  } catch {
    return false;
  }
}

async function browserOfPlaywright() {
  try {
    const { chromium } = await import("playwright-core");
    return chromium.executablePath();
  } catch {
    return "";
  }
}

/** Path of a Chromium, Chrome or Edge, or null. CHROMIUM_PATH in the environment has priority. */
export async function findBrowser() {
  const given = process.env.CHROMIUM_PATH;
  if (given) return existsSync(given) ? given : null;
  const suffix = process.platform === "win32" ? ".exe" : "";
  const onPath = (process.env.PATH ?? "")
    .split(path.delimiter)
    .flatMap((folder) => PROGRAM_NAMES.map((name) => path.join(folder, name + suffix)));
  const candidates = [...onPath, ...(PLACES[process.platform] ?? []), await browserOfPlaywright()];
  return candidates.find((file) => file !== "" && isProgram(file)) ?? null;
}

/** The command that may install system packages without asking for a password, or null. */
function administrator() {
  if (process.getuid?.() === 0) return [];
  return spawnSync("sudo", ["-n", "true"], { stdio: "ignore" }).status === 0 ? ["sudo", "-n"] : null;
}

const hasProgram = (name) => spawnSync(name, ["--version"], { stdio: "ignore" }).status === 0;

function runAs(prefix, command, args) {
  const [program, ...rest] = [...prefix, command, ...args];
  return spawnSync(program, rest, { stdio: "inherit" }).status === 0;
}

/** Debian's Chromium through apt-get if possible, otherwise Playwright's own download. */
export async function installBrowser(playwrightCli) {
  const prefix = process.platform === "linux" && hasProgram("apt-get") ? administrator() : null;
  if (prefix !== null) {
    console.log("plotwright: no browser found for the tests; installing Debian's chromium …");
    runAs(prefix, "apt-get", ["update", "-qq"]);
    runAs(prefix, "apt-get", ["install", "-y", "-qq", "--no-install-recommends", "chromium"]);
    const found = await findBrowser();
    if (found !== null) return found;
  }
  console.log("plotwright: no browser found for the tests; downloading Playwright's chromium …");
  spawnSync(process.execPath, [playwrightCli, "install", "chromium"], { stdio: "inherit" });
  return findBrowser();
}
