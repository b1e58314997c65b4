/**
 * Files with any part of the settings: the one that always applies, and the one of --config. `plotwright settings set`
 * changes the first.
 */
import { mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { dirname, join } from "node:path";
import { PlotwrightError } from "../../src/index.js";
import { firstFault, givenSettingsSchema, type GivenSettings } from "../../src/schema/index.js";
import { fileFault } from "../storage/file-fault.js";
import { readText } from "./files.js";

/** $XDG_CONFIG_HOME/plotwright/config.json, else in ~/.config; on Windows in %APPDATA%. */
export function usualConfigPath(
  env: NodeJS.ProcessEnv = process.env,
  platform: NodeJS.Platform = process.platform,
): string {
  const base = [env["XDG_CONFIG_HOME"], platform === "win32" ? env["APPDATA"] : undefined].find(
    (one) => one !== undefined && one !== "",
  );
  return join(base ?? join(homedir(), ".config"), "plotwright", "config.json");
}

/** The settings in the file that always applies; without one, none. Errors name the file. */
export function readUsualConfig(): GivenSettings {
  const path = usualConfigPath();
  const text = textOf(path);
  return text === null ? {} : checked(path, parsed(path, text));
}

/** The settings in a file of --config, or in stdin for "-". */
export const readConfig = (path: string): GivenSettings =>
  fromFile("--config", path, (text) => checked(`--config ${path}`, JSON.parse(text)));

/** Reads a JSON file; an error names the option and the file. */
export function fromFile<T>(
  option: "--config" | "--machine-file",
  path: string,
  read: (text: string) => T,
): T {
  try {
    return read(readText(path, option));
  } catch (cause) {
    if (cause instanceof PlotwrightError) throw cause;
    throw fault(`${option} ${path}`, cause);
  }
}

/**
 * Changes the file that always applies. `change` gets its object, or an empty one. Settings that are not allowed are
 * refused, and the file stays as it is.
 */
export function changeUsualConfig(change: (config: Record<string, unknown>) => void): GivenSettings {
  const path = usualConfigPath();
  const text = textOf(path);
  const before: unknown = text === null ? {} : parsed(path, text);
  checked(path, before);
  const config = structuredClone(before) as Record<string, unknown>;
  change(config);
  const settings = checked("", config);
  try {
    mkdirSync(dirname(path), { recursive: true, mode: 0o700 });
    // Written under another name and renamed, so that the file is never incomplete.
    writeFileSync(`${path}.new`, `${JSON.stringify(config, null, 2)}\n`, { flush: true });
    renameSync(`${path}.new`, path);
  } catch (cause) {
    throw new PlotwrightError("bad-setting", `${path} can't be written: ${fileFault(cause)}.`, { cause });
  }
  return settings;
}

/** Null if there is no file. */
function textOf(path: string): string | null {
  try {
    return readFileSync(path, "utf8");
  } catch (cause) {
    if ((cause as NodeJS.ErrnoException).code === "ENOENT") return null;
    throw fault(path, cause);
  }
}

function parsed(path: string, text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (cause) {
    throw fault(path, cause);
  }
}

const fault = (where: string, cause: unknown): PlotwrightError =>
  new PlotwrightError(
    "bad-setting",
    `${where}: ${cause instanceof SyntaxError ? `it is not JSON (${cause.message})` : fileFault(cause)}.`,
    { cause },
  );

/** Any part of the settings may be there. An unknown name is an error. */
function checked(where: string, value: unknown): GivenSettings {
  const at = where === "" ? "" : `${where}: `;
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    throw new PlotwrightError("bad-setting", `${at}it is not a JSON object.`);
  }
  const result = givenSettingsSchema.safeParse(value);
  if (result.success) return result.data;
  const { path, words } = firstFault(result.error);
  throw new PlotwrightError("bad-setting", `${at}${path}: ${words}.`);
}
