/** Where a server keeps its jobs: one folder, owned by one running server at a time. */
import { homedir } from "node:os";
import { join } from "node:path";
import { mkdirSync } from "node:fs";
import { PlotwrightError } from "../src/index.js";

/** $XDG_DATA_HOME/plotwright, else ~/.local/share/plotwright. */
export function defaultDataDir(env: NodeJS.ProcessEnv = process.env): string {
  const base = env["XDG_DATA_HOME"];
  return join(base !== undefined && base !== "" ? base : join(homedir(), ".local", "share"), "plotwright");
}

/** Makes the folder (readable by its owner only); throws `bad-setting` when it can't. */
export function prepareDataDir(dir: string): void {
  try {
    mkdirSync(join(dir, "drawings"), { recursive: true, mode: 0o700 });
  } catch (cause) {
    throw new PlotwrightError(
      "bad-setting",
      `The data folder ${dir} can't be made (${(cause as Error).message}). Choose another one with --data.`,
      { cause },
    );
  }
}
