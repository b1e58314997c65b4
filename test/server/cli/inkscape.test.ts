/** Where `plotwright inkscape install` puts the extension, and what is in it. */
import { mkdirSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { extensionFolders } from "../../../server/cli/inkscape-command.js";
import { ROOT } from "../../../scripts/setup.mjs";
import { cli } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

describe("Inkscape's folder for user extensions", () => {
  const FLATPAK = "/home/a/.var/app/org.inkscape.Inkscape/config/inkscape";

  it.each([
    ["linux", {}, [], ["/home/a/.config/inkscape/extensions"]],
    ["linux", { XDG_CONFIG_HOME: "/c" }, [], ["/c/inkscape/extensions"]],
    ["linux", {}, [FLATPAK], [`${FLATPAK}/extensions`]],
    [
      "linux",
      {},
      [FLATPAK, "/home/a/.config/inkscape"],
      ["/home/a/.config/inkscape/extensions", `${FLATPAK}/extensions`],
    ],
    [
      "darwin",
      {},
      [],
      ["/home/a/Library/Application Support/org.inkscape.Inkscape/config/inkscape/extensions"],
    ],
    ["linux", { INKSCAPE_PROFILE_DIR: "/p" }, [FLATPAK], ["/p/extensions"]],
  ] as const)("on %s with %o, where %j exist, is %j", (platform, env, existing, folders) => {
    const exists = (path: string): boolean => (existing as readonly string[]).includes(path);
    expect(extensionFolders(platform, env, "/home/a", exists)).toEqual(folders);
  });

  it("on Windows is in the user's application data", () => {
    const env = { APPDATA: "C:\\Users\\a\\AppData\\Roaming" };
    expect(extensionFolders("win32", env, "C:\\Users\\a", () => false)).toEqual([
      "C:\\Users\\a\\AppData\\Roaming\\inkscape\\extensions",
    ]);
  });
});

describe("plotwright inkscape", () => {
  it("installs the extension, installs it again, and removes it and nothing else", async () => {
    const folder = join(folderOfTest(), "extensions");
    for (let i = 0; i < 2; i++) {
      const { code, out } = await cli("inkscape", "install", "--folder", folder);
      expect([code, out]).toEqual([0, `${folder} has the extension.\n`]);
    }
    expect(readdirSync(folder).sort()).toEqual(["plotwright.inx", "plotwright.py"]);
    mkdirSync(join(folder, "other"));
    expect((await cli("inkscape", "uninstall", "--folder", folder)).code).toBe(0);
    expect(readdirSync(folder)).toEqual(["other"]);
    const { err } = await cli("inkscape", "uninstall", "--folder", folder);
    expect(err).toContain("The extension is not installed.");
  });

  it("says that a folder can't be written", async () => {
    const { code, err } = await cli("inkscape", "install", "--folder", join(ROOT, "package.json"));
    expect([code, err]).toEqual([2, expect.stringContaining("package.json can't be written")]);
  });
});

it("the extension's dialog has the options that its program takes", () => {
  const read = (name: string): string => readFileSync(join(ROOT, "inkscape", name), "utf8");
  const offered = [...read("plotwright.inx").matchAll(/<param name="(\w+)" type="(\w+)"/g)]
    .filter(([, , type]) => type !== "notebook")
    .map(([, name]) => name);
  const taken = [...read("plotwright.py").matchAll(/add_argument\("--(\w+)"/g)].map(([, name]) => name);
  expect(offered.sort()).toEqual(taken.filter((name) => name !== "id").sort());
  const choices = (name: string): string[] => {
    const [, list = ""] = new RegExp(`"--${name}", choices=\\[(.*?)\\]`).exec(read("plotwright.py")) ?? [];
    return [...list.matchAll(/"(\w+)"/g)].map(([, value]) => value);
  };
  const values = [...read("plotwright.inx").matchAll(/<option value="(\w+)"/g)].map(([, value]) => value);
  expect(values).toEqual([...choices("what"), ...choices("then")]);
});
