/** What `npm test` reads from vitest's reports. */
import path from "node:path";
import { describe, expect, it } from "vitest";
import { ROOT } from "../../scripts/setup.mjs";
import {
  failedFiles,
  failuresIn,
  passedCountIn,
  withSecondAttempt,
  type TestReport,
} from "../../scripts/test-report.mjs";

type Result = TestReport["testResults"][number];

/** `tests`: the name of each test, with a ! before those that failed. */
const result = (file: string, tests: string, message = ""): Result => ({
  name: path.join(ROOT, file),
  status: message !== "" || tests.includes("!") ? "failed" : "passed",
  message,
  assertionResults: tests.split(" ").map((name) => ({
    fullName: name.replace("!", ""),
    status: name.startsWith("!") ? "failed" : "passed",
  })),
});

const FIRST: TestReport = {
  testResults: [result("test/e2e/a.test.ts", "one !two"), result("test/e2e/b.test.ts", "three !four")],
};

describe("the reports of npm test", () => {
  it("name the failed tests with their files", () => {
    expect(failuresIn(FIRST)).toEqual(["test/e2e/a.test.ts: two", "test/e2e/b.test.ts: four"]);
    expect(failedFiles(FIRST)).toEqual(["test/e2e/a.test.ts", "test/e2e/b.test.ts"]);
    expect(passedCountIn(FIRST)).toBe(2);
  });

  it("count a file that could not be loaded as one failure", () => {
    const report = {
      testResults: [{ ...result("test/e2e/c.test.ts", "", "no such module"), assertionResults: [] }],
    };
    expect(failuresIn(report)).toEqual(["test/e2e/c.test.ts: no such module"]);
  });

  it("have the second attempt of a file in place of the first, with all its tests", () => {
    const second = { testResults: [result("test/e2e/a.test.ts", "!one two")] };
    const merged = withSecondAttempt(FIRST, second);
    expect(failuresIn(merged).sort()).toEqual(["test/e2e/a.test.ts: one", "test/e2e/b.test.ts: four"]);
    expect(passedCountIn(merged)).toBe(2);
  });
});
