/** Where a server keeps its jobs: one folder, owned by one running server at a time. */
import { homedir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { accessSync, constants, existsSync, mkdirSync } from "node:fs";
import { PlotwrightError } from "../src/index.js";

/** $XDG_DATA_HOME/plotwright, else ~/.local/share/plotwright. */
export function defaultDataDir(env: NodeJS.ProcessEnv = process.env): string {
  const base = env["XDG_DATA_HOME"];
  return join(base !== undefined && base !== "" ? base : join(homedir(), ".local", "share"), "plotwright");
}

/** Makes the folder (readable by its owner only); throws `bad-setting` when it can't, or can't write there. */
export function prepareDataDir(dir: string): void {
  const drawings = resolve(dir, "drawings");
  try {
    makeFolder(drawings);
  } catch (cause) {
    throw new PlotwrightError(
      "bad-setting",
      `The data folder ${dir} can't be made (${(cause as Error).message}). Choose another one with --data.`,
      { cause },
    );
  }
  try {
    for (const folder of [dir, drawings])
      accessSync(folder, constants.R_OK | constants.W_OK | constants.X_OK);
  } catch (cause) {
    throw new PlotwrightError(
      "bad-setting",
      `The data folder ${dir} can't be written to: change who may write there, or choose another folder with --data.`,
      { cause },
    );
  }
}

/** One folder after the other: below /proc, mkdir with "recursive" never returns. */
function makeFolder(path: string): void {
  if (existsSync(path)) return;
  makeFolder(dirname(path));
  mkdirSync(path, { mode: 0o700 });
}
