import { defineConfig } from "vitest/config";

/** Tests that watch a real clock, or start browsers and processes: other work beside them would disturb them. */
const ALONE = [
  "test/e2e/**/*.test.ts",
  "test/serial/**/*.test.ts",
  "test/packaging/**/*.test.ts",
  "test/**/*.alone.test.ts",
];

/** A test waits for what has to come. How long that takes says nothing where the computer is slow, or busy. */
const PATIENCE = { testTimeout: 600_000, hookTimeout: 600_000, expect: { poll: { timeout: 60_000 } } };

export default defineConfig({
  test: {
    maxWorkers: 2,
    projects: [
      {
        test: {
          name: "together",
          include: ["test/**/*.test.ts", "test/**/*.test.tsx"],
          exclude: ALONE,
          ...PATIENCE,
          pool: "forks",
          setupFiles: ["test/support/fixed-seed.ts"],
        },
      },
      {
        test: {
          name: "alone",
          include: ALONE,
          globalSetup: ["test/support/built.ts"],
          ...PATIENCE,
          pool: "forks",
          setupFiles: ["test/support/fixed-seed.ts"],
          fileParallelism: false,
        },
      },
    ],
  },
});
