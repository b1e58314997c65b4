/**
 * What the single-file executable runs. It unpacks the program once, beside the user's other caches, and starts it from there:
 * threads, the page and the driver of the serial port have to be files.
 */
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import { getRawAsset } from "node:sea";
import { gunzipSync } from "node:zlib";

const MAIN = path.join("node_modules", "plotwright", "dist", "server", "main.js");

const archive = Buffer.from(getRawAsset("program"));
const digest = createHash("sha256").update(archive).digest("hex").slice(0, 16);
const folder = path.join(cacheFolder(), "plotwright", digest);
if (!existsSync(folder)) unpack();
const main = path.join(folder, MAIN);
// A service, and whatever starts the program again, names Node and its script: here both are this file.
const given = process.argv.slice(2);
process.argv = [process.argv[0], main, ...(given[0]?.endsWith(MAIN) ? given.slice(1) : given)];
createRequire(main)("./start.cjs");

function cacheFolder() {
  const { LOCALAPPDATA, XDG_CACHE_HOME } = process.env;
  if (process.platform === "win32") return LOCALAPPDATA ?? path.join(os.homedir(), "AppData", "Local");
  if (process.platform === "darwin") return path.join(os.homedir(), "Library", "Caches");
  return XDG_CACHE_HOME ?? path.join(os.homedir(), ".cache");
}

/** Into another folder that is renamed when it is whole, since the program may be started twice at once. */
function unpack() {
  const draft = `${folder}.${process.pid}`;
  const bytes = gunzipSync(archive);
  const indexEnd = 4 + bytes.readUInt32LE(0);
  let at = indexEnd;
  for (const { name, size } of JSON.parse(bytes.subarray(4, indexEnd).toString("utf8"))) {
    const file = path.join(draft, name);
    mkdirSync(path.dirname(file), { recursive: true });
    writeFileSync(file, bytes.subarray(at, (at += size)));
  }
  try {
    renameSync(draft, folder);
  } catch (error) {
    rmSync(draft, { recursive: true, force: true });
    if (!existsSync(folder)) throw error;
  }
}
