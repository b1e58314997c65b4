/** `plotwright inkscape install`: puts the extension that sends drawings to plotwright into Inkscape's menu. */
import { copyFileSync, existsSync, mkdirSync, rmSync } from "node:fs";
import { homedir } from "node:os";
import { join, posix, win32 } from "node:path";
import type { Command } from "commander";
import { PlotwrightError } from "../../src/index.js";
import { fileFault } from "../storage/file-fault.js";
import { packagePath } from "../storage/package-files.js";
import { printed } from "./io.js";
import type { Declare } from "./options.js";

const FILES = ["plotwright.inx", "plotwright.py"];

interface InkscapeOptions {
  readonly folder?: string;
}

export const declareInkscape: Declare = (inkscape, { io }) => {
  const sub = (name: string, about: string): Command =>
    inkscape
      .command(name)
      .description(about)
      .copyInheritedSettings(inkscape)
      .option("--folder <folder>", "Inkscape's folder for user extensions (default: where Inkscape has it)");
  sub("install", "add plotwright to the menu Extensions, Export").action(({ folder }: InkscapeOptions) => {
    for (const to of foldersOf(folder)) {
      copyTo(to);
      io.out(printed`${to} has the extension.\n`);
    }
    io.err("Start Inkscape again. The extension is in the menu Extensions, Export, plotwright.\n");
  });
  sub("uninstall", "remove it").action(({ folder }: InkscapeOptions) => {
    const installed = foldersOf(folder).filter((one) => FILES.some((file) => existsSync(join(one, file))));
    if (installed.length === 0) throw new PlotwrightError("not-found", "The extension is not installed.");
    for (const from of installed) {
      for (const file of FILES) rmSync(join(from, file), { force: true });
      io.out(printed`${from} no longer has the extension.\n`);
    }
  });
};

function copyTo(folder: string): void {
  try {
    mkdirSync(folder, { recursive: true });
    for (const file of FILES) copyFileSync(packagePath(`inkscape/${file}`), join(folder, file));
  } catch (cause) {
    throw new PlotwrightError("bad-setting", `${folder} can't be written: ${fileFault(cause)}.`, { cause });
  }
}

const foldersOf = (given: string | undefined): readonly string[] =>
  given === undefined ? extensionFolders(process.platform, process.env, homedir(), existsSync) : [given];

/**
 * The folders for user extensions of the Inkscapes that were started before, or else the usual one. A snap has the usual one
 * too.
 */
export function extensionFolders(
  platform: NodeJS.Platform,
  env: NodeJS.ProcessEnv,
  home: string,
  exists: (path: string) => boolean,
): readonly string[] {
  const at = platform === "win32" ? win32.join : posix.join;
  const set = (name: string): string | null =>
    env[name] === undefined || env[name] === "" ? null : env[name];
  const own = set("INKSCAPE_PROFILE_DIR");
  if (own !== null) return [at(own, "extensions")];
  const [usual, ...others] =
    platform === "win32"
      ? [at(set("APPDATA") ?? at(home, "AppData", "Roaming"), "inkscape")]
      : platform === "darwin"
        ? [at(home, "Library", "Application Support", "org.inkscape.Inkscape", "config", "inkscape")]
        : [
            at(set("XDG_CONFIG_HOME") ?? at(home, ".config"), "inkscape"),
            at(home, ".var", "app", "org.inkscape.Inkscape", "config", "inkscape"),
          ];
  const found = [usual, ...others].filter(exists);
  return (found.length === 0 ? [usual] : found).map((profile) => at(profile, "extensions"));
}
