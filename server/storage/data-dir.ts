/** The folder in which a server stores its jobs. Only one running server at a time may use it. */
import { homedir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { accessSync, constants, existsSync, mkdirSync } from "node:fs";
import { PlotwrightError } from "../../src/index.js";
import { fileFault } from "./file-fault.js";

/** $XDG_DATA_HOME/plotwright, else ~/.local/share/plotwright. */
export function defaultDataDir(env: NodeJS.ProcessEnv = process.env): string {
  const base = env["XDG_DATA_HOME"];
  return join(base !== undefined && base !== "" ? base : join(homedir(), ".local", "share"), "plotwright");
}

/**
 * Creates the folder (readable by its owner only); throws `bad-setting` if that fails or it is not writable.
 */
export function prepareDataDir(dir: string): void {
  const drawings = makeDataFolder(dir, "drawings");
  try {
    for (const folder of [dir, drawings])
      accessSync(folder, constants.R_OK | constants.W_OK | constants.X_OK);
  } catch (cause) {
    throw new PlotwrightError(
      "bad-setting",
      `The data folder ${dir} can't be written to. Change its permissions, or choose another folder with --data.`,
      { cause },
    );
  }
}

/** Creates a folder in the data folder, and returns its path; throws `bad-setting` if that fails. */
export function makeDataFolder(dir: string, ...names: readonly string[]): string {
  const folder = resolve(dir, ...names);
  try {
    makeFolder(folder);
  } catch (cause) {
    const why =
      (cause as NodeJS.ErrnoException).code === "ENOENT" ? "no folder can be made there" : fileFault(cause);
    throw new PlotwrightError(
      "bad-setting",
      `The data folder ${dir} can't be created: ${why}. Choose another one with --data.`,
      { cause },
    );
  }
  return folder;
}

/** Creates each folder separately, because mkdir with "recursive" never returns below /proc. */
function makeFolder(path: string): void {
  if (existsSync(path)) return;
  makeFolder(dirname(path));
  mkdirSync(path, { mode: 0o700 });
}
