import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { defineConfig } from "vitest/config";
import { BaseSequencer, type TestSpecification } from "vitest/node";
import { WITH_PREACT } from "./web/vite.config.js";

/** Tests at the speed of a real board. They mostly wait; heavier work beside them would disturb them. */
const REAL_TIME = ["test/serial/**/*.test.ts"];

/** Keeps a server as busy as it may be while a board plots: nothing else runs then. */
const LOAD = ["test/serial/load.test.ts", "test/serial/attacks.test.ts"];

/** Tests of the command line that replace modules (vi.mock), so each file has a process of its own. */
const COMMANDS = ["add-and-queue", "hand-commands", "plot", "reference", "stdin"].map(
  (name) => `test/server/cli/${name}.test.ts`,
);

/** Tests of the built product, in processes of their own, and in a browser. */
const PROCESSES = ["test/e2e/**/*.test.ts", "test/packaging/**/*.test.ts", "test/**/*.alone.test.ts"];

/**
 * Tests that reach a board through a pseudo-terminal, or end processes by signals. Windows has neither, so they are
 * left out there.
 */
const POSIX_ONLY = [
  ...REAL_TIME,
  "test/e2e/plotter/first-plot.test.ts",
  "test/e2e/plotter/hand-drawing.test.ts",
  "test/server/cli/virtual-pty.test.ts",
  "test/server/cli/moves.test.ts",
  "test/server/composition/process-ends.alone.test.ts",
];
const LEFT_OUT = process.platform === "win32" ? POSIX_ONLY : [];

/** How long a test may take on a busy computer before it counts as hanging. Longer ones have limits of their own. */
const limits = (limitMs: number) => ({
  testTimeout: limitMs,
  hookTimeout: 120_000,
  expect: { poll: { timeout: 0.75 * limitMs } },
});

/** A larger young generation needs less garbage collection. */
const EXEC_ARGV = ["--max-semi-space-size=64"];

/**
 * What whoever runs the tests has set, and their plotters, queue and server, do not reach the tests and the programs that
 * these start. Tests that need such folders have their own.
 */
const EMPTY = mkdtempSync(path.join(tmpdir(), "plotwright-tests-"));
process.once("exit", () => rmSync(EMPTY, { recursive: true, force: true }));

const COMMON = {
  pool: "forks" as const,
  execArgv: EXEC_ARGV,
  setupFiles: ["test/support/runs/fixed-seed.ts"],
  env: { XDG_CONFIG_HOME: path.join(EMPTY, "config"), XDG_DATA_HOME: path.join(EMPTY, "data") },
  // Its import of React is replaced too.
  server: { deps: { inline: ["zustand"] } },
};

/** These tests leave nothing behind, so they share workers that have loaded the product once. */
const SHARED = { isolate: false };

/** Tests that also wait (for a board, a browser, a process) keep two cores busy only with a third worker. */
const WAITING = { maxWorkers: 3 };

/** Tests on a board in real time need little processor time. */
const MOSTLY_WAITING = { maxWorkers: 5 };

/** The files that take longest, the slowest first. */
const SLOWEST = [
  "test/e2e/page/accessibility.test.ts",
  "test/e2e/without-server/second-tab.test.ts",
  "test/e2e/without-server/both-backends.test.ts",
  "test/e2e/page/site.test.ts",
  "test/server/plugins/shared-queue/shared-queue.alone.test.ts",
  "test/server/cli/reference.test.ts",
  "test/e2e/plotter/machine.test.ts",
  "test/e2e/drawing/layers.test.ts",
  "test/src/drivers/ebb/virtual/plot-matrix.test.ts",
  "test/server/composition/server.test.ts",
  "test/server/http/attacks.test.ts",
  "test/server/plugins/shared-queue/shared-begin.test.ts",
  "test/serial/hidden-tab.test.ts",
  "test/serial/plot-faults.test.ts",
  "test/serial/busy-host.test.ts",
  "test/serial/pen-flight-faults.test.ts",
];

/** Starts the slowest files first, so that no worker has one left at the end while the others have nothing to do. */
class SlowestFirst extends BaseSequencer {
  override async sort(files: TestSpecification[]): Promise<TestSpecification[]> {
    const isSlow = (name: string) => (file: TestSpecification) => file.moduleId.endsWith(name);
    const slow = SLOWEST.flatMap((name) => files.filter(isSlow(name)));
    const others = files.filter((file) => !slow.includes(file));
    return [...slow, ...(await super.sort(others))];
  }
}

export default defineConfig({
  test: {
    maxWorkers: 2,
    sequence: { sequencer: SlowestFirst },
    projects: [
      {
        resolve: WITH_PREACT,
        test: {
          ...COMMON,
          ...WAITING,
          // One project for all of them: each project transforms and loads the product again.
          name: "together",
          include: ["test/**/*.test.ts", "test/**/*.test.tsx"],
          exclude: [...COMMANDS, ...PROCESSES, ...REAL_TIME, ...LEFT_OUT],
          ...limits(60_000),
          ...SHARED,
        },
      },
      {
        resolve: WITH_PREACT,
        test: {
          ...COMMON,
          ...WAITING,
          name: "commands",
          include: COMMANDS,
          exclude: [...PROCESSES, ...LEFT_OUT],
          ...limits(60_000),
        },
      },
      {
        resolve: WITH_PREACT,
        test: {
          ...COMMON,
          ...WAITING,
          ...SHARED,
          name: "processes",
          include: PROCESSES,
          exclude: LEFT_OUT,
          globalSetup: ["test/support/processes/built.ts", "test/support/browser/shared-browser.ts"],
          ...limits(120_000),
        },
      },
      {
        resolve: WITH_PREACT,
        test: {
          ...COMMON,
          ...MOSTLY_WAITING,
          name: "real-time",
          include: REAL_TIME,
          exclude: LOAD,
          globalSetup: ["test/support/processes/built.ts"],
          ...limits(120_000),
        },
      },
      {
        resolve: WITH_PREACT,
        test: {
          ...COMMON,
          name: "load",
          include: LOAD,
          globalSetup: ["test/support/processes/built.ts"],
          ...limits(120_000),
        },
      },
    ],
  },
});
