/** What else may have the name of the data folder's lock. */
import { execFileSync } from "node:child_process";
import { lstatSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { afterEach, describe, expect, it } from "vitest";
import { lockDataDir } from "../../server/storage/data-lock.js";
import { temporaryFolder } from "../support/server-process.js";

const undo: (() => unknown)[] = [];
afterEach(() => undo.splice(0).forEach((step) => step()));

describe("the lock of a data folder", () => {
  it.skipIf(process.platform === "win32").each([
    ["a folder", (path: string) => mkdirSync(path)],
    ["a named pipe", (path: string) => execFileSync("mkfifo", [path])],
  ])("whose name %s has is refused in words, and nothing is moved", (_, make) => {
    const folder = temporaryFolder("lock");
    undo.push(folder.remove);
    const path = join(folder.path, "server.lock");
    make(path);
    expect(() => lockDataDir(folder.path)).toThrow(
      expect.objectContaining({
        code: "bad-setting",
        message: expect.stringMatching(/server\.lock is not a file, .* Rename or remove it/) as string,
      }),
    );
    expect(lstatSync(path).isFile()).toBe(false);
  });
});
