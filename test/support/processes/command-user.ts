/** A user of the command line, with settings, plotter and server of their own. */
import { join } from "node:path";
import { afterEach, beforeEach, expect, vi } from "vitest";
import { createServer, type PlotwrightServer } from "../../../server/index.js";
import type { PlotSettings } from "../../../src/schema/index.js";
import { cli, type CliRun } from "./command-line.js";
import { folderOfTest } from "./folders.js";

/** What `settings show --json` prints. */
interface ShownSettings {
  readonly settings: PlotSettings;
  readonly sources: Readonly<Record<string, string>>;
}

/** Make one for a test file: its folders are empty before each test. */
export class CommandUser {
  /** The folder with the config file and the data folder. */
  home = "";

  constructor() {
    beforeEach(() => {
      this.home = folderOfTest();
      vi.stubEnv("XDG_CONFIG_HOME", this.home);
    });
    afterEach(() => vi.unstubAllEnvs());
  }

  get data(): string {
    return join(this.home, "data");
  }

  /** Runs a command on the user's data. */
  readonly run = (...args: string[]): Promise<CliRun> => cli(...args, "--data", this.data);

  /** Runs a command that must succeed. Returns what it prints. */
  readonly done = async (...args: string[]): Promise<string> => {
    const { code, out, err } = await this.run(...args);
    expect([args, code, err]).toEqual([args, 0, err]);
    return out;
  };

  readonly shown = async (...args: string[]): Promise<ShownSettings> =>
    JSON.parse(await this.done("settings", "show", "--json", ...args)) as ShownSettings;

  readonly startServer = (): Promise<PlotwrightServer> =>
    createServer({
      port: 0,
      device: "virtual",
      virtualSpeed: 100,
      dataDir: this.data,
      log: () => undefined,
    });
}
