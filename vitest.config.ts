import { defineConfig } from "vitest/config";

/** Tests that watch a real clock, or start browsers and processes: other work beside them would disturb them. */
const ALONE = [
  "test/e2e/**/*.test.ts",
  "test/serial/**/*.test.ts",
  "test/packaging/**/*.test.ts",
  "test/**/*.alone.test.ts",
];

export default defineConfig({
  test: {
    maxWorkers: 2,
    projects: [
      {
        test: {
          name: "together",
          include: ["test/**/*.test.ts", "test/**/*.test.tsx"],
          exclude: ALONE,
          testTimeout: 120_000,
          hookTimeout: 120_000,
          pool: "forks",
          setupFiles: ["test/support/fixed-seed.ts"],
        },
      },
      {
        test: {
          name: "alone",
          include: ALONE,
          globalSetup: ["test/support/built.ts"],
          testTimeout: 120_000,
          hookTimeout: 120_000,
          pool: "forks",
          setupFiles: ["test/support/fixed-seed.ts"],
          fileParallelism: false,
        },
      },
    ],
  },
});
