/** The settings and plotters of whoever runs the tests do not reach the programs that tests start. */
import { spawnSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { spawn } from "@lydell/node-pty";
import { expect, it } from "vitest";
import { Store } from "../../server/storage/store.js";
import { ROOT } from "../../scripts/setup.mjs";
import { folderOfTest } from "../support/processes/folders.js";

/** Of a user who has an A3 machine and wide margins. */
function homeOfUser(): string {
  const home = folderOfTest();
  const [config, data] = [".config/plotwright", ".local/share/plotwright"].map((name) => join(home, name));
  for (const folder of [config, data]) mkdirSync(folder, { recursive: true });
  writeFileSync(join(config, "config.json"), JSON.stringify({ prepare: { marginMm: 77 } }));
  const store = Store.open(data);
  store.savePlotter({ id: "main", name: "Big", device: "auto", machine: "axidraw-v3-a3" });
  store.close();
  return home;
}

const ARGS = [join(ROOT, "dist/server/main.js"), "settings", "show", "machine", "margin"];
const DEFAULTS = "machine\taxidraw-v3\tdefault\nprepare.marginMm\t15\tdefault\n";
const withHome = (home: string): NodeJS.ProcessEnv => ({ ...process.env, HOME: home, USERPROFILE: home });

it("the built program that a test starts has neither the user's settings nor the user's plotters", () => {
  const home = homeOfUser();
  const options = { encoding: "utf8", env: withHome(home) } as const;
  expect(spawnSync(process.execPath, ARGS, options).stdout).toBe(DEFAULTS);
  // With the user's own environment they would count.
  const own = { ...options.env, XDG_CONFIG_HOME: undefined, XDG_DATA_HOME: undefined };
  const result = spawnSync(process.execPath, ARGS, { ...options, env: own });
  expect(result.stdout).toMatch(/^machine\taxidraw-v3-a3\tplotter main\nprepare\.marginMm\t77\t/);
});

it.skipIf(process.platform === "win32")("nor has one at a pseudo-terminal", async () => {
  const child = spawn(process.execPath, ARGS, { cwd: ROOT, cols: 200, env: withHome(homeOfUser()) });
  let text = "";
  child.onData((part) => (text += part));
  await new Promise((resolve) => child.onExit(resolve));
  expect(text.replaceAll("\r\n", "\n")).toBe(DEFAULTS);
});
