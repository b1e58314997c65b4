/** The lock of a data folder: what else may have its name, and a second server. */
import { execFileSync } from "node:child_process";
import { lstatSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { createServer } from "../../../server/index.js";
import { lockDataDir } from "../../../server/storage/data-lock.js";
import { cli } from "../../support/processes/command-line.js";
import { folderOfTest } from "../../support/processes/folders.js";

describe("the lock of a data folder", () => {
  it.skipIf(process.platform === "win32").each([
    ["a folder", (path: string) => mkdirSync(path)],
    ["a named pipe", (path: string) => execFileSync("mkfifo", [path])],
  ])("a data folder is refused in words if %s has the name of its lock, and nothing is moved", (_, make) => {
    const folder = folderOfTest();
    const path = join(folder, "server.lock");
    make(path);
    expect(() => lockDataDir(folder)).toThrow(
      expect.objectContaining({
        code: "bad-setting",
        message: expect.stringMatching(/server\.lock is not a file, .* Rename or remove it/) as string,
      }),
    );
    expect(lstatSync(path).isFile()).toBe(false);
  });

  it("tells a second server where the first one is", async () => {
    const folder = folderOfTest();
    const server = await createServer({ port: 0, device: "virtual", dataDir: folder });
    const second = () => cli("serve", "--device", "virtual", "--data", folder, "--port", "0");
    expect(await second()).toEqual({
      code: 0,
      out: `plotwright is already running: open ${server.url}\n`,
      err: "",
    });
    await server.close();
  });
});
