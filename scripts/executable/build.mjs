/**
 * Builds plotwright as one file that needs no Node.js, for the system that this runs on: Node's own single executable
 * application. It has Node, and the installed package as an archive (boot.mjs unpacks it).
 *
 *   npm run build:executable [-- FILE]      default: dist/executable/plotwright
 */
import { build } from "esbuild";
import { spawnSync } from "node:child_process";
import {
  chmodSync,
  copyFileSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  readdirSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { ROOT, ensureBuild, giveUp } from "../setup.mjs";

/** By which Node recognises that a program was added to it. */
const FUSE = "NODE_SEA_FUSE_fce680ab2cc467b6e072b8b5df1996b2";
const isMac = process.platform === "darwin";
const suffix = process.platform === "win32" ? ".exe" : "";
const out = path.resolve(process.argv[2] ?? path.join(ROOT, "dist", "executable", `plotwright${suffix}`));

ensureBuild();
const folder = mkdtempSync(path.join(tmpdir(), "plotwright-executable-"));
try {
  install();
  const program = path.join(folder, "program.gz");
  writeFileSync(program, archiveOf(path.join(folder, "app")));
  const config = path.join(folder, "sea.json");
  const blob = path.join(folder, "sea.blob");
  const main = path.join(folder, "boot.cjs");
  const boot = path.join(ROOT, "scripts", "executable", "boot.mjs");
  await build({
    entryPoints: [boot],
    outfile: main,
    bundle: true,
    format: "cjs",
    platform: "node",
    target: "node20",
  });
  const options = { main, output: blob, disableExperimentalSEAWarning: true, assets: { program } };
  writeFileSync(config, JSON.stringify(options));
  run(process.execPath, ["--experimental-sea-config", config]);
  mkdirSync(path.dirname(out), { recursive: true });
  rmSync(out, { force: true });
  copyFileSync(process.execPath, out);
  chmodSync(out, 0o755);
  if (isMac) run("codesign", ["--remove-signature", out]);
  const segment = isMac ? ["--macho-segment-name", "NODE_SEA"] : [];
  const postject = path.join(ROOT, "node_modules", "postject", "dist", "cli.js");
  run(process.execPath, [postject, out, "NODE_SEA_BLOB", blob, "--sentinel-fuse", FUSE, ...segment]);
  if (isMac) run("codesign", ["--sign", "-", out]);
  console.log(`${out}: ${Math.round(statSync(out).size / 1e6)} MB`);
} finally {
  rmSync(folder, { recursive: true, force: true });
}

/** As users install it, without what only another system needs. */
function install() {
  const app = path.join(folder, "app");
  mkdirSync(app);
  writeFileSync(path.join(app, "package.json"), '{ "private": true }');
  run("npm", ["pack", "--ignore-scripts", "--pack-destination", folder], ROOT);
  const packed = readdirSync(folder).find((name) => name.endsWith(".tgz")) ?? "";
  const flags = ["--omit=optional", "--ignore-scripts", "--prefer-offline", "--no-audit", "--no-fund"];
  run("npm", ["install", ...flags, path.join(folder, packed)], app);
  const drivers = path.join(app, "node_modules", "@serialport", "bindings-cpp", "prebuilds");
  for (const name of readdirSync(drivers)) {
    const [system = "", processors = ""] = name.split("-");
    const isOwn = system === process.platform && processors.split("+").includes(process.arch);
    if (!isOwn) rmSync(path.join(drivers, name), { recursive: true });
  }
  // The executable can only require, and the program is an ES module.
  const server = path.join(app, "node_modules", "plotwright", "dist", "server");
  writeFileSync(path.join(server, "start.cjs"), 'void import("./main.js");\n');
}

/** The length of the index, the index as JSON, and the files one after another; compressed. */
function archiveOf(app) {
  const files = readdirSync(app, { recursive: true, encoding: "utf8" })
    .filter(
      (name) =>
        !/(^|[\\/])\.bin[\\/]|\.(map|d\.[cm]?ts)$/.test(name) && statSync(path.join(app, name)).isFile(),
    )
    .sort()
    .map((name) => ({ name: name.replaceAll("\\", "/"), bytes: readFileSync(path.join(app, name)) }));
  const index = Buffer.from(JSON.stringify(files.map(({ name, bytes }) => ({ name, size: bytes.length }))));
  const length = Buffer.alloc(4);
  length.writeUInt32LE(index.length);
  return gzipSync(Buffer.concat([length, index, ...files.map(({ bytes }) => bytes)]), { level: 9 });
}

function run(command, args, cwd = folder) {
  const shell = command === "npm" && process.platform === "win32";
  const { status, stdout, stderr, error } = spawnSync(command, args, { cwd, encoding: "utf8", shell });
  if (status !== 0)
    giveUp(`${command} ${args[0]} failed: ${error?.message ?? ""}${stdout ?? ""}${stderr ?? ""}`);
}
